// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/c/refusal.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/hosts/c/short_number.h"
#include "hal/hosts/c/sized.h"

namespace stylet::c {
namespace {

// Text into an array, as much as it holds.
class Line {
 public:
  template <std::size_t kBytes>
  explicit Line(char (&out)[kBytes]) : at_(out), last_(out + kBytes - 1) {
    *at_ = '\0';
  }
  Line& operator<<(const char* text) {
    while (*text != '\0' && at_ != last_) *at_++ = *text++;
    *at_ = '\0';
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
  char* at_;
  char* const last_;
};

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
  return field.starts_with("needle.") || field.starts_with("obstacle.") ||
         field.starts_with("guard.") || field.starts_with("hand.");
}

stylet_status tell(stylet_refusal* refusal_out, const stylet_refusal& why) {
  if (refusal_out != nullptr) (void)give(why, refusal_out);
  return why.status;
}

}  // namespace

stylet_status refuse(stylet_refusal* refusal_out, stylet_status status) {
  stylet_refusal why = {};
  why.status = status;
  if (status != STYLET_OK) Line(why.text) << stylet_status_name(status);
  return tell(refusal_out, why);
}

stylet_status refuse_file(stylet_refusal* refusal_out, stylet_status status, const char* path,
                          const char* reason) {
  stylet_refusal why = {};
  why.status = status;
  Line(why.place) << "file";
  Line(why.expected) << reason;
  Line(why.text) << path << ": " << reason;
  return tell(refusal_out, why);
}

stylet_status refuse_text(stylet_refusal* refusal_out, stylet_status status, const char* place,
                          const char* text) {
  stylet_refusal why = {};
  why.status = status;
  Line(why.place) << place;
  Line(why.text) << text;
  return tell(refusal_out, why);
}

stylet_status refuse_missing(stylet_refusal* refusal_out, const char* place, std::uint64_t index) {
  return refuse_value(refusal_out, STYLET_ARGUMENT_MISSING, place, 0, "a pointer", index, "null");
}

stylet_status refuse_unready(stylet_refusal* refusal_out, stylet_status status) {
  if (status == STYLET_ARGUMENT_MISSING) return refuse_missing(refusal_out, "simulation");
  return refuse_value(refusal_out, status, "simulation", 0, "one that no loop has", 0,
                      stylet_status_name(status));
}

stylet_status refuse_size(stylet_refusal* refusal_out, const char* place, std::uint32_t bytes,
                          std::uint32_t known_bytes, std::uint64_t index) {
  char field[sizeof stylet_refusal::place], expected[sizeof stylet_refusal::expected];
  Line(field) << place << ".struct_bytes";
  Line(expected) << "sizeof the struct, here " << std::uint64_t{known_bytes}
                 << (bytes > known_bytes ? ", and zeros behind that" : "");
  return refuse_value(refusal_out, STYLET_STRUCT_SIZE_UNKNOWN, field, bytes, expected, index);
}

stylet_status refuse_value(stylet_refusal* refusal_out, stylet_status status, const char* place,
                           double value, const char* expected, std::uint64_t index,
                           const char* given) {
  stylet_refusal why = {};
  why.status = status;
  Line(why.place) << place;
  why.index = index;
  why.value = value;
  Line(why.expected) << expected;
  Line text(why.text);
  text << place;
  if (index != 0) text << " [" << index << "]";
  text << ": ";
  if (given != nullptr) {
    text << given;
  } else {
    text << value;
  }
  text << ": expected " << expected;
  return tell(refusal_out, why);
}

stylet_status refuse_organ(stylet_refusal* refusal_out, const OrganRefusal& of) {
  stylet_refusal why = {};
  why.status = static_cast<stylet_status>(of.status);
  Line(why.place) << of.place;
  why.index = of.index;
  why.value = of.value;
  Line(why.expected) << of.expected;
  Line(why.text) << of.place << " " << of.index << ": " << of.value << ": expected " << of.expected
                 << " (" << status_name(of.status) << ")";
  return tell(refusal_out, why);
}

stylet_status refuse_config(stylet_refusal* refusal_out, Status status, const ConfigRefusal& of) {
  if (of.field[0] == '\0') return refuse(refusal_out, static_cast<stylet_status>(status));
  stylet_refusal why = {};
  why.status = static_cast<stylet_status>(status);
  const Spoken field = spoken(of.field);
  Line(why.place) << field.name;
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
