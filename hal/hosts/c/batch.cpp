// SPDX-License-Identifier: Apache-2.0
// Batches of stylet.h: a pool of threads, each of which takes one simulation after the other. They
// wait between calls. Not for the loop: which simulation is done when, nobody knows; the bits do
// not depend on it.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "hal/hosts/c/ticking.h"

struct stylet_batch {
  struct Part {
    stylet_simulation* simulation;
    std::size_t first_needle;  // of the whole batch
  };
  std::vector<Part> parts;
  std::size_t needles = 0;

  // The call that is under way.
  stylet::c::Arrays arrays;
  std::uint32_t ticks = 0;
  std::atomic<std::size_t> next{0};

  std::mutex mutex;
  std::condition_variable begun, done;
  std::uint64_t call = 0;  // how many calls there were
  std::size_t busy = 0;    // threads that have not ended the newest call
  bool ends = false;
  std::vector<std::thread> threads;  // beside the caller's

  ~stylet_batch() {
    {
      const std::lock_guard lock(mutex);
      ends = true;
    }
    begun.notify_all();
    for (std::thread& each : threads) each.join();
    for (const Part& part : parts) stylet_simulation_free(part.simulation);
  }

  // Simulations, until all are taken.
  void work() {
    for (std::size_t i = next++; i < parts.size(); i = next++) {
      const stylet::c::Arrays own = arrays.from(parts[i].first_needle * ticks);
      stylet::c::run_plain(*parts[i].simulation, own, ticks);
    }
  }

  void serve() {
    std::uint64_t seen = 0;
    for (;;) {
      std::unique_lock lock(mutex);
      begun.wait(lock, [&] { return ends || call != seen; });
      if (ends) return;
      seen = call;
      lock.unlock();
      work();
      lock.lock();
      if (--busy == 0) done.notify_one();
    }
  }

  void run(const stylet::c::Arrays& of, std::uint32_t count) {
    {
      const std::lock_guard lock(mutex);
      arrays = of;
      ticks = count;
      next = 0;
      busy = threads.size();
      ++call;
    }
    begun.notify_all();
    work();
    std::unique_lock lock(mutex);
    done.wait(lock, [&] { return busy == 0; });
  }
};

stylet_status stylet_batch_create(stylet_simulation* const* simulations, uint32_t count,
                                  uint32_t threads, stylet_batch** batch_out) try {
  if (batch_out != nullptr) *batch_out = nullptr;
  if (batch_out == nullptr || (simulations == nullptr && count > 0)) {
    return STYLET_ARGUMENT_MISSING;
  }
  auto made = std::make_unique<stylet_batch>();
  for (std::uint32_t i = 0; i < count; ++i) {
    const stylet_status status = stylet::c::ready(simulations[i]);
    if (status != STYLET_OK) return status;
    // Twice in one batch, two threads would tick it at once.
    for (std::uint32_t j = 0; j < i; ++j) {
      if (simulations[j] == simulations[i]) return STYLET_ARGUMENT_OUT_OF_RANGE;
    }
    made->parts.push_back({simulations[i], made->needles});
    (void)stylet::c::keep(simulations[i]);
    made->needles += simulations[i]->config.needle_count;
  }
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  threads = std::min(threads, std::max(count, 1U));
  for (std::uint32_t i = 1; i < threads; ++i) {
    made->threads.emplace_back([batch = made.get()] { batch->serve(); });
  }
  *batch_out = made.release();
  return STYLET_OK;
} catch (const std::bad_alloc&) {
  return STYLET_OUT_OF_MEMORY;
} catch (const std::system_error&) {
  return STYLET_OUT_OF_MEMORY;  // no room for one more thread
}

void stylet_batch_free(stylet_batch* batch) {
  delete batch;
}

uint32_t stylet_batch_needles(const stylet_batch* batch) {
  return batch == nullptr ? 0 : static_cast<std::uint32_t>(batch->needles);
}

stylet_status stylet_batch_run(stylet_batch* batch, const stylet_input* inputs,
                               stylet_output* outputs_out, uint32_t ticks) {
  if (batch == nullptr || (inputs == nullptr && ticks > 0)) return STYLET_ARGUMENT_MISSING;
  if (ticks == 0 || batch->parts.empty()) return STYLET_OK;
  for (const stylet_batch::Part& part : batch->parts) {
    const stylet_status status = stylet::c::ready(part.simulation);
    if (status != STYLET_OK) return status;
  }
  const stylet::c::Arrays arrays = stylet::c::arrays(inputs, outputs_out);
  if (!stylet::c::sizes_known(arrays, batch->needles * ticks)) return STYLET_STRUCT_SIZE_UNKNOWN;
  batch->run(arrays, ticks);
  return STYLET_OK;
}
