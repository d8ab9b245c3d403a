// SPDX-License-Identifier: Apache-2.0
// Every bound of the console, each with what happens when it is reached. None of them can be felt
// by the loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace stylet::console {

constexpr std::uint32_t kProtocol = 2;
constexpr std::uint16_t kDefaultPort = 7760;

// ---- who may connect, and for how long
// Open connections of all kinds. One more is closed at once.
constexpr std::size_t kMaxConnections = 40;
// From the first byte of a request to its last. Longer: closed.
constexpr std::chrono::seconds kRequestTime{5};
// To send an answer, and one second more for each megabyte of it. Longer: closed.
constexpr std::chrono::seconds kAnswerTime{10};
// Without a sign of life on a WebSocket (the browser answers pings by itself). Longer: closed.
constexpr std::chrono::seconds kIdleTime{20};

// ---- what may be said
// Head of a request. Longer: closed. A request has no body; one with a body is closed.
constexpr std::uint32_t kMaxHeaderBytes = 8192;
// A message of a page. Longer: closed.
constexpr std::size_t kMaxMessageBytes = 4096;
// Messages of one page in a second. More: closed.
constexpr std::uint32_t kMaxMessagesPerSecond = 2000;
// A trainee's name and a teacher's mark. Longer: refused.
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::size_t kMaxMarkBytes = 500;
// From the frame that showed a fault to its acknowledgement. Later: refused, and to be asked again.
// By judgement: a frame, a press and the way there take a tenth; a hand expects force no longer.
constexpr double kAcknowledgeLifeS = 1;

// ---- what is kept for pages
// How often pages are served. A page that has not taken its last frame misses this one.
constexpr std::chrono::milliseconds kFramePause{16};
// Scores and marks of this session, for pages that come later. More: the oldest is forgotten (here;
// the recording keeps kMaxMarksKept from the first on).
constexpr std::size_t kMaxScoresKept = 32;
constexpr std::size_t kMaxMarksKept = 200;
// Messages that wait for one page, over those that greet it, and their bytes where there is more
// than one. More: closed.
constexpr std::size_t kMaxWaitingMessages = 64 + kMaxScoresKept + kMaxMarksKept;
constexpr std::size_t kMaxWaitingBytes = std::size_t{32} << 20U;
// What the system may keep of them for one page beside that: left to itself it keeps megabytes, and
// a page that never reads is not noticed.
constexpr int kSendBufferBytes = 256 * 1024;
// Rows between the recorder and the console. Full: rows are missing in the plots, and counted.
constexpr std::size_t kRowRing = 16384;
// Rows of the running attempt. Full: the older half is forgotten.
constexpr std::size_t kMaxRowsKept = 1'000'000;
// Rows in one frame. More: thinned out, so that peaks stay.
constexpr std::uint32_t kMaxRowsPerFrame = 512;
constexpr std::uint32_t kMaxRowsPerAnswer = 20'000;
constexpr std::uint32_t kMaxRowsPerScore = 2000;
// Orders of pages that wait for the session. More: refused.
constexpr std::size_t kMaxWaitingOrders = 64;

// ---- pictures
// A particle's place in a frame. Farther than 32767 of them from rest: shown at that distance.
constexpr float kPositionUnitM = 10e-6F;
constexpr std::uint32_t kTimingBins = 100;
constexpr float kTimingBinUs = 10;

// ---- playback
// Snapshots of a recording's kernel. A long recording or a large organ has them farther apart.
constexpr std::size_t kSnapshotBytes = std::size_t{512} << 20U;
constexpr std::uint64_t kLeastSnapshotTicks = 100;
// From a snapshot to a picture on the way back. Longer: the snapshot is shown.
constexpr double kLongestWayS = 0.05;

}  // namespace stylet::console
