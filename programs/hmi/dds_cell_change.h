#pragma once

// Online changes of the cell's program over Fast DDS, and what becomes of them.
//
// Threads: every function from any; `change` blocks for dds::kDownloadTimeout at most. A thread of its own
// takes the events of the runtime. Source and configuration outlive it.

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "cell/config/cell_config.h"
#include "hmi_web/api/cell_change.h"
#include "programs/hmi/dds_cell_source.h"

namespace stepwright::hmi {

class DdsCellChange final : public api::CellChange {
 public:
  DdsCellChange(DdsCellSource& source, const config::CellConfig& config);

  result::Result<api::LoadedNow> loaded() override;
  std::string engaged() override;
  std::vector<std::byte> fitted(std::vector<std::byte> container) override;
  result::Result<api::Takeover> change(std::span<const std::byte> container, bool restart_charts) override;
  api::Trial trial() override;
  result::Result<api::Compiled> compile(const api::SourceTexts& sources) override;
  api::Answer sources(const std::string& digest, std::span<const std::byte> container) override;

 private:
  using Clock = std::chrono::steady_clock;

  // The newest change that was made here.
  struct Change {
    std::string from;
    std::string to;
    std::uint64_t incarnation = 0;
    std::uint64_t changes_before = 0;            // of the status, so that an older one is known
    std::optional<std::uint64_t> swap_scan;      // after which the new program took over
    std::optional<std::string> rolled_back;      // why
    std::optional<Clock::time_point> gone_back;  // since when the old program is seen to run again
    api::Trial trial;
  };
  void listen(const std::stop_token& stop);
  void take(const dds::StepEvent& event);
  void judge(Change& change, const dds::RuntimeStatus& status) const;

  DdsCellSource& source_;
  const std::uint32_t trial_scans_;
  const source::Dialect& dialect_;
  const config::CellConfig& config_;
  const bool remote_;  // a controller behind a gateway keeps no sources
  std::mutex mutex_;   // guards what follows
  std::optional<Change> change_;
  std::jthread listener_;  // last: it uses the rest
};

}  // namespace stepwright::hmi
