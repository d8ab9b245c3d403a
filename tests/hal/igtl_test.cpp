// SPDX-License-Identifier: Apache-2.0
// The server as the library's own client and hostile clients see it.
#include "hal/publish/igtl.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <igtlClientSocket.h>
#include <igtlMessageHeader.h>
#include <igtlPointMessage.h>
#include <igtlPositionMessage.h>
#include <igtlSensorMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTransformMessage.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace stylet::hal {
namespace {

constexpr Course kCourse = {{0, 0, 0}, {1, 0, 0}};
// A quarter of a turn about y: z to x, x to -z.
constexpr Quat kQuarter = {0.70710678F, 0, 0.70710678F, 0};

IgtlConfig any_port() {
  IgtlConfig config;
  config.port = 0;
  config.courses = {kCourse, kCourse};
  config.targets = {{"tumour", {0.01F, 0.02F, 0.03F}, 0.004F, false},
                    {"vessel", {-0.01F, 0, 0}, 0.002F, true}};
  return config;
}

TickRecord record_at(float x_m, std::uint32_t needle = 0) {
  TickRecord record = {};
  record.needle = needle;
  record.input.handle = {{x_m, 0.2F, 0.3F}, kQuarter};
  record.output.tip_m = {x_m + 0.1F, 0.2F, 0.3F};
  record.output.depth_m = 0.0123F;
  record.output.phase = Phase::kInserted;
  record.output.force_n = {-3, 4, 0.5F};
  record.output.cause.cutting_n = {-2, 0, 0};
  record.output.cause.friction_n = {-1, 0, 0};
  record.output.tick = 77;
  return record;
}

// The library's client. It keeps the newest message of each "TYPE name".
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(igtl::ClientSocket::New()) {
    EXPECT_EQ(socket_->ConnectToServer("127.0.0.1", port), 0);
    socket_->SetReceiveTimeout(5000);
  }

  // Takes one more message; false: the connection has ended.
  bool receive() {
    const igtl::MessageHeader::Pointer header = igtl::MessageHeader::New();
    header->InitPack();
    bool late = false;
    const auto got = socket_->Receive(header->GetPackPointer(), header->GetPackSize(), late);
    if (static_cast<int>(got) != header->GetPackSize()) return false;
    header->Unpack();
    const std::string type = header->GetDeviceType();
    if (type == "TRANSFORM") return keep(igtl::TransformMessage::New(), header, transforms);
    if (type == "POSITION") return keep(igtl::PositionMessage::New(), header, positions);
    if (type == "SENSOR") return keep(igtl::SensorMessage::New(), header, sensors);
    if (type == "STRING") return keep(igtl::StringMessage::New(), header, strings);
    if (type == "STATUS") return keep(igtl::StatusMessage::New(), header, statuses);
    if (type == "POINT") return keep(igtl::PointMessage::New(), header, points);
    ADD_FAILURE() << "unknown type " << type;
    return false;
  }

  bool receive_until(const std::function<bool()>& done) {
    for (int i = 0; i < 3000; ++i) {
      if (done()) return true;
      if (!receive()) return false;
    }
    return false;
  }

  std::map<std::string, igtl::TransformMessage::Pointer> transforms;
  std::map<std::string, igtl::PositionMessage::Pointer> positions;
  std::map<std::string, igtl::SensorMessage::Pointer> sensors;
  std::map<std::string, igtl::StringMessage::Pointer> strings;
  std::map<std::string, igtl::StatusMessage::Pointer> statuses;
  std::map<std::string, igtl::PointMessage::Pointer> points;

 private:
  template <typename Pointer>
  bool keep(const Pointer& message, const igtl::MessageHeader::Pointer& header,
            std::map<std::string, Pointer>& into) {
    message->SetMessageHeader(header);
    message->AllocatePack();
    bool late = false;
    (void)socket_->Receive(message->GetPackBodyPointer(), message->GetPackBodySize(), late);
    const int unpacked = message->Unpack(1);  // with its checksum
    EXPECT_NE(unpacked & igtl::MessageHeader::UNPACK_BODY, 0) << header->GetDeviceType();
    into[header->GetDeviceName()] = message;
    return true;
  }

  igtl::ClientSocket::Pointer socket_;
};

TEST(Igtl, PlacesAreMillimetresInRas) {
  IgtlServer server(any_port());
  const TickRecord records[] = {record_at(0.1F), record_at(0.15F, 1)};
  server.post(records);
  Client client(server.port());
  ASSERT_TRUE(client.receive_until([&] { return client.strings.contains("StyletState1"); }));
  igtl::Matrix4x4 m;
  ASSERT_TRUE(client.transforms.contains("StyletBase"));
  client.transforms["StyletBase"]->GetMatrix(m);
  EXPECT_NEAR(m[0][3], -100, 1e-4);
  EXPECT_NEAR(m[1][3], -200, 1e-4);
  EXPECT_NEAR(m[2][3], 300, 1e-4);
  // The needle points along the base's -z: in the world that is -x, in RAS +x.
  EXPECT_NEAR(-m[0][2], 1, 1e-6);
  EXPECT_NEAR(m[1][2], 0, 1e-6);
  EXPECT_NEAR(m[2][2], 0, 1e-6);
  // The base's x is the world's -z in both frames; its y changes sign.
  EXPECT_NEAR(m[2][0], -1, 1e-6);
  EXPECT_NEAR(m[1][1], -1, 1e-6);
  client.transforms["StyletTip"]->GetMatrix(m);
  EXPECT_NEAR(m[0][3], -200, 1e-4);
  client.transforms["StyletBase1"]->GetMatrix(m);
  EXPECT_NEAR(m[0][3], -150, 1e-4);

  float x, y, z;
  client.positions["StyletTip"]->GetPosition(&x, &y, &z);
  EXPECT_NEAR(x, -200, 1e-4);
  // The quaternion turns as the matrix does.
  float q[4];
  client.positions["StyletTip"]->GetQuaternion(&q[0], &q[1], &q[2], &q[3]);
  igtl::Matrix4x4 same;
  igtl::QuaternionToMatrix(q, same);
  client.transforms["StyletTip"]->GetMatrix(m);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) EXPECT_NEAR(same[row][column], m[row][column], 1e-6);
  }
}

TEST(Igtl, ForcesStateStatusAndTargets) {
  IgtlServer server(any_port());
  const TickRecord first[] = {record_at(0.1F)};
  server.post(first);
  Client client(server.port());
  ASSERT_TRUE(client.receive_until([&] { return client.statuses.contains("Stylet"); }));
  const igtl::SensorMessage::Pointer force = client.sensors["StyletForce"];
  ASSERT_EQ(force->GetLength(), 10U);
  const double expected[] = {3, -4, 0.5, -3, std::hypot(4, 0.5), 0, -2, -1, 0, 0};
  for (unsigned i = 0; i < 10; ++i) EXPECT_NEAR(force->GetValue(i), expected[i], 1e-6) << i;
  EXPECT_STREQ(client.strings["StyletState"]->GetString(), "depth 12.3 mm, force 5.02 N, inserted");
  EXPECT_EQ(client.statuses["Stylet"]->GetCode(), igtl::StatusMessage::STATUS_OK);

  const igtl::PointMessage::Pointer targets = client.points["StyletTargets"];
  ASSERT_EQ(targets->GetNumberOfPointElement(), 2);
  igtl::PointElement::Pointer tumour;
  targets->GetPointElement(0, tumour);
  EXPECT_STREQ(tumour->GetName(), "tumour");
  float x, y, z;
  tumour->GetPosition(x, y, z);
  EXPECT_NEAR(x, -10, 1e-5);
  EXPECT_NEAR(y, -20, 1e-5);
  EXPECT_NEAR(z, 30, 1e-5);
  EXPECT_NEAR(tumour->GetRadius(), 4, 1e-5);

  TickRecord faulty[] = {record_at(0.1F)};
  faulty[0].fault = Fault::kTooFast;
  server.post(faulty);
  ASSERT_TRUE(client.receive_until([&] {
    return client.statuses["Stylet"]->GetCode() == igtl::StatusMessage::STATUS_HARDWARE_FAILURE;
  }));
  EXPECT_STREQ(client.statuses["Stylet"]->GetErrorName(), fault_name(Fault::kTooFast));
}

// A socket with a small buffer, from which it never reads.
int plain_client(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const int room = 2048;
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  return socket;
}

bool wait_for(const std::function<bool()>& done) {
  for (int i = 0; i < 1000 && !done(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return done();
}

TEST(Igtl, ClientThatNeverReadsLosesFramesAndOthersDoNot) {
  IgtlServer server(any_port());
  const TickRecord records[] = {record_at(0.1F)};
  server.post(records);
  const int stuck = plain_client(server.port());
  Client reader(server.port());
  ASSERT_TRUE(reader.receive_until([&] { return server.counters().lost_frames >= 5; }));
  const TickRecord moved[] = {record_at(0.4F)};
  server.post(moved);
  EXPECT_TRUE(reader.receive_until([&] {
    igtl::Matrix4x4 m;
    reader.transforms["StyletTip"]->GetMatrix(m);
    return std::fabs(m[0][3] + 500) < 1e-3F;
  }));
  EXPECT_EQ(server.counters().clients, 2U);
  ::close(stuck);
  EXPECT_TRUE(wait_for([&] { return server.counters().clients == 1; }));
}

TEST(Igtl, MessagesOfAClientChangeNothing) {
  IgtlServer server(any_port());
  const TickRecord records[] = {record_at(0.1F)};
  server.post(records);
  const int hostile = plain_client(server.port());
  std::vector<char> noise(1 << 20);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<char>(i * 7919 >> 3);
  // Headers that promise 2^64 - 1 bytes, and nonsense.
  const std::string header("\0\1TRANSFORM\0\0\0x", 15);
  for (std::size_t i = 0; i < 4096; ++i) {
    std::copy(header.begin(), header.end(), noise.begin() + static_cast<std::ptrdiff_t>(i * 58));
    std::fill_n(noise.begin() + static_cast<std::ptrdiff_t>(i * 58 + 42), 8, '\xff');
  }
  std::thread shouter([&] {
    for (int i = 0; i < 3; ++i) {
      if (send(hostile, noise.data(), noise.size(), MSG_NOSIGNAL) < 0) break;
    }
  });
  Client reader(server.port());
  int frames = 0;
  EXPECT_TRUE(reader.receive_until([&] {
    frames += reader.strings.contains("StyletState") ? 1 : 0;
    reader.strings.clear();
    return frames >= 10;
  }));
  shutdown(hostile, SHUT_RDWR);
  shouter.join();
  ::close(hostile);
  EXPECT_TRUE(wait_for([&] { return server.counters().clients == 1; }));
}

TEST(Igtl, OneClientTooManyIsClosed) {
  IgtlServer server(any_port());
  std::vector<int> sockets;
  for (std::size_t i = 0; i < kMaxIgtlClients + 3; ++i) {
    sockets.push_back(plain_client(server.port()));
  }
  EXPECT_TRUE(wait_for([&] { return server.counters().clients_refused == 3; }));
  EXPECT_EQ(server.counters().clients, kMaxIgtlClients);
  for (const int each : sockets) ::close(each);
  EXPECT_TRUE(wait_for([&] { return server.counters().clients == 0; }));
  Client late(server.port());
  EXPECT_TRUE(late.receive());  // the targets, before there is any tick
}

TEST(Igtl, InvalidAddressesAndTakenPortsAreRefused) {
  const auto refusal = [](const IgtlConfig& config) -> std::string {
    try {
      const IgtlServer server(config);
    } catch (const IgtlError& error) {
      return error.what();
    }
    return "";
  };
  IgtlConfig config = any_port();
  config.address = "nowhere";
  EXPECT_EQ(
      refusal(config),
      "OpenIGTLink: nowhere:0: expected an address of this machine, such as 127.0.0.1 or 0.0.0.0");
  const IgtlServer first(any_port());
  config = any_port();
  config.port = first.port();
  EXPECT_EQ(refusal(config),
            "OpenIGTLink: 127.0.0.1:" + std::to_string(first.port()) +
                ": Address already in use: expected a free port, and an address of this machine");
}

// Other machines reach the server only if that was asked for.
TEST(Igtl, ListensOnLoopbackAlone) {
  const IgtlServer server(any_port());
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(server.port());
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);  // 127.0.0.2: another address
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_NE(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(socket);
}

}  // namespace
}  // namespace stylet::hal
