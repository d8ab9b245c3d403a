// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/dicom_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "base/refusal.h"
#include "maps/names.h"

namespace stylet::offline {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string name_of(const DcmTagKey& tag) {
  return DcmTag(tag).getTagName();
}

// Only blanks pad a number (PS3.5, 6.2); zeros, which some write behind the last one, are gone.
std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 60;
  const std::string_view head = without_blanks(text).substr(0, kMost);
  return printable(head) + (without_blanks(text).size() > kMost ? "..." : "");
}

// The first value of a list, without what follows. A value that does not end within
// kMostNumberBytes is not a number.
std::string_view first_of(std::string_view list) {
  const std::string_view head = list.substr(0, kMostNumberBytes + 1);
  return head.substr(0, head.find('\\'));
}

std::optional<double> decimal(std::string_view text) {
  if (text.size() > kMostNumberBytes) return std::nullopt;
  std::string_view word = without_blanks(text);
  // from_chars knows no plus, but infinities.
  if (word.find_first_not_of("+-.0123456789Ee") != std::string_view::npos) return std::nullopt;
  if (word.starts_with("+") && !word.starts_with("+-")) word.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

double number_in(const std::string& where, const DcmTagKey& tag, std::size_t place,
                 std::string_view value) {
  const std::optional<double> number = decimal(value);
  if (number) return *number;
  if (without_blanks(value).empty()) {
    refuse("{}: {}: value {} is empty: expected a number", where, name_of(tag), place + 1);
  }
  refuse("{}: {} {}: expected a number, as 12, -1.5 or 2.5e-3", where, name_of(tag), shown(value));
}

// The most values that an attribute has; all there may be, if it is not known.
std::size_t most_values(const DcmTagKey& tag) {
  const DcmDictEntry* const entry = dcmDataDict.rdlock().findEntry(tag, nullptr);
  const int most = entry == nullptr ? DcmVariableVM : entry->getVMMax();
  dcmDataDict.rdunlock();
  return most == DcmVariableVM ? std::string_view::npos : static_cast<std::size_t>(most);
}

double number_of_text(const std::string& where, const DcmTagKey& tag, std::size_t place,
                      std::string_view text) {
  const std::size_t most = most_values(tag);
  double number = kNone;
  std::string_view rest = text;
  for (std::size_t i = 0; i < most; ++i) {
    const std::string_view value = first_of(rest);
    const double each = number_in(where, tag, i, value);
    if (i == place) number = each;
    if (value.size() == rest.size()) return number;
    rest.remove_prefix(value.size() + 1);
  }
  refuse("{}: {} {}: expected at most {} numbers", where, name_of(tag), shown(text), most);
}

double finite(const std::string& where, const DcmTagKey& tag, double number) {
  if (std::isfinite(number)) return number;
  refuse("{}: {} {}: expected a number", where, name_of(tag), number);
}

double number_of_bytes(const std::string& where, const DcmTagKey& tag, std::size_t place,
                       DcmElement& element) {
  if (place >= element.getVM()) return kNone;
  const std::size_t most = most_values(tag);
  if (element.getVM() > most) {
    refuse("{}: {}: {} values: expected at most {} numbers", where, name_of(tag), element.getVM(),
           most);
  }
  Float64 number = 0;
  Float32 single = 0;
  Uint16 count = 0;
  Sint16 whole = 0;
  Uint32 long_count = 0;
  Sint32 long_whole = 0;
  if (element.getFloat64(number, place).good()) return finite(where, tag, number);
  if (element.getFloat32(single, place).good())
    return finite(where, tag, static_cast<double>(single));
  if (element.getUint16(count, place).good()) return count;
  if (element.getSint16(whole, place).good()) return whole;
  if (element.getUint32(long_count, place).good()) return long_count;
  if (element.getSint32(long_whole, place).good()) return long_whole;
  refuse("{}: {} of kind {}: expected a number", where, name_of(tag),
         DcmVR(element.ident()).getVRName());
}

bool is_whole(const DcmTagKey& tag) {
  const DcmEVR kind = DcmTag(tag).getEVR();
  constexpr DcmEVR kWhole[] = {EVR_IS, EVR_US, EVR_SS, EVR_UL, EVR_SL, EVR_xs};
  return std::ranges::find(kWhole, kind) != std::end(kWhole);
}

// The text of an element, if it is of a kind that has text.
std::optional<std::string_view> text_in(DcmElement& element) {
  auto* const text = dynamic_cast<DcmByteString*>(&element);
  char* bytes = nullptr;
  Uint32 size = 0;
  if (text == nullptr) return std::nullopt;
  if (text->getString(bytes, size).bad() || bytes == nullptr) return std::string_view{};
  return std::string_view(bytes, size);
}

}  // namespace

double number_of(const std::string& where, DcmItem& item, const DcmTagKey& tag,
                 unsigned long place) {
  DcmElement* element = nullptr;
  if (item.findAndGetElement(tag, element).bad()) return kNone;
  if (element->getLength() == 0) return kNone;  // DCMTK counts no blanks behind a text
  const std::optional<std::string_view> text = text_in(*element);
  const double number = text ? number_of_text(where, tag, place, *text)
                             : number_of_bytes(where, tag, place, *element);
  if (number != std::floor(number) && !std::isnan(number) && is_whole(tag)) {
    refuse("{}: {} {}: expected a whole number", where, name_of(tag), number);
  }
  return number;
}

std::vector<double> numbers_of_points(const std::string& where, DcmItem& item,
                                      const DcmTagKey& tag) {
  std::vector<double> numbers;
  DcmElement* element = nullptr;
  if (item.findAndGetElement(tag, element).bad()) return numbers;
  std::string_view rest = text_in(*element).value_or("");
  if (without_blanks(rest).empty()) return numbers;
  while (true) {
    const std::string_view value = first_of(rest);
    if (const std::optional<double> number = decimal(value)) {
      numbers.push_back(*number);
    } else {
      const std::string point = fmt::format("{}: point {}", where, numbers.size() / 3);
      (void)number_in(point, tag, numbers.size(), value);
    }
    if (value.size() == rest.size()) return numbers;
    rest.remove_prefix(value.size() + 1);
  }
}

}  // namespace stylet::offline
