#pragma once

// Polls the cell on a thread of its own, whenever it has a new image, and keeps the feed up to date. Other
// news is seen `kLongestPause` later at most. A pause follows every poll, so that a fast cell cannot flood
// it.
//
//   CellPoller poller(source, CellViewer(points), feed, [&] { server.notify(); });
//
// Thread rule: constructed and destroyed by one thread; `on_news` and `on_look` are called on the poller's
// own. Source and feed outlive it.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "hmi_web/server/cell_source.h"
#include "hmi_web/server/cell_viewer.h"
#include "hmi_web/server/feed.h"

namespace stepwright::server {

class CellPoller {
 public:
  static constexpr std::chrono::milliseconds kShortestPause{20};
  static constexpr std::chrono::milliseconds kLongestPause{100};
  // `on_look` (may be empty) is given every look at the cell before viewers are told, and may keep it;
  // `on_trouble` (likewise) what a look has thrown, which is left out then.
  using OnLook = std::function<void(const std::shared_ptr<const Observation>&, const CellView&)>;
  using OnTrouble = std::function<void(const std::string&)>;
  CellPoller(CellSource& source, CellViewer viewer, Feed& feed, std::function<void()> on_news,
             OnLook on_look = {}, OnTrouble on_trouble = {});
  // Ends after the observation that is under way, or the wait for the next, kLongestPause at most.
  ~CellPoller();

  CellPoller(const CellPoller&) = delete;
  CellPoller& operator=(const CellPoller&) = delete;

 private:
  void run();
  void look();

  CellSource& source_;
  CellViewer viewer_;
  Feed& feed_;
  std::function<void()> on_news_;
  OnLook on_look_;
  OnTrouble on_trouble_;
  std::mutex mutex_;
  std::condition_variable stop_signal_;
  bool stopping_ = false;  // guarded by mutex_
  std::thread thread_;     // last: it uses all of the above
};

}  // namespace stepwright::server
