// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/names.h"

#include <expat.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>
#include <set>
#include <type_traits>
#include <utility>

#include "maps/readers.h"

namespace stylet::offline {
namespace {

// The words of a name in lower case, sorted.
std::vector<std::string> essence(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char each : name) {
    const auto c = static_cast<unsigned char>(each);
    constexpr unsigned char kAscii = 128;
    if (c >= kAscii || std::isalnum(c) != 0) {
      words.back() += static_cast<char>(std::tolower(c));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  std::sort(words.begin(), words.end());
  return words;
}

// Number of bytes of the first character; 0 if it is not valid UTF-8.
std::size_t character_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t size = byte(0) < 0x80                       ? 1
                           : byte(0) >= 0xC2 && byte(0) < 0xE0  ? 2
                           : byte(0) >= 0xE0 && byte(0) < 0xF0  ? 3
                           : byte(0) >= 0xF0 && byte(0) <= 0xF4 ? 4
                                                                : 0;
  if (size == 0 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  }
  // Overlong forms, surrogates, and code points above the last one.
  const bool wrong = (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) > 0x9F) ||
                     (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) > 0x8F);
  return wrong ? 0 : size;
}

// State of the parser: names so far, and whether it is between <Label Key="N"> and its end.
struct LabelTable {
  std::vector<std::pair<std::uint16_t, std::string>> names;
  bool is_open = false;
};

void on_start(void* user, const XML_Char* element, const XML_Char** attributes) {
  auto& table = *static_cast<LabelTable*>(user);
  table.is_open = false;
  if (std::string_view(element) != "Label") return;
  std::uint16_t open = 0;  // 0: none
  for (; attributes[0] != nullptr; attributes += 2) {
    if (std::string_view(attributes[0]) != "Key") continue;
    const std::string_view key = attributes[1];
    std::uint16_t label = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), label);
    if (error == std::errc{} && end == key.data() + key.size()) open = label;
  }
  table.is_open = open != 0;
  if (table.is_open) table.names.emplace_back(open, "");
}

void on_text(void* user, const XML_Char* text, int size) {
  auto& table = *static_cast<LabelTable*>(user);
  if (table.is_open) table.names.back().second.append(text, static_cast<std::size_t>(size));
}

void on_end(void* user, const XML_Char* /*element*/) {
  static_cast<LabelTable*>(user)->is_open = false;
}

// Whether a key is SegmentN_FIELD; if so, N is put into `number`.
bool is_segment(std::string_view key, std::string_view field, std::size_t& number) {
  constexpr std::string_view kWord = "Segment";
  if (!key.starts_with(kWord) || !key.ends_with(field)) return false;
  key.remove_prefix(kWord.size());
  key.remove_suffix(std::min(key.size(), field.size()));
  // Later the fields of segment N are looked for with N as it is usually written, so not with "01".
  if (key.starts_with('0') && key != "0") return false;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
  return error == std::errc{} && end == key.data() + key.size();
}

std::int64_t remark_number(const std::string& path, const Claim& claim, const std::string& key,
                           std::int64_t most, std::int64_t otherwise) {
  const auto found = claim.remarks.find(key);
  if (found == claim.remarks.end()) return otherwise;
  const std::string_view text = trimmed(found->second);
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0 || number > most) {
    refuse("{}: {}:={}: expected a whole number from 0 to {}", path, key, text, most);
  }
  return number;
}

}  // namespace

bool is_same_name(std::string_view a, std::string_view b) {
  return essence(a) == essence(b);
}

std::vector<std::uint16_t> labels_named(const LabelNames& names, std::string_view name) {
  std::vector<std::uint16_t> exact, same;
  for (const auto& [label, each] : names) {
    if (each == name) exact.push_back(label);
    if (is_same_name(each, name)) same.push_back(label);
  }
  return exact.empty() ? same : exact;
}

std::string printable(std::string_view name) {
  std::string out;
  while (!name.empty()) {
    const std::size_t size = character_bytes(name);
    const auto first = static_cast<unsigned char>(name.front());
    constexpr unsigned char kDelete = 127;
    out += size == 0 || first < ' ' || first == kDelete ? "?" : name.substr(0, size);
    name.remove_prefix(std::max<std::size_t>(1, size));
  }
  return out;
}

void require_short(const std::string& path, std::string_view name) {
  constexpr std::size_t kMostBytes = 1024, kShown = 40;  // DICOM has room for 64 characters
  if (name.size() <= kMostBytes) return;
  refuse("{}: a label's name {}... has {} bytes: expected at most {}", path,
         printable(name.substr(0, kShown)), name.size(), kMostBytes);
}

void name_label(const std::string& path, LabelMap& map, std::uint16_t label,
                std::string_view name) {
  const std::string plain(trimmed(name));
  if (plain.empty()) return;
  require_short(path, plain);
  const auto [named, is_new] = map.names.emplace(label, plain);
  if (is_new || named->second == plain) return;
  refuse("{}: label {} is called {} and {}: expected one name for each label", path, label,
         printable(named->second), printable(plain));
}

void read_label_table(const std::string& path, std::string_view xml, LabelMap& map) {
  using Parser = std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)>;
  const Parser parser(XML_ParserCreate("UTF-8"), &XML_ParserFree);
  LabelTable table;
  XML_SetUserData(parser.get(), &table);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  if (XML_Parse(parser.get(), xml.data(), static_cast<int>(xml.size()), 1) == XML_STATUS_ERROR) {
    map.notes.push_back(fmt::format("{}: the names of its labels cannot be read: line {}: {}", path,
                                    XML_GetCurrentLineNumber(parser.get()),
                                    XML_ErrorString(XML_GetErrorCode(parser.get()))));
    return;
  }
  for (const auto& [label, name] : table.names) name_label(path, map, label, name);
}

std::vector<Segment> slicer_segments(const std::string& path, const Claim& claim,
                                     std::size_t layers) {
  constexpr std::int64_t kMostLabel = 65535;
  std::set<std::size_t> numbers;
  for (const auto& [key, value] : claim.remarks) {
    std::size_t number = 0;
    if (is_segment(key, "_ID", number) || is_segment(key, "_Name", number)) numbers.insert(number);
  }
  std::vector<Segment> segments;
  for (const std::size_t number : numbers) {
    const std::string key = fmt::format("Segment{}", number);
    const auto last = static_cast<std::int64_t>(layers) - 1;
    Segment segment;
    // Slicer before 4.11 gave each segment its own layer, and wrote neither layer nor value.
    const std::int64_t own =
        std::min<std::int64_t>(static_cast<std::int64_t>(segments.size()), last);
    segment.layer = static_cast<std::size_t>(remark_number(path, claim, key + "_Layer", last, own));
    segment.value =
        static_cast<std::uint16_t>(remark_number(path, claim, key + "_LabelValue", kMostLabel, 1));
    const auto name = claim.remarks.find(key + "_Name"), id = claim.remarks.find(key + "_ID");
    segment.name = trimmed(name != claim.remarks.end() ? name->second : id->second);
    require_short(path, segment.name);
    if (segment.value == 0) {
      refuse("{}: {}_LabelValue 0: expected 1 to {}, as 0 is no segment", path, key, kMostLabel);
    }
    for (const Segment& other : segments) {
      if (other.layer != segment.layer || other.value != segment.value) continue;
      refuse("{}: {}: label value {} of layer {} is {} already: expected one name for each", path,
             key, segment.value, segment.layer, other.name);
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

void take_segments(const std::string& path, const std::vector<Segment>& segments,
                   std::size_t layers, LabelMap& map) {
  if (layers == 1) {
    for (const Segment& segment : segments) map.names[segment.value] = segment.name;
    map.names.erase(0);
    return;
  }
  if (segments.empty() || segments.size() > kMostLabels) {
    refuse(
        "{}: {} values a voxel and {} segments: expected labels, which have one value a voxel, or "
        "the layers of a segmentation of 3D Slicer with SegmentN_Name",
        path, layers, segments.size());
  }
  // For each layer: the number of the segment that each value means.
  std::vector<std::map<std::uint16_t, std::uint16_t>> number_of(layers);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto number = static_cast<std::uint16_t>(i + 1);
    number_of[segments[i].layer][segments[i].value] = number;
    map.names[number] = segments[i].name;
  }
  const std::vector<std::uint16_t> stacked = std::move(map.label);
  map.label.assign(stacked.size() / layers, 0);
  std::size_t shared = 0;
  std::size_t nameless = 0, first_layer = 0;  // voxels whose value is no segment's; of the first
  std::uint16_t first_value = 0;
  for (std::size_t i = 0; i < map.label.size(); ++i) {
    std::size_t claims = 0;
    for (std::size_t layer = 0; layer < layers; ++layer) {
      const std::uint16_t value = stacked[i * layers + layer];
      if (value == 0) continue;
      const auto found = number_of[layer].find(value);
      if (found == number_of[layer].end()) {
        if (nameless++ > 0) continue;
        first_layer = layer;
        first_value = value;
        continue;
      }
      map.label[i] = std::max(map.label[i], found->second);
      ++claims;
    }
    shared += claims > 1 ? 1 : 0;
  }
  if (shared > 0) {
    map.notes.push_back(
        fmt::format("{}: {} voxels lie in several segments: each was given to the one listed last",
                    path, shared));
  }
  if (nameless > 0) {
    map.notes.push_back(
        fmt::format("{}: {} voxels have a value that no segment of their layer has (first {} in "
                    "layer {}): left "
                    "out",
                    path, nameless, first_value, first_layer));
  }
}

}  // namespace stylet::offline
