// SPDX-License-Identifier: Apache-2.0
// Every bound of the console, and what happens when it is reached. None of them can be felt
// by the loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace stylet::console {

constexpr std::uint32_t kProtocol = 2;
constexpr std::uint16_t kDefaultPort = 7760;

// ---- who may connect, and for how long
// Open connections of all kinds. Another one is closed at once.
constexpr std::size_t kMaxConnections = 40;
// From the first byte of a request to its last. If it takes longer: closed.
constexpr std::chrono::seconds kRequestTime{5};
// For sending an answer; each megabyte of it has one second more. If it takes longer: closed.
constexpr std::chrono::seconds kAnswerTime{10};
// Without a sign of life on a WebSocket (browsers answer pings by themselves). Longer: closed.
constexpr std::chrono::seconds kIdleTime{20};

// ---- what may be sent
// Head of a request. If longer: closed. A request has no body; one with a body is closed.
constexpr std::uint32_t kMaxHeaderBytes = 8192;
// A page's message. If longer: closed.
constexpr std::size_t kMaxMessageBytes = 4096;
// One page's messages in a second. If more: closed.
constexpr std::uint32_t kMaxMessagesPerSecond = 2000;
// A trainee's name and a teacher's mark. If longer: refused.
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::size_t kMaxMarkBytes = 500;
// From the frame that showed a fault to its acknowledgement. If later: refused, must be sent again.
// An estimate: the frame, the press of the button and their way take a tenth of it; and after a
// second a hand no longer expects that the force comes back.
constexpr double kAcknowledgeLifeS = 1;

// ---- what is kept for pages
// How often pages are served. A page that has not taken its last frame misses the next.
constexpr std::chrono::milliseconds kFramePause{16};
// Scores and marks of this session, for pages that come later. If more: the oldest is forgotten
// here; the recording keeps the first kMaxMarksKept.
constexpr std::size_t kMaxScoresKept = 32;
constexpr std::size_t kMaxMarksKept = 200;
// Messages that wait for one page, without those that greet it; and their bytes, of which a single
// message may have more. If more: closed.
constexpr std::size_t kMaxWaitingMessages = 64 + kMaxScoresKept + kMaxMarksKept;
constexpr std::size_t kMaxWaitingBytes = std::size_t{32} << 20U;
// What the system may keep for one page besides. Unless told, it keeps megabytes, and nobody would
// notice a page that never reads.
constexpr int kSendBufferBytes = 256 * 1024;
// Rows between recorder and console. When full, rows are missing in the plots, and counted.
constexpr std::size_t kRowRing = 16384;
// Rows of the running attempt. When full, the older half is forgotten.
constexpr std::size_t kMaxRowsKept = 1'000'000;
// Rows in one frame. If more: thinned out so that peaks stay.
constexpr std::uint32_t kMaxRowsPerFrame = 512;
constexpr std::uint32_t kMaxRowsPerAnswer = 20'000;
constexpr std::uint32_t kMaxRowsPerScore = 2000;
// Orders of pages that wait for the session. If more: refused.
constexpr std::size_t kMaxWaitingOrders = 64;

// ---- pictures
// Unit of a particle's displacement in a frame. Beyond 32767 units: shown at that distance.
constexpr float kPositionUnitM = 10e-6F;
constexpr std::uint32_t kTimingBins = 100;
constexpr float kTimingBinUs = 10;

// ---- playback
// Memory for snapshots of a recording's kernel. The longer the recording and the larger the organ,
// the farther apart they are; the second number is their least distance.
constexpr std::size_t kSnapshotBytes = std::size_t{512} << 20U;
constexpr std::uint64_t kLeastSnapshotTicks = 100;
// From a snapshot to a picture when playing backwards. If longer: the snapshot is shown.
constexpr double kLongestWayS = 0.05;

}  // namespace stylet::console
