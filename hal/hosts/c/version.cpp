// SPDX-License-Identifier: Apache-2.0
// Names and numbers of the library itself.
#include <array>

#include "stylet/kernel.h"
#include "stylet/stylet.h"

#define STYLET_TEXT_OF(number) #number
#define STYLET_TEXT(number) STYLET_TEXT_OF(number)

namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#elif defined(__GNUC__)
constexpr const char* kCompiler = "gcc " __VERSION__;
#else
constexpr const char* kCompiler = "another compiler";
#endif

// Once, when the library is loaded: the processor does not change.
struct BuildText {
  std::array<char, 96> text = {};
  BuildText() {
    std::size_t at = 0;
    for (const char* part : {kCompiler, ", ", stylet::instruction_set()}) {
      for (; *part != '\0' && at + 1 < text.size(); ++part) text[at++] = *part;
    }
  }
};
const BuildText kBuild;

}  // namespace

uint32_t stylet_version(void) {
  return STYLET_VERSION_MAJOR << 16U | STYLET_VERSION_MINOR << 8U | STYLET_VERSION_PATCH;
}

const char* stylet_version_text(void) {
  return STYLET_TEXT(STYLET_VERSION_MAJOR) "." STYLET_TEXT(STYLET_VERSION_MINOR) "." STYLET_TEXT(
      STYLET_VERSION_PATCH);
}

const char* stylet_build_text(void) {
  return kBuild.text.data();
}

uint64_t stylet_state_layout(void) {
  return stylet::state_layout();
}

const char* stylet_event_name(uint32_t kind) {
  return stylet::event_name(static_cast<stylet::EventKind>(kind));
}

const char* stylet_status_name(stylet_status status) {
  switch (status) {
    case STYLET_ARGUMENT_MISSING:
      return "a required pointer is null";
    case STYLET_STRUCT_SIZE_UNKNOWN:
      return "struct_bytes was not set, or a field is set that this library does not know";
    case STYLET_OUT_OF_MEMORY:
      return "out of memory";
    case STYLET_FILE_UNREADABLE:
      return "file cannot be read";
    case STYLET_CONTENT_DAMAGED:
      return "the bytes do not match the checksum in the file";
    case STYLET_ARGUMENT_OUT_OF_RANGE:
      return "argument out of range";
    case STYLET_DEVICE_FAILED:
      return "device cannot be opened or does not answer";
    case STYLET_LOOP_RUNS:
      return "a loop has this simulation, or this loop was started before";
    default:
      return stylet::status_name(static_cast<stylet::Status>(status));
  }
}
