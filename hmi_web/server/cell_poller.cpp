#include "hmi_web/server/cell_poller.h"

#include <utility>

#include "runtime/ground/result/last_barrier.h"

namespace stepwright::server {

CellPoller::CellPoller(CellSource& source, CellViewer viewer, Feed& feed, std::function<void()> on_news,
                       OnLook on_look, OnTrouble on_trouble)
    : source_(source),
      viewer_(std::move(viewer)),
      feed_(feed),
      on_news_(std::move(on_news)),
      on_look_(std::move(on_look)),
      on_trouble_(std::move(on_trouble)),
      thread_([this] { run(); }) {}

CellPoller::~CellPoller() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stop_signal_.notify_all();
  thread_.join();
}

void CellPoller::look() {
  source_.wait_for_image(kLongestPause - kShortestPause);
  const auto seen = std::make_shared<const Observation>(source_.observe());
  const CellView view = viewer_.view(*seen);
  if (on_look_) on_look_(seen, view);
  if (feed_.update(view, std::chrono::steady_clock::now())) on_news_();
}

void CellPoller::run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    if (const auto thrown = result::thrown_by([this] { look(); }); thrown && on_trouble_)
      on_trouble_(*thrown);
    lock.lock();
    stop_signal_.wait_for(lock, kShortestPause, [this] { return stopping_; });
  }
}

}  // namespace stepwright::server
