// SPDX-License-Identifier: Apache-2.0
#include "hal/record/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

namespace stylet::hal {
namespace {

constexpr std::uint64_t kBlock = 4096;

// A column's value as text, with its bits where decimals could hide a difference.
std::string text_of(const Column& column, const TickRecord& record) {
  const auto* at = reinterpret_cast<const std::byte*>(&record) + column.offset;
  std::string text;
  for (std::uint32_t i = 0; i < column.width; ++i, at += column_bytes(column.type)) {
    if (i > 0) text += ", ";
    if (column.type == ColumnType::kFloat32) {
      float value;
      std::uint32_t bits;
      std::memcpy(&value, at, sizeof value);
      std::memcpy(&bits, at, sizeof bits);
      text += fmt::format("{:.9g} (0x{:08x})", static_cast<double>(value), bits);
    } else {
      std::uint64_t value = 0;
      std::memcpy(&value, at, column_bytes(column.type));
      text += fmt::format("{}", value);
    }
  }
  return text;
}

bool same_bits(const Column& column, const TickRecord& a, const TickRecord& b) {
  return std::memcmp(reinterpret_cast<const std::byte*>(&a) + column.offset,
                     reinterpret_cast<const std::byte*>(&b) + column.offset,
                     column.width * column_bytes(column.type)) == 0;
}

// Columns that a kernel decides: the outputs, and the hash of the state where it was taken.
bool compared(const Column& column, const TickRecord& recorded) {
  const std::string_view name = column.name;
  return name.starts_with("output/") || (name.starts_with("flow/") && name != "flow/plunger_n") ||
         (name == "loop/state_hash" && recorded.state_hash != 0);
}

const Column* first_difference(const TickRecord& recorded, const TickRecord& replayed) {
  for (const Column& column : tick_columns()) {
    if (compared(column, recorded) && !same_bits(column, recorded, replayed)) return &column;
  }
  return nullptr;
}

// Replays one tick of all needles. False if any output differs; then `result` says where.
bool replay_tick(const std::vector<std::vector<TickRecord>>& recorded, std::uint64_t row,
                 Kernel& kernel, ReplayResult& result) {
  std::array<Input, kMaxNeedles> inputs;
  std::array<Output, kMaxNeedles> outputs;
  const std::size_t needles = recorded.size();
  for (std::size_t i = 0; i < needles; ++i) inputs[i] = recorded[i][row].input;
  tick(kernel, std::span(inputs).first(needles), std::span(outputs).first(needles));
  ++result.ticks;
  const std::uint64_t state_hash = recorded[0][row].state_hash != 0 ? hash(kernel) : 0;
  for (std::size_t i = 0; i < needles; ++i) {
    TickRecord replayed{};
    replayed.output = outputs[i];
    replayed.state_hash = state_hash;
    const Column* column = first_difference(recorded[i][row], replayed);
    if (column == nullptr) continue;
    result.tick = result.ticks;
    result.field = i == 0 ? column->name : fmt::format("needle{}/{}", i, column->name);
    result.recorded = text_of(*column, recorded[i][row]);
    result.replayed = text_of(*column, replayed);
    return false;
  }
  return true;
}

}  // namespace

ReplayResult replay(const RecordingReader& recording, Kernel& kernel,
                    const std::function<void(std::uint64_t)>& progress) {
  ReplayResult result;
  const std::uint32_t needles = recording.info().config.needle_count;
  std::vector<std::vector<TickRecord>> blocks(needles);
  while (result.ticks < recording.ticks()) {
    const std::uint64_t rows = std::min(kBlock, recording.ticks() - result.ticks);
    for (std::uint32_t i = 0; i < needles; ++i) {
      blocks[i].resize(rows);
      recording.read(result.ticks, blocks[i], i);
    }
    for (std::uint64_t row = 0; row < rows; ++row) {
      if (!replay_tick(blocks, row, kernel, result)) return result;
    }
    if (progress) progress(result.ticks);
  }
  result.state_hash = hash(kernel);
  result.same = recording.info().unfinished ||  // the final hash is missing
                result.state_hash == recording.info().final_state_hash;
  if (!result.same) {
    result.tick = result.ticks;
    result.field = "final_state_hash";
    result.recorded = fmt::format("{:016x}", recording.info().final_state_hash);
    result.replayed = fmt::format("{:016x}", result.state_hash);
  }
  return result;
}

std::string find_recorded_organ(const std::string& recording_path, const RecordingInfo& info,
                                const std::string& given) {
  namespace fs = std::filesystem;
  if (!given.empty()) return given;
  const fs::path recorded = info.organ_file;
  const fs::path beside = fs::path(recording_path).parent_path() / recorded.filename();
  for (const fs::path& each : {recorded, beside}) {
    std::error_code ignored;
    if (fs::is_regular_file(each, ignored)) return each.string();
  }
  throw LoadError(fmt::format("{}: organ \"{}\": neither {} nor {} is there: give it with --organ",
                              recording_path, info.organ_name, recorded.string(), beside.string()));
}

OrganFile load_recorded_organ(const std::string& recording_path, const RecordingInfo& info,
                              const std::string& given) {
  OrganFile organ = load_organ(find_recorded_organ(recording_path, info, given));
  if (organ.organ.hash == info.organ_hash) return organ;
  throw LoadError(fmt::format("{}: organ hash: {:016x}: expected {:016x}, that of \"{}\"",
                              organ.path, organ.organ.hash, info.organ_hash, info.organ_name));
}

}  // namespace stylet::hal
