// SPDX-License-Identifier: Apache-2.0
#include "hal/publish/igtl_messages.h"

#include <fmt/format.h>
#include <igtlPointMessage.h>
#include <igtlPositionMessage.h>
#include <igtlSensorMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTransformMessage.h>

#include <array>
#include <cmath>

#include "hal/base/rotation.h"
#include "hal/base/vector.h"
#include "hal/guard/guard.h"

namespace stylet::hal {
namespace {

// From the world, taken for LPS, to RAS: half a turn about z.
Vec3 in_ras(Vec3 v) {
  return {-v.x, -v.y, v.z};
}
Vec3 in_ras_mm(Vec3 metres) {
  return {-1e3F * metres.x, -1e3F * metres.y, 1e3F * metres.z};
}

std::string name_of(const char* what, std::uint32_t needle) {
  return needle == 0 ? what : fmt::format("{}{}", what, needle);
}

const char* phase_name(Phase phase) {
  switch (phase) {
    case Phase::kFree:
      return "free";
    case Phase::kContact:
      return "contact";
    case Phase::kInserted:
      return "inserted";
    case Phase::kRetracting:
      return "retracting";
  }
  return "unknown";
}

template <typename Message>
void append(const Message& message, const std::string& name, IgtlBytes& out) {
  const igtl::TimeStamp::Pointer now = igtl::TimeStamp::New();
  now->GetTime();
  igtl::TimeStamp::Pointer stamp = now;
  message->SetDeviceName(name.c_str());
  message->SetTimeStamp(stamp);
  message->Pack();
  const char* bytes = static_cast<const char*>(message->GetPackPointer());
  out.insert(out.end(), bytes, bytes + message->GetPackSize());
}

void add_transform(const std::string& name, const Quat& rotation, Vec3 place_m, IgtlBytes& out) {
  igtl::Matrix4x4 matrix = {};
  const std::array<Vec3, 3> axes = {rotate(rotation, {1, 0, 0}), rotate(rotation, {0, 1, 0}),
                                    rotate(rotation, {0, 0, 1})};
  const auto put = [&matrix](std::size_t column, Vec3 v) {
    matrix[0][column] = v.x;
    matrix[1][column] = v.y;
    matrix[2][column] = v.z;
  };
  for (std::size_t i = 0; i < axes.size(); ++i) put(i, in_ras(axes[i]));
  put(3, in_ras_mm(place_m));
  matrix[3][3] = 1;
  const igtl::TransformMessage::Pointer message = igtl::TransformMessage::New();
  message->SetMatrix(matrix);
  append(message, name, out);
}

void add_position(const std::string& name, const Quat& rotation, Vec3 place_m, IgtlBytes& out) {
  const igtl::PositionMessage::Pointer message = igtl::PositionMessage::New();
  const Vec3 place = in_ras_mm(place_m);
  const Quat q = product({0, 0, 0, 1}, rotation);
  message->SetPosition(place.x, place.y, place.z);
  message->SetQuaternion(q.x, q.y, q.z, q.w);
  append(message, name, out);
}

void add_force(const std::string& name, const Output& output, const Course& course,
               IgtlBytes& out) {
  const Vec3 force = in_ras(output.force_n);
  const auto along = [&course](Vec3 v) { return dot(v, course.direction); };
  const float axial = along(output.force_n);
  const Vec3 across = output.force_n - axial * course.direction;
  const ForceByCause& cause = output.cause;
  const std::array<float, 10> values = {force.x,
                                        force.y,
                                        force.z,
                                        axial,
                                        length(across),
                                        along(cause.stiffness_n),
                                        along(cause.cutting_n),
                                        along(cause.friction_n),
                                        along(cause.clamping_n),
                                        along(cause.obstacle_n)};
  const igtl::SensorMessage::Pointer message = igtl::SensorMessage::New();
  const igtl::Unit::Pointer newton = igtl::Unit::New();
  newton->Append(igtl::Unit::SI_DERIVED_NEWTON, 1);
  message->SetUnit(newton->Pack());
  message->SetLength(static_cast<unsigned>(values.size()));
  for (unsigned i = 0; i < values.size(); ++i) {
    message->SetValue(i, static_cast<double>(values[i]));
  }
  append(message, name, out);
}

void add_state(const std::string& name, const TickRecord& record, IgtlBytes& out) {
  const Output& output = record.output;
  std::string line =
      fmt::format("depth {:.1f} mm, force {:.2f} N, {}", static_cast<double>(output.depth_m) * 1e3,
                  std::sqrt(static_cast<double>(dot(output.force_n, output.force_n))),
                  phase_name(output.phase));
  if (record.fault != Fault::kNone) line += fmt::format(", fault: {}", fault_name(record.fault));
  const igtl::StringMessage::Pointer message = igtl::StringMessage::New();
  message->SetString(line);
  append(message, name, out);
}

}  // namespace

void add_igtl_needle(const TickRecord& record, const Course& course, IgtlBytes& out) {
  const Pose& base = record.input.handle;
  const std::uint32_t needle = record.needle;
  add_transform(name_of("StyletBase", needle), base.rotation, base.position_m, out);
  add_transform(name_of("StyletTip", needle), base.rotation, record.output.tip_m, out);
  add_position(name_of("StyletTip", needle), base.rotation, record.output.tip_m, out);
  add_force(name_of("StyletForce", needle), record.output, course, out);
  add_state(name_of("StyletState", needle), record, out);
}

void add_igtl_status(Fault fault, std::uint64_t tick, IgtlBytes& out) {
  const igtl::StatusMessage::Pointer message = igtl::StatusMessage::New();
  const bool fine = fault == Fault::kNone;
  message->SetCode(fine ? igtl::StatusMessage::STATUS_OK
                        : igtl::StatusMessage::STATUS_HARDWARE_FAILURE);
  message->SetSubCode(static_cast<igtlInt64>(fault));
  message->SetErrorName(fine ? "" : fault_name(fault));
  message->SetStatusString(fmt::format("tick {}", tick).c_str());
  append(message, "Stylet", out);
}

void add_igtl_targets(std::span<const Target> targets, IgtlBytes& out) {
  if (targets.empty()) return;
  const igtl::PointMessage::Pointer message = igtl::PointMessage::New();
  for (const Target& target : targets) {
    igtl::PointElement::Pointer point = igtl::PointElement::New();
    const Vec3 place = in_ras_mm(target.position_m);
    point->SetName(target.name.c_str());
    point->SetGroupName(target.forbidden ? "Forbidden" : "Target");
    point->SetRGBA(target.forbidden ? 213 : 0, target.forbidden ? 94 : 158,
                   target.forbidden ? 0 : 115, 255);
    point->SetPosition(place.x, place.y, place.z);
    point->SetRadius(1e3F * target.radius_m);
    message->AddPointElement(point);
  }
  append(message, "StyletTargets", out);
}

}  // namespace stylet::hal
