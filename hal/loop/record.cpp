// SPDX-License-Identifier: Apache-2.0
#include "hal/loop/record.h"

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
    Column{"output/stiffness_n_per_m", kF32, 1, STYLET_IN(output.stiffness_n_per_m)},
    Column{"output/tip_m", kF32, 3, STYLET_IN(output.tip_m)},
    Column{"output/depth_m", kF32, 1, STYLET_IN(output.depth_m)},
    Column{"output/phase", kU32, 1, STYLET_IN(output.phase)},
    Column{"output/layer", kU32, 1, STYLET_IN(output.layer)},
    Column{"output/constraint_particles", kU32, 1, STYLET_IN(output.constraint_particles)},
    Column{"output/flags", kU32, 1, STYLET_IN(output.flags)},
    Column{"output/events", kU32, 1, STYLET_IN(output.events)},
    Column{"flow/plunger_n", kF32, 1, STYLET_IN(input.plunger_n)},
    Column{"flow/opening_pa", kF32, 1, STYLET_IN(output.flow.opening_pa)},
    Column{"flow/hub_pa", kF32, 1, STYLET_IN(output.flow.hub_pa)},
    Column{"flow/flow_m3_per_s", kF32, 1, STYLET_IN(output.flow.flow_m3_per_s)},
    Column{"flow/injected_m3", kF32, 1, STYLET_IN(output.flow.injected_m3)},
    Column{"flow/plunger_m", kF32, 1, STYLET_IN(output.flow.plunger_m)},
    Column{"flow/plunger_m_per_s", kF32, 1, STYLET_IN(output.flow.plunger_m_per_s)},
    Column{"flow/filled", kF32, 1, STYLET_IN(output.flow.filled)},
    Column{"device/seq", kU64, 1, STYLET_IN(sample.seq)},
    Column{"device/t_ns", kI64, 1, STYLET_IN(sample.t_ns)},
    Column{"device/position_m", kF32, 3, STYLET_IN(sample.pose.position_m)},
    Column{"device/rotation_wxyz", kF32, 4, STYLET_IN(sample.pose.rotation)},
    Column{"device/buttons", kU32, 1, STYLET_IN(sample.buttons)},
    Column{"device/answered", kU32, 1, STYLET_IN(answered)},
    Column{"device/force_n", kF32, 3, STYLET_IN(command_n)},
    Column{"guard/fault", kU32, 1, STYLET_IN(fault)},
    Column{"guard/mode", kU32, 1, STYLET_IN(mode)},
    Column{"guard/energy_j", kF32, 1, STYLET_IN(energy_j)},
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
    Column{"events/needle", kU32, 1, offsetof(Event, needle)},
};

#define STYLET_IN(field) offsetof(NeedleRecord, field)
constexpr std::array kNeedleColumns = {
    Column{"needles/length_m", kF32, 1, STYLET_IN(config.length_m)},
    Column{"needles/outer_radius_m", kF32, 1, STYLET_IN(config.outer_radius_m)},
    Column{"needles/unit_m", kF32, 1, STYLET_IN(config.unit_m)},
    Column{"needles/bending_nm2", kF32, 1, STYLET_IN(config.bending_nm2)},
    Column{"needles/rods", kU32, 1, STYLET_IN(config.rods)},
    Column{"needles/bevel_per_m", kF32, 1, STYLET_IN(config.bevel_per_m)},
    Column{"needles/bent_length_m", kF32, 1, STYLET_IN(config.bent_length_m)},
    Column{"needles/bent_angle_rad", kF32, 1, STYLET_IN(config.bent_angle_rad)},
    Column{"needles/torsion_nm2", kF32, 1, STYLET_IN(config.torsion_nm2)},
    Column{"needles/tip_half_angle_rad", kF32, 1, STYLET_IN(config.tip_half_angle_rad)},
    Column{"needles/torn_diameters", kF32, 1, STYLET_IN(config.torn_diameters)},
    Column{"needles/hub", kU32, 1, STYLET_IN(config.hub)},
    Column{"needles/bore_radius_m", kF32, 1, STYLET_IN(config.bore_radius_m)},
    Column{"needles/opening_m", kF32, 1, STYLET_IN(config.opening_m)},
    Column{"needles/filling_pa_s", kF32, 1, STYLET_IN(config.filling_pa_s)},
    Column{"needles/plunger_radius_m", kF32, 1, STYLET_IN(config.plunger_radius_m)},
    Column{"needles/plunger_friction_n", kF32, 1, STYLET_IN(config.plunger_friction_n)},
    Column{"needles/syringe_m3", kF32, 1, STYLET_IN(config.syringe_m3)},
    Column{"needles/syringe_filled", kF32, 1, STYLET_IN(config.syringe_filled)},
    Column{"needles/syringe_gas_m3", kF32, 1, STYLET_IN(config.syringe_gas_m3)},
    Column{"needles/entry_m", kF32, 3, STYLET_IN(course.entry_m)},
    Column{"needles/direction", kF32, 3, STYLET_IN(course.direction)},
};
#undef STYLET_IN
static_assert(sizeof(NeedleConfig) == 20 * 4, "a field of NeedleConfig has no column");

#define STYLET_IN(field) offsetof(ObstacleConfig, field)
constexpr std::array kObstacleColumns = {
    Column{"obstacles/position_m", kF32, 3, STYLET_IN(pose.position_m)},
    Column{"obstacles/rotation_wxyz", kF32, 4, STYLET_IN(pose.rotation)},
    Column{"obstacles/vertex_count", kU32, 1, STYLET_IN(vertex_count)},
    Column{"obstacles/vertices_m", kF32, 3 * kMaxHullVertices, STYLET_IN(vertices_m)},
    Column{"obstacles/rounding_m", kF32, 1, STYLET_IN(rounding_m)},
    Column{"obstacles/stiffness_n_per_m", kF32, 1, STYLET_IN(stiffness_n_per_m)},
    Column{"obstacles/largest_force_n", kF32, 1, STYLET_IN(largest_force_n)},
    Column{"obstacles/friction", kF32, 1, STYLET_IN(friction)},
};
#undef STYLET_IN
static_assert(sizeof(ObstacleConfig) == (12 + 3 * kMaxHullVertices) * 4,
              "a field of ObstacleConfig has no column");

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
std::span<const Column> needle_columns() {
  return kNeedleColumns;
}
std::span<const Column> obstacle_columns() {
  return kObstacleColumns;
}

}  // namespace stylet::hal
