// SPDX-License-Identifier: Apache-2.0
// Batches of stylet.h: a pool of threads, each of which takes one simulation after the other. They
// wait between calls. Not for the loop: which simulation is done when, nobody knows; the bits do
// not depend on it. After a fork the child begins threads of its own.
#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "hal/hosts/c/process.h"
#include "hal/hosts/c/ticking.h"

namespace {

// Threads that take items of work beside the caller. A call ends when all items are done: one whose
// thread wakes too late to take any is not waited for.
class Pool {
 public:
  explicit Pool(std::function<void(std::size_t)> work) : work_(std::move(work)) {}
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    begun_.notify_all();
    for (std::thread& each : threads_) each.join();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void add_thread() {
    threads_.emplace_back([this] { serve(); });
  }
  std::size_t threads() const { return threads_.size(); }
  bool is_of_this_process() const { return process_ == stylet::c::this_process(); }

  void run(std::size_t items) {
    {
      const std::lock_guard lock(mutex_);
      next_ = 0;
      items_ = undone_ = items;
    }
    begun_.notify_all();
    std::unique_lock lock(mutex_);
    take(lock);
    done_.wait(lock, [&] { return undone_ == 0; });
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      begun_.wait(lock, [&] { return ends_ || next_ < items_; });
      if (ends_) return;
      take(lock);
    }
  }

  // Items, until all are taken. Locked when it begins and ends, open while it works.
  void take(std::unique_lock<std::mutex>& lock) {
    while (next_ < items_) {
      const std::size_t item = next_++;
      lock.unlock();
      work_(item);
      lock.lock();
      if (--undone_ == 0) done_.notify_one();
    }
  }

  std::function<void(std::size_t)> work_;
  std::int64_t process_ = stylet::c::this_process();
  std::mutex mutex_;
  std::condition_variable begun_, done_;
  std::size_t items_ = 0, next_ = 0, undone_ = 0;  // of the newest call
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

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

  std::unique_ptr<Pool> pool;

  ~stylet_batch() {
    forget_threads_of_another_process();
    pool.reset();
    for (const Part& part : parts) stylet_simulation_free(part.simulation);
  }

  // All ticks of one simulation, which stays in the processor's cache meanwhile.
  void work(std::size_t part) {
    const stylet::c::Arrays own = arrays.from(parts[part].first_needle * ticks);
    stylet::c::run_plain(*parts[part].simulation, own, ticks);
  }

  void begin_threads(std::size_t count) {
    auto made = std::make_unique<Pool>([this](std::size_t part) { work(part); });
    forget_threads_of_another_process();
    pool = std::move(made);
    while (pool->threads() < count) pool->add_thread();
  }

  // The copy that a fork made: its threads are not here, and what they wait on cannot be destroyed.
  void forget_threads_of_another_process() {
    if (pool != nullptr && !pool->is_of_this_process()) (void)pool.release();
  }

  void run(const stylet::c::Arrays& of, std::uint32_t count) {
    if (!pool->is_of_this_process()) begin_threads(pool->threads());
    arrays = of;
    ticks = count;
    pool->run(parts.size());
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
  made->begin_threads(threads - 1);  // beside the caller's
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
                               stylet_output* outputs_out, uint32_t ticks) try {
  if (batch == nullptr) return STYLET_ARGUMENT_MISSING;
  if (ticks == 0 || batch->parts.empty()) return STYLET_OK;
  const std::size_t all = batch->needles * ticks;
  const auto refuse = [&](stylet_status status) {
    return stylet::c::refuse_outputs(status, outputs_out, all);
  };
  if (inputs == nullptr) return refuse(STYLET_ARGUMENT_MISSING);
  for (const stylet_batch::Part& part : batch->parts) {
    const stylet_status status = stylet::c::ready(part.simulation);
    if (status != STYLET_OK) return refuse(status);
  }
  const stylet::c::Arrays arrays = stylet::c::arrays(inputs, outputs_out);
  if (!stylet::c::sizes_known(arrays, all)) return refuse(STYLET_STRUCT_SIZE_UNKNOWN);
  batch->run(arrays, ticks);
  return STYLET_OK;
} catch (const std::exception&) {
  return STYLET_OUT_OF_MEMORY;  // no room for threads, anew after a fork
}
