// SPDX-License-Identifier: Apache-2.0
// Plays a recorded insertion and prints what became of the state. The same source on every target,
// with or without an operating system: memory is static, text goes out through platform.h.
//
// usage: replay CASE hashes EVERY FIRST LAST   hash after every EVERY-th tick, and the events
//        replay CASE costs                     instructions of every tick
//        replay CASE state TICK                snapshot after that tick, in hexadecimal
#include <cstring>

#include "case.h"
#include "platform.h"

extern "C" {
extern const std::byte blob_organ[], blob_organ_end[];
extern const std::byte blob_physical[], blob_physical_end[];
extern const std::byte blob_paper[], blob_paper_end[];
extern const std::byte blob_elastic[], blob_elastic_end[];
extern const std::byte blob_added_mass[], blob_added_mass_end[];
extern const std::byte blob_stiffening_organ[], blob_stiffening_organ_end[];
extern const std::byte blob_stiffening[], blob_stiffening_end[];
extern const std::byte blob_sliding_organ[], blob_sliding_organ_end[];
extern const std::byte blob_sliding[], blob_sliding_end[];
}

namespace stylet::test {
namespace {

// What 288 voxels need; `create` refuses if it is too little.
alignas(kBlockAlignment) std::byte model[128 * 1024];
alignas(kBlockAlignment) std::byte state[192 * 1024];
alignas(kBlockAlignment) std::byte scratch[336 * 1024];
alignas(8) std::byte saved[sizeof state + 64];

struct Blob {
  const char* name;
  const std::byte *begin, *end, *organ, *organ_end;
};
constexpr Blob kCases[] = {
    {"physical", blob_physical, blob_physical_end, blob_organ, blob_organ_end},
    {"paper", blob_paper, blob_paper_end, blob_organ, blob_organ_end},
    {"elastic", blob_elastic, blob_elastic_end, blob_organ, blob_organ_end},
    {"added_mass", blob_added_mass, blob_added_mass_end, blob_organ, blob_organ_end},
    {"stiffening", blob_stiffening, blob_stiffening_end, blob_stiffening_organ,
     blob_stiffening_organ_end},
    {"sliding", blob_sliding, blob_sliding_end, blob_sliding_organ, blob_sliding_organ_end}};

std::span<const std::byte> bytes_of(const std::byte* begin, const std::byte* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

bool same(const char* a, const char* b) {
  return std::strcmp(a, b) == 0;
}

void put_number(std::uint64_t value) {
  char text[21] = {};
  char* at = text + 20;
  do {
    *--at = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  put(at);
}

void put_hex(std::uint64_t value, int digits) {
  char text[17] = {};
  for (int i = digits - 1; i >= 0; --i, value >>= 4U) text[i] = "0123456789abcdef"[value & 15U];
  put(text);
}

void put_line(const char* word, std::uint64_t number, std::uint64_t value) {
  put(word);
  put(" ");
  put_number(number);
  put(" ");
  put_number(value);
  put("\n");
}

std::uint32_t number_of(const char* text) {
  std::uint32_t value = 0;
  for (; *text >= '0' && *text <= '9'; ++text) {
    value = 10 * value + static_cast<std::uint32_t>(*text - '0');
  }
  return value;
}

int fail(const char* why) {
  put(why);
  put("\n");
  return 1;
}

struct Replay {
  Organ organ;
  Case recorded;
  Kernel kernel;
};
Replay replaying;

const char* open(const char* name) {
  Replay& r = replaying;
  const Blob* chosen = nullptr;
  for (const Blob& blob : kCases) chosen = same(blob.name, name) ? &blob : chosen;
  if (chosen == nullptr) return "no such case";
  if (!open_case(bytes_of(chosen->begin, chosen->end), r.recorded)) return "case of another layout";
  const std::span<const std::byte> organ = bytes_of(chosen->organ, chosen->organ_end);
  if (organ_open(organ, r.organ) != Status::kOk) return "bad organ";
  if (create(r.organ, *r.recorded.config, {model, state, scratch}, r.kernel) != Status::kOk) {
    return "the kernel was refused";
  }
  if (set_obstacles(r.kernel, r.recorded.obstacles) != Status::kOk) return "bad obstacles";
  return nullptr;
}

void print_hash(std::uint32_t number) {
  put("hash ");
  put_number(number);
  put(" ");
  put_hex(hash(replaying.kernel), 16);
  put("\n");
}

int print_hashes(std::uint32_t every, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t i = 1; i <= last && i <= replaying.recorded.inputs.size(); ++i) {
    tick(replaying.kernel, replaying.recorded.inputs[i - 1]);
    if (i >= first && i % every == 0) print_hash(i);
  }
  Event seen[kMaxEvents];
  const std::uint32_t count = events(replaying.kernel, seen);
  for (std::uint32_t i = 0; i < count; ++i) {
    put("event ");
    put(event_name(seen[i].kind));
    put(" ");
    put_number(seen[i].tick);
    put("\n");
  }
  return 0;
}

int print_costs() {
  std::uint32_t number = 0;
  for (const Input& input : replaying.recorded.inputs) {
    const std::uint32_t before = clock();
    const Output out = tick(replaying.kernel, input);
    const std::uint32_t cost = (clock() - before) % kClockWrap;
    put(out.phase == Phase::kFree ? "free" : "busy");
    put_line("", ++number, cost);
  }
  return 0;
}

int print_state(std::uint32_t last) {
  for (std::uint32_t i = 0; i < last && i < replaying.recorded.inputs.size(); ++i) {
    tick(replaying.kernel, replaying.recorded.inputs[i]);
  }
  if (snapshot(replaying.kernel, saved) != Status::kOk) return fail("no room for a snapshot");
  const std::size_t size = snapshot_bytes(replaying.kernel);
  for (std::size_t i = 0; i < size; i += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, saved + i, 4);
    put_hex(word, 8);
    if (i % 64 == 60) put("\n");
  }
  put("\n");
  return 0;
}

}  // namespace

int replay(const Words& words) {
  if (words.count < 2) return fail("expected a case and what to print");
  const char* refused = open(words.word[0]);
  if (refused != nullptr) return fail(refused);
  const auto number = [&words](int i) { return number_of(words.word[i]); };
  if (same(words.word[1], "hashes") && words.count == 5 && number(2) > 0) {
    return print_hashes(number(2), number(3), number(4));
  }
  if (same(words.word[1], "costs") && words.count == 2) return print_costs();
  if (same(words.word[1], "state") && words.count == 3) return print_state(number(2));
  return fail("expected hashes EVERY FIRST LAST, costs, or state TICK");
}

}  // namespace stylet::test
