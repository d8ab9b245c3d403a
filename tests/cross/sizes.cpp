// SPDX-License-Identifier: Apache-2.0
// What `sizes` says of lattices that need more bytes than 32 bits can count, and of some with
// voxels far apart that do not. Prints a line for each, with the status and the bytes of the three
// blocks (of the model without its head). The lattices that fit are also created and ticked.
#include <cstdio>
#include <random>
#include <vector>

#include "session.h"
#include "sparse_organ.h"
#include "state/layout.h"

namespace {

using namespace stylet;
using namespace stylet::test;

using Runs = std::vector<format::Run>;

// So many runs of one voxel with `gap` empty ones between them, in rows of 65535 that lie two
// apart.
Runs comb(std::uint32_t voxels, std::uint32_t gap) {
  Runs runs;
  std::uint32_t x = 0, y = 0;
  for (std::uint32_t i = 0; i < voxels; ++i, x += gap + 1) {
    if (x >= 65535) {
      x = 0;
      y += 2;
    }
    runs.emplace_back(static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                      std::uint16_t{0}, std::uint16_t{1});
  }
  return runs;
}

Runs rows_of_two(std::uint16_t rows, std::uint16_t planes) {
  Runs runs;
  for (std::uint16_t z = 0; z < planes; ++z) {
    for (std::uint16_t y = 0; y < rows; ++y) {
      runs.emplace_back(std::uint16_t{0}, y, z, std::uint16_t{1});
      runs.emplace_back(std::uint16_t{65534}, y, z, std::uint16_t{1});
    }
  }
  return runs;
}

// Bytes of the model without its head, which holds addresses and so is smaller on 32-bit targets.
std::size_t rest_of_model(std::size_t model_bytes) {
  constexpr std::size_t kHead =
      (sizeof(ModelHead) + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
  return model_bytes > kHead ? model_bytes - kHead : 0;
}

void show(const char* name, const Runs& runs, bool run) {
  const auto opened = open_organ(organ_of_runs(runs));
  Sizes need = {};
  const Status status = sizes(opened->organ, Config{}, need);
  std::printf("%s %u %llu %llu %llu\n", name, static_cast<unsigned>(status),
              static_cast<unsigned long long>(rest_of_model(need.model_bytes)),
              static_cast<unsigned long long>(need.state_bytes),
              static_cast<unsigned long long>(need.scratch_bytes));
  if (!run) return;
  Session session = make_session(opened->organ, Config{});
  (void)tick(session.kernel, Input{});
  std::printf("%s hash %016llx\n", name, static_cast<unsigned long long>(hash(session.kernel)));
}

}  // namespace

int main() {
  show("rows-64", rows_of_two(64, 1), true);
  show("rows-65536", rows_of_two(1024, 64), false);
  show("comb-20000", comb(20'000, 7), true);
  show("comb-3000000", comb(3'000'000, 7), false);
  show("lone-2000000", comb(2'000'000, 8), false);
  return 0;
}
