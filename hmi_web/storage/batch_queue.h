#pragma once

// Queue from many threads to the one that writes, in batches: a batch is due when there are enough items,
// when the period is over, or when somebody waits for it. Nobody who hands something over ever waits: beyond
// its capacity the queue drops and counts.
//
//   queue.push(item);                                  // any thread
//   while (queue.take(batch)) { write(batch); queue.done(); }   // the writer
//
// Thread rule: push, flush and stop from any thread; take and done from one.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace stepwright::storage {

struct BatchRule {
  std::size_t enough = 100'000;             // items that make a batch
  std::size_t capacity = 2'000'000;         // items that wait at most
  std::chrono::milliseconds period{1'000};  // the longest time between two batches
};

template <typename Item>
class BatchQueue {
 public:
  explicit BatchQueue(BatchRule rule) : rule_(rule) {}

  // How many of them were taken; the rest is counted as dropped.
  std::size_t push(std::span<const Item> items) {
    const std::lock_guard lock(mutex_);
    const std::size_t room = rule_.capacity - waiting_.size();
    const std::size_t taken = items.size() < room ? items.size() : room;
    waiting_.insert(waiting_.end(), items.begin(), items.begin() + static_cast<std::ptrdiff_t>(taken));
    pushed_ += taken;
    dropped_ += items.size() - taken;
    if (waiting_.size() >= rule_.enough) due_.notify_one();
    return taken;
  }
  bool push(const Item& item) { return push(std::span(&item, 1)) == 1; }

  // The writer's next batch, possibly empty at the end of a period; false when the queue was stopped and all
  // was taken.
  bool take(std::vector<Item>& batch) {
    batch.clear();
    std::unique_lock lock(mutex_);
    due_.wait_for(lock, rule_.period,
                  [&] { return stopped_ || waiting_.size() >= rule_.enough || flushes_ > flushed_; });
    if (stopped_ && waiting_.empty()) return false;
    batch.swap(waiting_);
    taking_flush_ = flushes_;
    return true;
  }

  // The batch of the last take is dealt with.
  void done() {
    const std::lock_guard lock(mutex_);
    flushed_ = taking_flush_;
    settled_.notify_all();
  }

  // Waits until everything that was pushed before has been dealt with.
  void flush() {
    std::unique_lock lock(mutex_);
    const std::uint64_t mine = ++flushes_;
    due_.notify_one();
    settled_.wait(lock, [&] { return flushed_ >= mine || stopped_; });
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    due_.notify_all();
    settled_.notify_all();
  }

  std::uint64_t pushed() const {
    const std::lock_guard lock(mutex_);
    return pushed_;
  }
  std::uint64_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  const BatchRule rule_;
  mutable std::mutex mutex_;
  std::condition_variable due_, settled_;
  std::vector<Item> waiting_;  // this and all below: guarded by mutex_
  std::uint64_t pushed_ = 0, dropped_ = 0;
  std::uint64_t flushes_ = 0, flushed_ = 0, taking_flush_ = 0;
  bool stopped_ = false;
};

}  // namespace stepwright::storage
