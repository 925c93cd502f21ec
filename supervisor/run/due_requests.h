#pragma once

// Queue of requests to a run: by people, at once, and by the cell's file, each from a time of the scan clock
// on.
//
//   DueRequests<TimedRequest> requests(options.requests);   // each with its `at_s`, in order of time
//   requests.add({0.0, change});                            // somebody asks
//   for (const TimedRequest& each : requests.take(now_s)) apply(each.change);
//
// Threads: `add` may be called from any; all else belongs to the thread of the run.

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace stepwright::run {

template <typename Timed>
class DueRequests {
 public:
  explicit DueRequests(std::vector<Timed> timed) : timed_(std::move(timed)) {}

  void add(Timed asked) {
    const std::lock_guard lock(mutex_);
    asked_.push_back(std::move(asked));
  }
  // What people have asked for and nobody has taken is forgotten.
  void forget_asked() {
    const std::lock_guard lock(mutex_);
    asked_.clear();
  }

  // People's in the order in which they have asked, then those of the file that are due.
  std::vector<Timed> take(double time_s) {
    std::vector<Timed> due;
    {
      const std::lock_guard lock(mutex_);
      due.swap(asked_);
    }
    for (; next_ < timed_.size() && timed_[next_].at_s <= time_s; ++next_) due.push_back(timed_[next_]);
    return due;
  }

  // So many of the file's have been taken: a journal keeps it.
  std::size_t next() const { return next_; }
  void go_on_at(std::size_t next) { next_ = next; }
  bool none_to_come() const { return next_ >= timed_.size(); }

 private:
  const std::vector<Timed> timed_;
  std::size_t next_ = 0;
  std::mutex mutex_;
  std::vector<Timed> asked_;
};

}  // namespace stepwright::run
