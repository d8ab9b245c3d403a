// SPDX-License-Identifier: Apache-2.0
// Writes what the replay matrix plays: two small organs, and for each setup of the real-time tests
// an insertion recorded from their scripted hand at four times its speed.
//
// usage: stylet_case_writer FOLDER
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

#include "case.h"
#include "session.h"
#include "two_parts.h"

namespace stylet::test {
namespace {

constexpr std::uint64_t kStride = 4;
constexpr std::uint32_t kTicks = kCycleTicks / kStride;
constexpr std::uint64_t kFirstTick = 2 * kCycleTicks;  // the insertion that meets the bone
constexpr std::uint32_t kNotANumberTick = 333;

template <typename T>
void put(std::ofstream& file, const T& value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_organ(const std::string& path, const OpenOrgan& opened) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(opened.bytes.data()),
             static_cast<std::streamsize>(opened.bytes.size()));
}

void write_case(const std::string& path, const Organ& organ, const Config& config,
                const std::vector<ObstacleConfig>& obstacles) {
  std::ofstream file(path, std::ios::binary);
  const Script script = block_script(organ, config);
  put(file, CaseHead{sizeof(Config), sizeof(ObstacleConfig), sizeof(Input),
                     static_cast<std::uint32_t>(obstacles.size()), kTicks});
  put(file, config);
  for (const ObstacleConfig& obstacle : obstacles) put(file, obstacle);
  for (std::uint32_t i = 0; i < kTicks; ++i) {
    Input input = scripted_input(script, kFirstTick + i * kStride);
    if (i == kNotANumberTick) {
      input.handle.rotation.w = std::numeric_limits<float>::quiet_NaN();
    }
    put(file, input);
  }
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  using namespace stylet::test;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  const auto opened = block_organ(6, 6, 8);
  const auto stiffening = block_organ(6, 6, 8, kStiffening);
  write_organ(folder + "/organ.bin", *opened);
  const auto sliding = sliding_organ();
  write_organ(folder + "/stiffening_organ.bin", *stiffening);
  write_organ(folder + "/sliding_organ.bin", *sliding);
  for (const Setup setup : kSetups) {
    write_case(folder + "/" + setup_name(setup) + ".bin", opened->organ, config_of(setup),
               obstacles_of(opened->organ, setup));
  }
  write_case(folder + "/stiffening.bin", stiffening->organ, stiffening_config(), {});
  write_case(folder + "/sliding.bin", sliding->organ, sliding_config(), {});
  return 0;
}
