#pragma once

// Answers pages about the program that runs: what its sheets show in the newest scan, and the pictures of its
// charts. Nothing is computed in a scan or for nobody: each answer when it is asked for.
//
//   CellMonitor monitor;
//   CellPoller poller(source, viewer, feed, on_news, [&](auto& seen, auto&) { monitor.take(seen); });
//
// Threads: every function from any.

#include <deque>
#include <memory>
#include <mutex>
#include <span>

#include "hmi_web/api/cell_monitor.h"
#include "hmi_web/monitor/sheet_monitor.h"
#include "hmi_web/server/cell_source.h"

namespace stepwright::monitor {

class CellMonitor final : public api::CellMonitor {
 public:
  CellMonitor();
  ~CellMonitor() override;

  void take(std::shared_ptr<const server::Observation> seen);

  api::Answer live(const Parameters& given) const override;
  api::Answer chart(const Parameters& given) const override;

 private:
  // Of one program; shared with whoever still looks while the next one comes.
  struct Program;
  struct Moment {
    std::shared_ptr<const Program> program;           // null: none has been known yet
    std::shared_ptr<const server::Observation> seen;  // null: nothing has

    // Null: none has come, or none that can be read.
    const server::ImageSnapshot* snapshot() const;
    std::span<const std::byte> image() const;
  };

  std::shared_ptr<const Moment> now() const;

  semantics::TypeTable types_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Moment> moment_;  // guarded by mutex_
};

}  // namespace stepwright::monitor
