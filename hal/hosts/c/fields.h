// SPDX-License-Identifier: Apache-2.0
// Where the fields of a struct that may grow begin and end, so that a size which cuts one in two is
// known: no header ever had it, and half a number is none. A struct that gets a field does not
// compile until it has one more name here; the names say nothing, after z comes aa.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stylet/stylet.h"
#include "stylet/stylet_loop.h"

namespace stylet::c {

struct Span {
  std::uint16_t begin = 0, end = 0;
};

// As C lays out fields of these types one after the other.
template <typename... Fields>
constexpr auto spans(const Fields&... /*fields*/) {
  constexpr std::array<std::size_t, sizeof...(Fields)> kSize = {sizeof(Fields)...};
  constexpr std::array<std::size_t, sizeof...(Fields)> kAlign = {alignof(Fields)...};
  std::array<Span, sizeof...(Fields)> out{};
  std::size_t at = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    at = (at + kAlign[i] - 1) / kAlign[i] * kAlign[i];
    out[i] = {static_cast<std::uint16_t>(at), static_cast<std::uint16_t>(at + kSize[i])};
    at += kSize[i];
  }
  return out;
}

constexpr auto fields(const stylet_refusal& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j] = of;
  return spans(a, b, c, d, e, f, g, h, i, j);
}
constexpr auto fields(const stylet_organ_info& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
}
constexpr auto fields(const stylet_material& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x);
}
constexpr auto fields(const stylet_config& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l);
}
constexpr auto fields(const stylet_needle& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u);
}
constexpr auto fields(const stylet_obstacle& of) {
  const auto& [a, b, c, d, e, f, g, h] = of;
  return spans(a, b, c, d, e, f, g, h);
}
constexpr auto fields(const stylet_input& of) {
  const auto& [a, b, c, d] = of;
  return spans(a, b, c, d);
}
constexpr auto fields(const stylet_output& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y);
}
constexpr auto fields(const stylet_stats& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
}
constexpr auto fields(const stylet_energy& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l);
}
constexpr auto fields(const stylet_guard_config& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
}
constexpr auto fields(const stylet_sample& of) {
  const auto& [a, b, c, d, e, f] = of;
  return spans(a, b, c, d, e, f);
}
constexpr auto fields(const stylet_guard_report& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x);
}
constexpr auto fields(const stylet_command& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k);
}
constexpr auto fields(const stylet_device_functions& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k, l);
}
constexpr auto fields(const stylet_loop_config& of) {
  const auto& [a, b, c, d, e, f, g, h] = of;
  return spans(a, b, c, d, e, f, g, h);
}
constexpr auto fields(const stylet_hand& of) {
  const auto& [a, b, c, d, e, f] = of;
  return spans(a, b, c, d, e, f);
}
constexpr auto fields(const stylet_hand_report& of) {
  const auto& [a, b, c, d, e, f, g] = of;
  return spans(a, b, c, d, e, f, g);
}
constexpr auto fields(const stylet_loop_report& of) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k] = of;
  return spans(a, b, c, d, e, f, g, h, i, j, k);
}

template <typename T>
constexpr auto kFieldsOf = fields(T{});

// The fields of a struct, for code that need not know its type.
template <typename T>
constexpr std::span<const Span> known_fields() {
  constexpr std::size_t kEnd = kFieldsOf<T>.back().end;
  static_assert(kEnd <= sizeof(T) && sizeof(T) < kEnd + alignof(T));
  return kFieldsOf<T>;
}

inline bool cuts_a_field(std::span<const Span> fields, std::size_t bytes) {
  for (const Span& field : fields) {
    if (field.begin < bytes && bytes < field.end) return true;
  }
  return false;
}

}  // namespace stylet::c
