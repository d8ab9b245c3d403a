// SPDX-License-Identifier: Apache-2.0
#include "hal/publish/igtl.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <thread>

#include "hal/base/contained.h"
#include "hal/publish/igtl_messages.h"

namespace stylet::hal {
namespace {

using Clock = std::chrono::steady_clock;

// So small that a client which falls behind sees data half a second old, not a minute.
constexpr int kSendBufferBytes = 16384;
constexpr int kStatusPauses = 50;  // once a second
constexpr int kLowestPriority = 19;

struct Client {
  int socket;
  bool greeted = false;
  IgtlBytes waiting;
  std::size_t sent = 0;
  Clock::time_point moved;  // when it last took a byte
};

struct News {
  std::array<TickRecord, kMaxNeedles> record = {};
  std::uint32_t needles = 0;  // whose records have come
};

int listen_on(const IgtlConfig& config) {
  const std::string where = fmt::format("OpenIGTLink: {}:{}", config.address, config.port);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(config.port);
  if (inet_pton(AF_INET, config.address.c_str(), &address.sin_addr) != 1) {
    throw IgtlError(where + ": expected an address of this machine, such as 127.0.0.1 or 0.0.0.0");
  }
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  (void)setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const auto* at = reinterpret_cast<const sockaddr*>(&address);
  if (bind(socket, at, sizeof address) != 0 || listen(socket, 8) != 0) {
    const int error = errno;
    ::close(socket);
    throw IgtlError(fmt::format("{}: {}: expected a free port, and an address of this machine",
                                where, std::strerror(error)));
  }
  return socket;
}

std::uint16_t port_of(int socket) {
  sockaddr_in address = {};
  socklen_t size = sizeof address;
  (void)getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

// False: the client has gone. What it sends does not matter.
bool drain(const Client& client, std::span<char> room) {
  for (std::size_t done = 0; done < kIgtlMostRead;) {
    const ssize_t got = recv(client.socket, room.data(), room.size(), MSG_DONTWAIT);
    if (got == 0) return false;
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    done += static_cast<std::size_t>(got);
  }
  return true;
}

// False: the client has gone, or has not taken a byte for too long.
bool flush(Client& client) {
  while (client.sent < client.waiting.size()) {
    const ssize_t part = send(client.socket, client.waiting.data() + client.sent,
                              client.waiting.size() - client.sent, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (part < 0 && errno == EINTR) continue;
    if (part < 0 && errno == EAGAIN) return Clock::now() - client.moved < kIgtlPatience;
    if (part <= 0) return false;
    client.sent += static_cast<std::size_t>(part);
    client.moved = Clock::now();
  }
  return true;
}

}  // namespace

struct IgtlServer::Server {
  IgtlConfig config;
  int listener;
  std::vector<Client> clients;
  Fault told = Fault::kNone;
  int pauses_since_status = kStatusPauses;
  std::vector<char> room = std::vector<char>(kIgtlMostRead);

  mutable std::mutex mutex;  // guards the next two
  News news;
  IgtlCounters counters;
  std::atomic<bool> stop{false};
  std::thread thread;

  explicit Server(const IgtlConfig& given) : config(given), listener(listen_on(given)) {
    config.courses.resize(kMaxNeedles, Course{{}, {0, 0, -1}});
    thread = std::thread([this] { work(); });
  }
  ~Server() {
    stop.store(true);
    thread.join();
    for (const Client& each : clients) ::close(each.socket);
    ::close(listener);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void work() {
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLowestPriority);
    name_thread("stylet-igtl");
    while (!stop.load()) {
      std::this_thread::sleep_for(kIgtlPause);
      (void)contained("OpenIGTLink", [this] {
        take_up();
        serve();
      });
    }
  }

  void take_up() {
    for (std::size_t i = 0; i < kMaxIgtlClients; ++i) {
      const int socket = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
      if (socket < 0) return;
      const std::lock_guard lock(mutex);
      if (clients.size() == kMaxIgtlClients) {
        ::close(socket);
        ++counters.clients_refused;
        continue;
      }
      const int yes = 1;
      (void)setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
      (void)setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSendBufferBytes, sizeof kSendBufferBytes);
      clients.push_back({socket, false, {}, 0, Clock::now()});
      ++counters.clients_total;
    }
  }

  IgtlBytes frame_of(const News& newest) {
    IgtlBytes frame;
    Fault fault = Fault::kNone;
    for (std::uint32_t i = 0; i < newest.needles; ++i) {
      add_igtl_needle(newest.record[i], config.courses[i], frame);
      if (fault == Fault::kNone) fault = newest.record[i].fault;
    }
    if (++pauses_since_status >= kStatusPauses || fault != told) {
      add_igtl_status(fault, newest.record[0].output.tick, frame);
      pauses_since_status = 0;
      told = fault;
    }
    return frame;
  }

  void serve() {
    News newest;
    {
      const std::lock_guard lock(mutex);
      newest = news;
    }
    const IgtlBytes frame = clients.empty() ? IgtlBytes{} : frame_of(newest);
    std::uint64_t sent = 0, lost = 0;
    std::erase_if(clients, [&](Client& client) {
      if (!drain(client, room)) return close_client(client);
      const bool free = client.sent == client.waiting.size();
      if (free) give(client, frame);
      ++(free ? sent : lost);
      return flush(client) ? false : close_client(client);
    });
    const std::lock_guard lock(mutex);
    counters.frames += sent;
    counters.lost_frames += lost;
    counters.clients = static_cast<std::uint32_t>(clients.size());
  }

  void give(Client& client, const IgtlBytes& frame) {
    client.waiting.clear();
    client.sent = 0;
    client.moved = Clock::now();
    if (!client.greeted) add_igtl_targets(config.targets, client.waiting);
    client.greeted = true;
    client.waiting.insert(client.waiting.end(), frame.begin(), frame.end());
  }

  static bool close_client(const Client& client) {
    ::close(client.socket);
    return true;
  }
};

IgtlServer::IgtlServer(const IgtlConfig& config) : server_(std::make_unique<Server>(config)) {}
IgtlServer::~IgtlServer() = default;

std::uint16_t IgtlServer::port() const {
  return port_of(server_->listener);
}

void IgtlServer::post(std::span<const TickRecord> records) {
  const std::lock_guard lock(server_->mutex);
  News& news = server_->news;
  for (const TickRecord& each : records) {
    if (each.needle >= kMaxNeedles) continue;
    news.record[each.needle] = each;
    news.needles = std::max(news.needles, each.needle + 1);
  }
}

IgtlCounters IgtlServer::counters() const {
  const std::lock_guard lock(server_->mutex);
  return server_->counters;
}

}  // namespace stylet::hal
