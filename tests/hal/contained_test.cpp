// SPDX-License-Identifier: Apache-2.0
// Exceptions that must not leave a thread, and a recorder without memory.
#include "hal/base/contained.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "hal/record/recorder.h"

namespace stylet::hal {
namespace {

TEST(Contained, LetsNothingOut) {
  EXPECT_TRUE(contained("test", [] {}));
  EXPECT_FALSE(contained("test", [] { throw std::bad_alloc(); }));
  EXPECT_FALSE(contained("test", [] { throw std::runtime_error("an error"); }));
  testing::internal::CaptureStderr();
  EXPECT_FALSE(contained("test", [] { throw 28; }));
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "stylet: test: an exception of unknown type was thrown\n");
  testing::internal::CaptureStderr();
  for (int i = 0; i < 100; ++i) (void)contained("test", [] { throw 28; });
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_LE(std::count(told.begin(), told.end(), '\n'), kMostEscapesTold);
}

// A writer that waits for room in the ring looks at this flag.
TEST(Recorder, SaysWhyItsThreadEnded) {
  Ring<TickRecord> records(8);
  Ring<Event> events(8);
  const Course course = {{}, {1, 0, 0}};
  Recorder recorder(
      records, events, nullptr, std::span(&course, 1), nullptr, nullptr,
      [](std::span<const TickRecord>, std::span<const Event>) { throw std::bad_alloc(); });
  EXPECT_FALSE(recorder.failed());
  EXPECT_TRUE(records.push({}));
  while (!recorder.failed()) std::this_thread::yield();
  recorder.stop();
  EXPECT_EQ(recorder.error(), "out of memory");
}

}  // namespace
}  // namespace stylet::hal
