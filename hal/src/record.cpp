// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/record.h"

#include <array>

namespace stylet::hal {
namespace {

constexpr ColumnType kF32 = ColumnType::kFloat32;
constexpr ColumnType kU32 = ColumnType::kUint32;
constexpr ColumnType kU64 = ColumnType::kUint64;
constexpr ColumnType kI64 = ColumnType::kInt64;

#define STYLET_IN(field) offsetof(TickRecord, field)
constexpr std::array kTickColumns = {
    Column{"input/position_m", kF32, 3, STYLET_IN(input.handle.position_m)},
    Column{"input/rotation_wxyz", kF32, 4, STYLET_IN(input.handle.rotation)},
    Column{"input/valid", kU32, 1, STYLET_IN(input.valid)},
    Column{"output/tick", kU64, 1, STYLET_IN(output.tick)},
    Column{"output/force_n", kF32, 3, STYLET_IN(output.force_n)},
    Column{"output/torque_nm", kF32, 3, STYLET_IN(output.torque_nm)},
    Column{"output/stiffness_n", kF32, 3, STYLET_IN(output.cause.stiffness_n)},
    Column{"output/cutting_n", kF32, 3, STYLET_IN(output.cause.cutting_n)},
    Column{"output/friction_n", kF32, 3, STYLET_IN(output.cause.friction_n)},
    Column{"output/clamping_n", kF32, 3, STYLET_IN(output.cause.clamping_n)},
    Column{"output/obstacle_n", kF32, 3, STYLET_IN(output.cause.obstacle_n)},
    Column{"output/tip_m", kF32, 3, STYLET_IN(output.tip_m)},
    Column{"output/depth_m", kF32, 1, STYLET_IN(output.depth_m)},
    Column{"output/phase", kU32, 1, STYLET_IN(output.phase)},
    Column{"output/layer", kU32, 1, STYLET_IN(output.layer)},
    Column{"output/constraint_particles", kU32, 1, STYLET_IN(output.constraint_particles)},
    Column{"output/flags", kU32, 1, STYLET_IN(output.flags)},
    Column{"output/events", kU32, 1, STYLET_IN(output.events)},
    Column{"device/seq", kU64, 1, STYLET_IN(sample.seq)},
    Column{"device/t_ns", kI64, 1, STYLET_IN(sample.t_ns)},
    Column{"device/position_m", kF32, 3, STYLET_IN(sample.pose.position_m)},
    Column{"device/rotation_wxyz", kF32, 4, STYLET_IN(sample.pose.rotation)},
    Column{"device/buttons", kU32, 1, STYLET_IN(sample.buttons)},
    Column{"device/answered", kU32, 1, STYLET_IN(answered)},
    Column{"device/force_n", kF32, 3, STYLET_IN(command_n)},
    Column{"guard/fault", kU32, 1, STYLET_IN(fault)},
    Column{"loop/tick_ns", kU32, 1, STYLET_IN(tick_ns)},
    Column{"loop/late_ns", kU32, 1, STYLET_IN(late_ns)},
    Column{"loop/state_hash", kU64, 1, STYLET_IN(state_hash)},
};
#undef STYLET_IN

constexpr std::array kEventColumns = {
    Column{"events/tick", kU64, 1, offsetof(Event, tick)},
    Column{"events/kind", kU32, 1, offsetof(Event, kind)},
    Column{"events/layer", kU32, 1, offsetof(Event, layer)},
    Column{"events/depth_m", kF32, 1, offsetof(Event, depth_m)},
    Column{"events/force_n", kF32, 1, offsetof(Event, force_n)},
};

}  // namespace

std::size_t column_bytes(ColumnType type) {
  return type == ColumnType::kFloat32 || type == ColumnType::kUint32 ? 4 : 8;
}

std::span<const Column> tick_columns() {
  return kTickColumns;
}
std::span<const Column> event_columns() {
  return kEventColumns;
}

}  // namespace stylet::hal
