#include "hmi_web/server/cell_poller.h"

#include <utility>

namespace stepwright::server {

CellPoller::CellPoller(CellSource& source, CellViewer viewer, Feed& feed, std::function<void()> on_news,
                       std::chrono::milliseconds period)
    : source_(source),
      viewer_(std::move(viewer)),
      feed_(feed),
      on_news_(std::move(on_news)),
      period_(period),
      thread_([this] { run(); }) {}

CellPoller::~CellPoller() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stop_signal_.notify_all();
  thread_.join();
}

void CellPoller::run() {
  auto next = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    const auto now = std::chrono::steady_clock::now();
    if (feed_.update(viewer_.view(source_.observe()), now)) on_news_();
    // After a long observation the pace goes on from here instead of catching up.
    next = std::max(next + period_, now);
    lock.lock();
    stop_signal_.wait_until(lock, next, [this] { return stopping_; });
  }
}

}  // namespace stepwright::server
