// SPDX-License-Identifier: Apache-2.0
// The console's messages (console.fbs): the server's, made from what the hal knows, and a page's,
// checked and turned into orders. Pure functions; units and frames as in the schema.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "console_generated.h"
#include "hal/console/rows.h"
#include "hal/console/scene_view.h"

namespace stylet::console {

using Bytes = flatbuffers::DetachedBuffer;

Bytes hello_message(const SceneView& view, bool may_control);
Bytes refused_message(const std::string& what);
Bytes rows_message(std::uint64_t first, std::uint32_t stride, std::span<const Row> rows,
                   std::span<const Happened> events);
Bytes score_message(const SceneView& view, const ScoredAttempt& attempt, std::span<const Row> rows);
// attempt: counted from 1, as in a score; 0: a recording's.
Bytes marked_message(std::uint64_t tick, const std::string& text, std::uint32_t attempt);

// Displacements of the lattice's particles from rest, in kPositionUnitM: x y z of each.
using Places = std::vector<std::int16_t>;
void quantise(const Lattice& lattice, std::span<const stylet::Vec3> moved_m, Places& places_out);

struct TimingShown {
  std::uint64_t lost_frames = 0;
  std::uint32_t connections = 0;
  std::vector<float> tick_us, late_us;  // quantiles
  std::vector<std::uint32_t> tick_bins, late_bins;
};
// Quantiles and bins of a curve's times.
TimingShown timing_of(const Curve& curve);

struct FrameParts {
  Activity activity;
  const hal::DisplayState* state;
  const Places* places;  // now
  const Places* sent;    // already sent on this connection; null or another size: send a key frame
  std::span<const Row> rows;
  std::span<const Happened> events;
  const TimingShown* timing;
  std::uint32_t attempt = 0;  // from 1; 0: no attempt yet, or a recording
};
Bytes frame_message(const FrameParts& parts);

// ---- from a page

struct AskedRows {
  std::uint64_t first, last;
  std::uint32_t points;
};
struct PointerMoved {
  std::uint32_t needle;
  stylet::Pose pose;
  std::uint32_t buttons;
};
using Asked = std::variant<Order, AskedRows, PointerMoved>;
// nullopt: not a page's message, so the connection must be closed.
std::optional<Asked> read_message(std::span<const std::byte> bytes);

}  // namespace stylet::console
