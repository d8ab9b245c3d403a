// SPDX-License-Identifier: Apache-2.0
#include "hal/console/messages.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/console/limits.h"
#include "hal/guard/guard.h"

namespace stylet::console {
namespace {

using Builder = flatbuffers::FlatBufferBuilder;

Vec3 packed(const stylet::Vec3& v) {
  return Vec3(v.x, v.y, v.z);
}

Quaternion packed(const stylet::Quat& q) {
  return Quaternion(q.w, q.x, q.y, q.z);
}

template <typename Offset>
Bytes finished(Builder& builder, Body type, Offset body) {
  FinishMessageBuffer(builder, CreateMessage(builder, type, body.Union()));
  return builder.Release();
}

auto packed_all(Builder& builder, std::span<const stylet::Vec3> all) {
  std::vector<Vec3> out(all.size());
  std::transform(all.begin(), all.end(), out.begin(), [](const auto& v) { return packed(v); });
  return builder.CreateVectorOfStructs(out);
}

auto obstacles_of(Builder& builder, const SceneView& view) {
  std::vector<flatbuffers::Offset<Obstacle>> all;
  for (const ObstacleConfig& each : view.obstacles) {
    const auto vertices = packed_all(builder, std::span(each.vertices_m).first(each.vertex_count));
    const Vec3 position = packed(each.pose.position_m);
    const Quaternion rotation = packed(each.pose.rotation);
    all.push_back(CreateObstacle(builder, &position, &rotation, vertices, each.rounding_m));
  }
  return builder.CreateVector(all);
}

auto needles_of(Builder& builder, const SceneView& view) {
  std::vector<flatbuffers::Offset<NeedleInfo>> all;
  for (const ShownNeedle& each : view.needles) {
    const Vec3 entry = packed(each.course.entry_m), direction = packed(each.course.direction);
    all.push_back(CreateNeedleInfo(builder, builder.CreateString(each.device), each.length_m,
                                   each.outer_radius_m, &entry, &direction, each.max_force_n));
  }
  return builder.CreateVector(all);
}

auto targets_of(Builder& builder, const SceneView& view) {
  std::vector<flatbuffers::Offset<Target>> all;
  for (const hal::Target& each : view.targets) {
    const Vec3 position = packed(each.position_m);
    all.push_back(CreateTarget(builder, builder.CreateString(each.name), &position, each.radius_m,
                               each.forbidden));
  }
  return builder.CreateVector(all);
}

auto puncture_scores(Builder& builder, const Organ& organ, const hal::Score& score) {
  std::vector<flatbuffers::Offset<PunctureScore>> all;
  for (const hal::PunctureScore& each : score.punctures) {
    const bool known = each.layer < organ.material_count;
    const auto layer = builder.CreateString(known ? organ_material(organ, each.layer).name : "");
    all.push_back(CreatePunctureScore(builder, each.tick, layer, each.force_n));
  }
  return builder.CreateVector(all);
}

auto target_scores(Builder& builder, const SceneView& view, const hal::Score& score) {
  std::vector<flatbuffers::Offset<TargetScore>> all;
  for (std::size_t i = 0; i < std::min(view.targets.size(), score.targets.size()); ++i) {
    const auto name = builder.CreateString(view.targets[i].name);
    all.push_back(CreateTargetScore(builder, name, view.targets[i].forbidden,
                                    score.targets[i].closest_m, score.targets[i].reached));
  }
  return builder.CreateVector(all);
}

flatbuffers::Offset<NeedleFrame> needle_frame(Builder& builder, const hal::DisplayState& state,
                                              std::uint32_t i) {
  const hal::TickRecord& record = state.hand[i];
  const stylet::Output& out = record.output;
  const auto nodes = packed_all(builder, std::span(state.node_m[i]).first(state.nodes[i]));
  const auto fault = record.fault == hal::Fault::kNone
                         ? flatbuffers::Offset<flatbuffers::String>{}
                         : builder.CreateString(hal::fault_name(record.fault));
  const auto mode = builder.CreateString(hal::mode_name(record.mode));
  const Vec3 handle = packed(record.input.handle.position_m), tip = packed(out.tip_m);
  const Quaternion rotation = packed(record.input.handle.rotation);
  const Vec3 force = packed(out.force_n), command = packed(record.command_n);
  const Vec3 stiffness = packed(out.cause.stiffness_n), cutting = packed(out.cause.cutting_n);
  const Vec3 friction = packed(out.cause.friction_n), clamping = packed(out.cause.clamping_n);
  const Vec3 obstacle = packed(out.cause.obstacle_n);
  return CreateNeedleFrame(builder, nodes, &handle, &rotation, &tip, out.depth_m,
                           static_cast<Phase>(out.phase), out.layer, &force, &command, &stiffness,
                           &cutting, &friction, &clamping, &obstacle, fault, mode, out.flags,
                           record.fault_number);
}

auto constraint_particles_of(Builder& builder, const hal::DisplayState& state) {
  std::vector<Particle> all;
  for (const auto& p : std::span(state.constraint_particle).first(state.constraint_particles)) {
    all.emplace_back(packed(p.position_m), packed(p.goal_m), packed(p.force_on_needle_n), p.needle);
  }
  return builder.CreateVectorOfStructs(all);
}

auto touches_of(Builder& builder, const hal::DisplayState& state) {
  std::vector<Touch> all;
  for (const auto& t : std::span(state.touch).first(state.touches)) {
    all.emplace_back(packed(t.position_m), packed(t.force_on_needle_n), t.needle);
  }
  return builder.CreateVectorOfStructs(all);
}

// What has changed since it was sent; false: everything must be sent.
bool changes(const FrameParts& parts, std::vector<std::uint32_t>& index, Places& to) {
  const Places& now = *parts.places;
  if (parts.sent == nullptr || parts.sent->size() != now.size()) return false;
  const Places& sent = *parts.sent;
  for (std::size_t at = 0; at < now.size(); at += 3) {
    if (std::equal(now.begin() + static_cast<std::ptrdiff_t>(at),
                   now.begin() + static_cast<std::ptrdiff_t>(at + 3),
                   sent.begin() + static_cast<std::ptrdiff_t>(at))) {
      continue;
    }
    index.push_back(static_cast<std::uint32_t>(at / 3));
    to.insert(to.end(), {now[at], now[at + 1], now[at + 2]});
  }
  // An index takes four bytes, a position six: with more of them a key frame is smaller.
  return index.size() * 10 < now.size() * 2;
}

auto timing(Builder& builder, const FrameParts& parts) {
  const TimingShown& t = *parts.timing;
  const auto tick_us = builder.CreateVector(t.tick_us), late_us = builder.CreateVector(t.late_us);
  const auto tick_bins = builder.CreateVector(t.tick_bins);
  const auto late_bins = builder.CreateVector(t.late_bins);
  return CreateTiming(builder, parts.state->hand[0].output.tick, parts.state->missed_ticks,
                      parts.state->lost_records, t.lost_frames, t.connections, tick_us, late_us,
                      tick_bins, late_bins, kTimingBinUs);
}

std::vector<std::uint32_t> binned(const hal::Histogram& histogram) {
  std::vector<std::uint32_t> bins(kTimingBins);
  for (std::size_t i = 0; i < hal::Histogram::kBins; ++i) {
    const auto bin =
        std::min<std::size_t>(i / static_cast<std::size_t>(kTimingBinUs), kTimingBins - 1);
    bins[bin] += static_cast<std::uint32_t>(histogram.count[i]);
  }
  return bins;
}

std::vector<float> quantiles(const hal::Histogram& histogram) {
  std::vector<float> out;
  for (const double share : {0.5, 0.9, 0.99, 0.999, 1.0}) {
    out.push_back(static_cast<float>(hal::histogram_quantile_us(histogram, share)));
  }
  return out;
}

std::string text_of(const flatbuffers::String* text) {
  return text == nullptr ? "" : text->str();
}

stylet::Vec3 unpacked(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

Bytes hello_message(const SceneView& view, bool may_control) {
  const std::size_t lattice = view.lattice.rest_m.size() * sizeof(Vec3) +
                              view.lattice.corners.size() * sizeof(std::uint32_t);
  Builder builder(lattice + 65536);
  const auto version = builder.CreateString(STYLET_VERSION);
  const auto scene = builder.CreateString(view.scene);
  const auto scenes = builder.CreateVectorOfStrings(view.scenes);
  const auto rest = packed_all(builder, view.lattice.rest_m);
  const auto corners = builder.CreateVector(view.lattice.corners);
  const auto needles = needles_of(builder, view);
  const auto obstacles = obstacles_of(builder, view);
  const auto targets = targets_of(builder, view);
  const auto hello = CreateHello(builder, kProtocol, version, scene, scenes, view.period_s,
                                 view.recording_ticks, view.organ->organ.voxel_edge_m,
                                 static_cast<std::uint32_t>(view.lattice.rest_m.size()), rest,
                                 corners, kPositionUnitM, needles, obstacles, targets, may_control);
  return finished(builder, Body::Hello, hello);
}

Bytes refused_message(const std::string& what) {
  Builder builder;
  return finished(builder, Body::Refused, CreateRefused(builder, builder.CreateString(what)));
}

Bytes rows_message(std::uint64_t first, std::uint32_t stride, std::span<const Row> rows,
                   std::span<const Happened> events) {
  Builder builder(rows.size_bytes() + events.size_bytes() + 1024);
  const auto row_vector = builder.CreateVectorOfStructs(rows.data(), rows.size());
  const auto event_vector = builder.CreateVectorOfStructs(events.data(), events.size());
  return finished(builder, Body::Rows,
                  CreateRows(builder, first, stride, row_vector, event_vector));
}

Bytes score_message(const SceneView& view, const ScoredAttempt& attempt,
                    std::span<const Row> rows) {
  Builder builder(rows.size_bytes() + 4096);
  const hal::Score& score = attempt.score;
  const auto scene = builder.CreateString(view.scene);
  const auto trainee = builder.CreateString(attempt.trainee);
  const auto began = builder.CreateString(attempt.began);
  const auto recording = builder.CreateString(attempt.recording);
  const auto punctures = puncture_scores(builder, view.organ->organ, score);
  const auto targets = target_scores(builder, view, score);
  const auto row_vector = builder.CreateVectorOfStructs(rows.data(), rows.size());
  ScoreBuilder out(builder);
  out.add_attempt(attempt.attempt);
  out.add_scene(scene);
  out.add_trainee(trainee);
  out.add_began(began);
  out.add_duration_s(static_cast<float>(score.duration_s));
  out.add_path_m(static_cast<float>(score.path_m));
  out.add_depth_path_m(static_cast<float>(score.depth_path_m));
  out.add_punctures(punctures);
  out.add_withdrawals(score.withdrawals);
  out.add_targets(targets);
  out.add_peak_force_n(score.peak_force_n);
  out.add_peak_lateral_n(score.peak_lateral_n);
  out.add_mean_force_n(static_cast<float>(score.mean_force_n));
  out.add_faults(score.faults);
  out.add_recording(recording);
  out.add_rows(row_vector);
  return finished(builder, Body::Score, out.Finish());
}

Bytes marked_message(std::uint64_t tick, const std::string& text, std::uint32_t attempt) {
  Builder builder;
  const auto words = builder.CreateString(text);
  return finished(builder, Body::Marked, CreateMarked(builder, tick, words, attempt));
}

void quantise(const Lattice& lattice, std::span<const stylet::Vec3> moved_m, Places& places_out) {
  const auto in_units = [](float metres) {
    const float units = std::nearbyint(metres / kPositionUnitM);
    return static_cast<std::int16_t>(std::clamp(units, -32767.0F, 32767.0F));
  };
  places_out.resize(3 * lattice.of_kernel.size());
  std::size_t at = 0;
  for (const std::uint32_t particle : lattice.of_kernel) {
    const stylet::Vec3& moved = moved_m[particle];
    places_out[at++] = in_units(moved.x);
    places_out[at++] = in_units(moved.y);
    places_out[at++] = in_units(moved.z);
  }
}

TimingShown timing_of(const Curve& curve) {
  TimingShown out;
  out.tick_us = quantiles(curve.tick_time());
  out.late_us = quantiles(curve.lateness());
  out.tick_bins = binned(curve.tick_time());
  out.late_bins = binned(curve.lateness());
  return out;
}

Bytes frame_message(const FrameParts& parts) {
  std::vector<std::uint32_t> index;
  Places to;
  const bool key = !changes(parts, index, to);
  if (key) index.clear();
  const Places& places = key ? *parts.places : to;
  Builder builder(places.size() * sizeof(std::int16_t) + 65536);
  const auto moved_index = builder.CreateVector(index);
  const auto moved_to = builder.CreateVector(places);
  std::vector<flatbuffers::Offset<NeedleFrame>> needles;
  for (std::uint32_t i = 0; i < parts.state->needles; ++i) {
    needles.push_back(needle_frame(builder, *parts.state, i));
  }
  const auto needle_vector = builder.CreateVector(needles);
  const auto particle_vector = constraint_particles_of(builder, *parts.state);
  const auto touch_vector = touches_of(builder, *parts.state);
  const auto event_vector = builder.CreateVectorOfStructs(parts.events.data(), parts.events.size());
  const auto row_vector = builder.CreateVectorOfStructs(parts.rows.data(), parts.rows.size());
  const auto timing_table = timing(builder, parts);
  return finished(
      builder, Body::Frame,
      CreateFrame(builder, parts.state->hand[0].output.tick, parts.activity, key, moved_index,
                  moved_to, needle_vector, particle_vector, touch_vector, event_vector, row_vector,
                  timing_table, parts.attempt, parts.state->published_ns));
}

std::optional<Asked> read_message(std::span<const std::byte> bytes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  flatbuffers::Verifier verifier(data, bytes.size(), 8, 64);
  if (!VerifyMessageBuffer(verifier)) return std::nullopt;
  const Message& message = *GetMessage(data);
  if (message.body() == nullptr) return std::nullopt;
  switch (message.body_type()) {
    case Body::Start:
      return Order{Verb::kStart, text_of(message.body_as_Start()->trainee())};
    case Body::Pause:
      return Order{Verb::kPause};
    case Body::Resume:
      return Order{Verb::kResume};
    case Body::Reset:
      return Order{Verb::kReset};
    case Body::End:
      return Order{Verb::kEnd};
    case Body::Choose:
      return Order{Verb::kChoose, text_of(message.body_as_Choose()->scene())};
    case Body::Seek:
      return Order{Verb::kSeek, "", message.body_as_Seek()->tick()};
    case Body::Play:
      return Order{Verb::kPlay, "", 0, message.body_as_Play()->speed()};
    case Body::Mark:
      return Order{Verb::kMark, text_of(message.body_as_Mark()->text())};
    case Body::Acknowledge: {
      const Acknowledge& a = *message.body_as_Acknowledge();
      return Order{Verb::kAcknowledge, text_of(a.fault()), 0,          0,
                   a.needle(),         a.fault_number(),   a.time_ns()};
    }
    case Body::AskRows: {
      const AskRows& a = *message.body_as_AskRows();
      return AskedRows{a.first(), a.last(), a.points()};
    }
    case Body::Pointer: {
      const Pointer& p = *message.body_as_Pointer();
      if (p.position_m() == nullptr || p.rotation() == nullptr) return std::nullopt;
      const Quaternion& q = *p.rotation();
      return PointerMoved{
          p.needle(), {unpacked(*p.position_m()), {q.w(), q.x(), q.y(), q.z()}}, p.buttons()};
    }
    default:
      return std::nullopt;
  }
}

}  // namespace stylet::console
