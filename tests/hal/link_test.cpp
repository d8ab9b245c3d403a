// SPDX-License-Identifier: Apache-2.0
// The slots of shared memory: either side may come first; what counts as new; what is left behind.
#include "hal/device/link.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <list>
#include <optional>
#include <random>
#include <span>
#include <string>

#include "hal/device/devices.h"
#include "hal/device/packet.h"

namespace stylet::hal {
namespace {

class SharedMemory : public testing::Test {
 protected:
  ~SharedMemory() override {
    for (Link& link : open_) link.close(link.self);
    (void)std::remove(("/dev/shm/stylet." + name_).c_str());
  }

  Link& open(Side side) { return open_.emplace_back(shared_memory(name_, side)); }

  void close(Link& link) {
    link.close(link.self);
    open_.remove_if([&link](const Link& each) { return each.self == link.self; });
  }

  static void send(const Link& link, std::size_t size) {
    std::array<std::byte, kMaxPacketBytes> packet;
    packet.fill(std::byte{0x5A});
    link.send(link.self, std::span(packet).first(size));
  }

  static std::size_t receive(const Link& link, std::size_t room = kMaxPacketBytes) {
    received_.fill(std::byte{0});
    return link.receive(link.self, std::span(received_).first(room)).value_or(0);
  }

  const std::string& name() const { return name_; }
  bool there() const { return access(("/dev/shm/stylet." + name_).c_str(), F_OK) == 0; }
  bool is_mapped() const {
    std::ifstream maps("/proc/self/maps");
    const std::string text(std::istreambuf_iterator<char>(maps), {});
    return text.find("/dev/shm/stylet." + name_) != std::string::npos;
  }

  static inline std::array<std::byte, kMaxPacketBytes> received_;

 private:
  std::string name_ = "link_test" + std::to_string(getpid());
  std::list<Link> open_;
};

TEST_F(SharedMemory, MessagesOfAnEarlierRunAreNotNew) {
  Link& earlier = open(Side::kStylet);
  Link& device = open(Side::kDevice);
  send(device, kSamplePacketBytes);
  EXPECT_EQ(receive(earlier), kSamplePacketBytes);
  close(earlier);
  EXPECT_FALSE(there()) << "the run's end takes it away";
  Link& stylet = open(Side::kStylet);
  EXPECT_EQ(receive(stylet), 0U);
  send(device, kSamplePacketBytes);
  EXPECT_EQ(receive(stylet), 0U) << "whoever wants to take part opens it anew";
  send(open(Side::kDevice), kSamplePacketBytes);
  EXPECT_EQ(receive(stylet), kSamplePacketBytes);
}

TEST_F(SharedMemory, TwoStyletsDoNotShareOne) {
  Link& first = open(Side::kStylet);
  try {
    open(Side::kStylet);
    ADD_FAILURE() << "the second took it";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("another Stylet has it"), std::string::npos);
  }
  send(open(Side::kDevice), kSamplePacketBytes);
  EXPECT_EQ(receive(first), kSamplePacketBytes);
}

// A run that is killed leaves its file. The next run takes it over, and nothing in it counts as
// new.
TEST_F(SharedMemory, TheFileOfAKilledRunIsTakenOver) {
  const pid_t child = fork();
  if (child == 0) {
    send(shared_memory(name(), Side::kStylet), kForcePacketBytes);
    send(shared_memory(name(), Side::kDevice), kSamplePacketBytes);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(there());
  Link& device = open(Side::kDevice);  // of before the kill: it stays in the same file
  Link& stylet = open(Side::kStylet);
  EXPECT_EQ(receive(stylet), 0U);
  EXPECT_EQ(receive(device), 0U);
  send(device, kSamplePacketBytes);
  EXPECT_EQ(receive(stylet), kSamplePacketBytes);
  close(stylet);
  EXPECT_FALSE(there());
}

TEST_F(SharedMemory, ADeviceThatComesLaterFindsTheLastForce) {
  send(open(Side::kStylet), kForcePacketBytes);
  Link& device = open(Side::kDevice);
  EXPECT_EQ(receive(device), kForcePacketBytes);
  EXPECT_EQ(received_[kForcePacketBytes - 1], std::byte{0x5A});
  EXPECT_EQ(receive(device), 0U) << "once";
}

TEST_F(SharedMemory, ABufferThatIsTooSmallGetsNothing) {
  Link& stylet = open(Side::kStylet);
  send(open(Side::kDevice), kSamplePacketBytes);
  EXPECT_EQ(receive(stylet, kSamplePacketBytes - 1), 0U);
  EXPECT_EQ(received_[0], std::byte{0});
}

TEST_F(SharedMemory, ClosedLeavesNothingMapped) {
  Link& stylet = open(Side::kStylet);
  EXPECT_TRUE(is_mapped());
  close(stylet);
  EXPECT_FALSE(is_mapped());
}

// `open(path, "wb")` in a peer's program shortens the file: nothing comes through on either side,
// and nothing worse happens.
TEST_F(SharedMemory, AFileThatIsShortenedIsSilenceAndIsReported) {
  Link& stylet = open(Side::kStylet);
  Link& device = open(Side::kDevice);
  send(device, kSamplePacketBytes);
  EXPECT_EQ(receive(stylet), kSamplePacketBytes);
  EXPECT_EQ(stylet.trouble(stylet.self), "");
  for (int round = 0; round < 3; ++round) {
    ASSERT_EQ(truncate(("/dev/shm/stylet." + name()).c_str(), 0), 0);
    for (int i = 0; i < 5; ++i) {
      send(stylet, kForcePacketBytes);
      (void)receive(stylet);
      (void)receive(device);
      send(device, kSamplePacketBytes);
      EXPECT_EQ(receive(stylet), 0U);
    }
    EXPECT_NE(stylet.trouble(stylet.self).find("has shortened /dev/shm/stylet." + name()),
              std::string::npos);
  }
  close(stylet);
  Link& next = open(Side::kStylet);
  send(open(Side::kDevice), kSamplePacketBytes);
  EXPECT_EQ(receive(next), kSamplePacketBytes) << "the next run has a file of its own";
}

// A page fault in other memory still ends the program. A sanitizer takes over the signal when the
// program starts.
TEST_F(SharedMemory, FaultsInOtherMemoryEndTheProgram) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        (void)std::signal(SIGBUS, SIG_DFL);
        open(Side::kStylet);
        std::FILE* file = std::tmpfile();
        void* at = mmap(nullptr, 4096, PROT_READ, MAP_SHARED, fileno(file), 0);
        _exit(*static_cast<volatile char*>(at));
      },
      testing::KilledBySignal(SIGBUS), "");
}

// A socket of another program on this machine.
struct Speaker {
  int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  ~Speaker() { ::close(socket); }
  void say(std::uint16_t port, unsigned char what, std::size_t bytes = 1) const {
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(port);
    (void)sendto(socket, &what, bytes, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
};

// Only one peer is served at a time; another is accepted after the first has been silent for a
// while.
TEST(Udp, AnotherPeerIsIgnoredWhileTheFirstSends) {
  const auto port = static_cast<std::uint16_t>(20000 + getpid() % 12000);
  const Link link = udp_listen(std::to_string(port));
  const Speaker first, second;
  std::array<std::byte, kMaxPacketBytes> room;
  const auto heard = [&] { return link.receive(link.self, room) == 1 ? int(room[0]) : 0; };
  first.say(port, 1);
  EXPECT_EQ(heard(), 1);
  link.answer(link.self);
  second.say(port, 2);
  EXPECT_EQ(heard(), 0);
  first.say(port, 3);
  EXPECT_EQ(heard(), 3);
  usleep(120'000);
  second.say(port, 4);
  EXPECT_EQ(heard(), 4);
  link.close(link.self);
}

// A driver of another scheme, and its user, are told of their own URI.
TEST(Udp, MessagesNameTheSchemeThatWasAskedFor) {
  for (const bool listens : {false, true}) {
    try {
      (void)(listens ? udp_listen("nowhere", "plumb") : udp_connect("nowhere", "plumb"));
      ADD_FAILURE();
    } catch (const DeviceError& error) {
      EXPECT_EQ(std::string(error.what()).find("plumb:nowhere: expected "), 0U) << error.what();
    }
  }
}

TEST(Udp, TroubleTellsAClosedPortFromUselessPackets) {
  const auto port = static_cast<std::uint16_t>(20000 + getpid() % 12000);
  const Link link = udp_connect("127.0.0.1:" + std::to_string(port));
  std::array<std::byte, kMaxPacketBytes> room = {};
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(link.trouble(link.self), "");
    link.send(link.self, std::span(room).first(1));
    usleep(10'000);
    (void)link.receive(link.self, room);
    EXPECT_NE(link.trouble(link.self).find("no program listens"), std::string::npos);
    const Link there = udp_listen(std::to_string(port));
    link.send(link.self, std::span(room).first(1));
    ASSERT_EQ(there.receive(there.self, room), 1U);
    there.answer(there.self);
    there.send(there.self, std::span(room).first(1));
    EXPECT_EQ(link.receive(link.self, room), 1U);
    EXPECT_EQ(link.trouble(link.self), "") << "useless perhaps, but somebody is there";
    there.close(there.self);
  }
  link.close(link.self);
}

// Empty datagrams and those of other peers, a thousand in any order, never hide one of the peer
// that is served.
TEST(Udp, DatagramsOfOthersDoNotEndTheReading) {
  const auto port = static_cast<std::uint16_t>(20000 + getpid() % 12000);
  const Link link = udp_listen(std::to_string(port));
  const Speaker served, other;
  std::array<std::byte, kMaxPacketBytes> room;
  served.say(port, 1);
  ASSERT_EQ(link.receive(link.self, room), 1U);
  link.answer(link.self);
  std::mt19937 random(7);
  for (int tick = 0; tick < 50; ++tick) {
    int good = 0, came = 0;
    for (int i = 0; i < 20; ++i) {
      const bool own = random() % 4 == 0, empty = random() % 4 == 0;
      (own ? served : other).say(port, 2, empty ? 0 : 1);
      good += own && !empty ? 1 : 0;
    }
    for (int looks = 0; looks <= 20; ++looks) {
      const auto got = link.receive(link.self, room);
      if (!got) break;
      came += *got == 1 && room[0] == std::byte{2} ? 1 : 0;
    }
    ASSERT_EQ(came, good) << tick;
  }
  EXPECT_EQ(link.receive(link.self, room), std::nullopt);
  link.close(link.self);
}

}  // namespace
}  // namespace stylet::hal
