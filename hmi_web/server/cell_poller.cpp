#include "hmi_web/server/cell_poller.h"

#include <utility>

namespace stepwright::server {

CellPoller::CellPoller(CellSource& source, CellViewer viewer, Feed& feed, std::function<void()> on_news,
                       std::chrono::milliseconds period, OnLook on_look)
    : source_(source),
      viewer_(std::move(viewer)),
      feed_(feed),
      on_news_(std::move(on_news)),
      period_(period),
      on_look_(std::move(on_look)),
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
    const Observation seen = source_.observe();
    const CellView view = viewer_.view(seen);
    if (on_look_) on_look_(seen, view);
    if (feed_.update(view, now)) on_news_();
    // After a long observation the pace goes on from here instead of catching up.
    next = std::max(next + period_, now);
    lock.lock();
    stop_signal_.wait_until(lock, next, [this] { return stopping_; });
  }
}

}  // namespace stepwright::server
