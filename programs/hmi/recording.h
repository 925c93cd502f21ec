#pragma once

// Records of the page's server about its cell: [history] of the configuration. A disk that takes nothing
// keeps nobody from looking at the plant: the server starts without records, says why, and tries again.
//
//   auto recording = Recording::open(config, picture->synoptic, log);     // null: the cell keeps nothing
//   if (*recording) (*recording)->take(seen, view);
//
// Threads: take from one; everything else from any.

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

#include "cell/config/cell_config.h"
#include "hmi_web/api/cell_records.h"
#include "hmi_web/notify/channel.h"
#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/recorder/cell_recorder.h"
#include "hmi_web/recorder/record_queries.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/result.h"

namespace stepwright::hmi {

class Recording : public api::CellRecords {
 public:
  static constexpr std::chrono::seconds kBetweenTries{10};

  // Null if the configuration names no folder. Fails with what is wrong in the alarms' file (C0601 to C0605),
  // and if another process writes the folder (S0004). What else the folder may have is told and tried again.
  [[nodiscard]] static result::Result<std::unique_ptr<Recording>> open(const config::CellConfig& config,
                                                                       const protocol::Synoptic& synoptic,
                                                                       log::Logger& log);

  // Says what could not be written to the end.
  ~Recording() override;

  // The next look at the cell; gives the message for pages, if it is news.
  std::optional<std::string> take(const server::Observation& seen, const server::CellView& view);

  api::Answer tags(const Parameters& given) const override;
  api::Answer trend(const Parameters& given) const override;
  api::Answer samples_csv(const Parameters& given) const override;
  api::Answer alarms(const Parameters& given) const override;
  api::Answer journal(const Parameters& given) const override;
  api::Answer journal_csv(const Parameters& given) const override;
  [[nodiscard]] result::Result<api::AlarmChange> act(const api::AlarmAction& action) override;
  bool accept_calendar() override;
  // Alarms that stand and that nobody has acknowledged; from any thread.
  std::vector<notify::StandingAlarm> unacknowledged() const;

 private:
  using Ask = api::Answer (recorder::RecordQueries::*)(const Parameters&) const;

  Recording(recorder::RecorderOptions options, log::Logger& log) : options_(std::move(options)), log_(log) {}
  // Why not, or nothing.
  std::optional<result::Diagnostics> try_to_open();
  api::Answer answer(Ask ask, const Parameters& given) const;
  void note_calendar();
  void note_variables();
  void note_disk();

  const recorder::RecorderOptions options_;
  log::Logger& log_;
  std::chrono::steady_clock::time_point next_try_{};
  std::uint64_t alarms_revision_ = 0;                                  // that the log knows
  std::vector<std::pair<std::string, std::string>> without_variable_;  // likewise: alarms and their variables
  bool doubted_ = false;                               // the calendar, as the log was told last
  bool failing_ = false;                               // the disk, likewise
  std::chrono::steady_clock::time_point next_look_{};  // at the disk
  mutable std::shared_mutex mutex_;
  std::unique_ptr<recorder::CellRecorder> recorder_;  // this and below: guarded by mutex_; null: not open yet
  std::optional<recorder::RecordQueries> queries_;
  result::Diagnostics problem_;  // why not
};

}  // namespace stepwright::hmi
