// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/c/refusal.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/hosts/c/short_number.h"
#include "hal/hosts/c/sized.h"

namespace stylet::c {
namespace {

// Text into an array, as much as it holds.
template <std::size_t kBytes>
class Line {
 public:
  explicit Line(char (&out)[kBytes]) : out_(out) { out_[0] = '\0'; }
  Line& operator<<(const char* text) {
    for (; *text != '\0' && length_ + 1 < kBytes; ++text) out_[length_++] = *text;
    out_[length_] = '\0';
    return *this;
  }
  Line& operator<<(std::uint64_t number) {
    char digits[21] = {};
    std::size_t first = 20;
    do {
      digits[--first] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number != 0);
    return *this << digits + first;
  }
  Line& operator<<(double number) { return *this << ShortNumber(number).text(); }

 private:
  char (&out_)[kBytes];
  std::size_t length_ = 0;
};

template <std::size_t kBytes>
void copy_text(const char* text, char (&out)[kBytes]) {
  Line(out) << text;
}

// Fields of the kernel that callers know by another name, and those of more than one number, which
// are held against their limits by one.
struct Spoken {
  std::string_view field;
  const char* name;
  const char* number;
};
constexpr const char* kVertices = "obstacle.vertices_m";
constexpr std::array<Spoken, 6> kSpoken{{
    {"breathing.period_s", "breathing_period_s", ""},
    {"breathing.amplitude_m", "breathing_amplitude_m", "length "},
    {"gravity_m_per_s2", "gravity_m_per_s2", "length "},
    {"obstacle.vertices_m", kVertices, "length "},
    {"obstacle.pose.position_m", "obstacle.pose.position_m", "length "},
    {"obstacle.pose.rotation", "obstacle.pose.rotation", "length squared "},
}};

Spoken spoken(const char* field) {
  for (const Spoken& each : kSpoken) {
    if (each.field == field) return each;
  }
  return {field, field, ""};
}

// Whether there may be several, so that the text says which: those of a simulation or a loop.
bool is_of_several(std::string_view field) {
  constexpr std::array<std::string_view, 4> kSeveral{"needle.", "obstacle.", "guard.", "hand."};
  return std::any_of(kSeveral.begin(), kSeveral.end(),
                     [&](std::string_view each) { return field.starts_with(each); });
}

stylet_status tell(stylet_refusal* refusal_out, const stylet_refusal& why) {
  if (refusal_out != nullptr) (void)give(why, refusal_out);
  return why.status;
}

}  // namespace

stylet_status refuse(stylet_refusal* refusal_out, stylet_status status) {
  stylet_refusal why = {};
  why.status = status;
  if (status != STYLET_OK) copy_text(stylet_status_name(status), why.text);
  return tell(refusal_out, why);
}

stylet_status refuse_file(stylet_refusal* refusal_out, stylet_status status, const char* path,
                          const char* reason) {
  stylet_refusal why = {};
  why.status = status;
  copy_text("file", why.place);
  copy_text(reason, why.expected);
  Line(why.text) << path << ": " << reason;
  return tell(refusal_out, why);
}

stylet_status refuse_text(stylet_refusal* refusal_out, stylet_status status, const char* place,
                          const char* text) {
  stylet_refusal why = {};
  why.status = status;
  copy_text(place, why.place);
  copy_text(text, why.text);
  return tell(refusal_out, why);
}

stylet_status refuse_missing(stylet_refusal* refusal_out, const char* place, std::uint64_t index) {
  stylet_refusal why = {};
  why.status = STYLET_ARGUMENT_MISSING;
  copy_text(place, why.place);
  why.index = index;
  copy_text("a pointer", why.expected);
  Line text(why.text);
  text << place;
  if (index != 0) text << " [" << index << "]";
  text << ": null: expected " << why.expected;
  return tell(refusal_out, why);
}

stylet_status refuse_value(stylet_refusal* refusal_out, stylet_status status, const char* place,
                           double value, const char* expected) {
  stylet_refusal why = {};
  why.status = status;
  copy_text(place, why.place);
  why.value = value;
  copy_text(expected, why.expected);
  Line(why.text) << place << ": " << value << ": expected " << expected;
  return tell(refusal_out, why);
}

stylet_status refuse_memory(stylet_refusal* refusal_out, std::uint64_t bytes,
                            std::uint64_t needed_bytes) {
  stylet_refusal why = {};
  why.status = STYLET_MEMORY_TOO_SMALL;
  copy_text("bytes", why.place);
  why.value = static_cast<double>(bytes);
  why.least = why.most = static_cast<double>(needed_bytes);
  copy_text("what stylet_simulation_bytes says, or more", why.expected);
  Line(why.text) << "bytes: " << bytes << ": expected " << needed_bytes << " or more";
  return tell(refusal_out, why);
}

stylet_status refuse_unready(stylet_refusal* refusal_out, stylet_status status) {
  if (status == STYLET_ARGUMENT_MISSING) return refuse_missing(refusal_out, "simulation");
  stylet_refusal why = {};
  why.status = status;
  copy_text("simulation", why.place);
  copy_text("one that no loop has", why.expected);
  Line(why.text) << "simulation: " << stylet_status_name(status) << ": expected " << why.expected;
  return tell(refusal_out, why);
}

stylet_status refuse_size(stylet_refusal* refusal_out, const char* place, std::uint32_t bytes,
                          std::uint32_t known_bytes, std::uint64_t index) {
  stylet_refusal why = {};
  why.status = STYLET_STRUCT_SIZE_UNKNOWN;
  Line(why.place) << place << ".struct_bytes";
  why.index = index;
  why.value = bytes;
  Line expected(why.expected);
  expected << "sizeof the struct, here " << std::uint64_t{known_bytes};
  if (bytes > known_bytes) expected << "; behind that zeros";
  Line text(why.text);
  text << why.place;
  if (index != 0) text << " [" << index << "]";
  text << ": " << std::uint64_t{bytes} << ": expected " << why.expected;
  return tell(refusal_out, why);
}

stylet_status refuse_organ(stylet_refusal* refusal_out, const OrganRefusal& of) {
  stylet_refusal why = {};
  why.status = static_cast<stylet_status>(of.status);
  copy_text(of.place, why.place);
  why.index = of.index;
  why.value = of.value;
  copy_text(of.expected, why.expected);
  Line(why.text) << of.place << " " << of.index << ": " << of.value << ": expected " << of.expected
                 << " (" << status_name(of.status) << ")";
  return tell(refusal_out, why);
}

stylet_status refuse_config(stylet_refusal* refusal_out, Status status, const ConfigRefusal& of) {
  if (of.field[0] == '\0') return refuse(refusal_out, static_cast<stylet_status>(status));
  stylet_refusal why = {};
  why.status = static_cast<stylet_status>(status);
  const Spoken field = spoken(of.field);
  copy_text(field.name, why.place);
  why.index = of.index;
  why.value = of.value;
  why.least = of.least;
  why.most = of.most;
  Line text(why.text);
  text << field.name;
  if (is_of_several(field.name)) text << " [" << std::uint64_t{of.index} << "]";
  text << ": ";
  if (field.name == kVertices) text << "vertex " << std::uint64_t{of.vertex} << ": ";
  text << field.number << static_cast<double>(of.value) << ": expected "
       << static_cast<double>(of.least) << " to " << static_cast<double>(of.most);
  return tell(refusal_out, why);
}

stylet_status told(const FirstOutside& first, stylet_refusal* refusal_out) {
  ConfigRefusal why = {};
  const Status status = first.status(&why);
  if (status == Status::kOk) return STYLET_OK;
  return refuse_config(refusal_out, status, why);
}

}  // namespace stylet::c
