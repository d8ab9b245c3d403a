// SPDX-License-Identifier: Apache-2.0
#include "hal/publish/igtl_process.h"

#include "hal/base/packing.h"
#include "hal/score/packing.h"

namespace stylet::hal {
namespace {

constexpr double kLookS = 0.01;  // two looks for each pause of the server

Bytes packed(const IgtlConfig& config) {
  Packer packer;
  packer.put(config.address).put(config.port).put(config.courses);
  packer.put_each(config.targets, pack_target);
  return {packer.bytes().begin(), packer.bytes().end()};
}

IgtlConfig unpacked(const Bytes& greeting) {
  Unpacker unpacker(greeting);
  IgtlConfig config;
  unpacker.get(config.address);
  unpacker.get(config.port);
  unpacker.get(config.courses);
  unpacker.get_each(config.targets, unpack_target);
  return config;
}

}  // namespace

IgtlProcess::IgtlProcess(const IgtlConfig& config)
    : process_(kIgtlRole, SharedLatest<NewestTick>::bytes(), packed(config)),
      newest_(process_.shared()) {
  Unpacker(process_.answer()).get(port_);
}

void igtl_beside(SideSeat& seat) {
  IgtlServer server(unpacked(seat.greeting));
  const std::uint16_t port = server.port();
  SharedLatest<NewestTick> newest(seat.shared);
  seat.ready(std::as_bytes(std::span(&port, 1)));
  while (!seat.link.gone()) {
    (void)seat.link.receive(kLookS);
    if (const NewestTick* tick = newest.take(); tick != nullptr) {
      server.post(std::span(tick->record).first(tick->needles));
    }
  }
}

}  // namespace stylet::hal
