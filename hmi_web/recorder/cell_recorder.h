#pragma once

// Keeps what a cell does: every value of every image that the server reads into the historian, alarms into
// their journal, both on one clock (history_clock.h), in one folder.
//
//   auto recorder = CellRecorder::open(options, wall_clock);
//   CellPoller poller(source, viewer, feed, on_news, [&](auto& seen, auto& view) {
//     if (auto message = (*recorder)->take(*seen, view)) feed.set_alarms(*message);
//   });
//
// Tags have the names of the program's variables; points of the picture are `points/ID`. What is not known
// (no runtime, no program, no such variable any more, no answer of the device that it is read from) is kept
// as missing, so that nobody takes a value for lasting that nobody saw. So is the time between two images of
// which others were lost on their way, if it is longer than a page looks apart, and any time in which images
// ought to come and none does for a second; and the time from the last that a process has written, which was
// killed or had a full disk, to the first image of the next one.
//
// A calendar that has jumped far ahead is not believed until somebody accepts it (calendar.h): nothing is
// deleted for its age by that, and nothing is recorded in a time to come.
//
// Thread rule: take from one thread; everything else from any. Nothing waits for the disk. The folder has one
// writer (S0004).

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "hmi_web/historian/historian.h"
#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/recorder/calendar.h"
#include "hmi_web/recorder/cell_alarms.h"
#include "hmi_web/recorder/history_clock.h"

namespace stepwright::recorder {

inline constexpr const char* kPointPrefix = "points/";

struct RecorderOptions {
  std::filesystem::path folder;           // is made if it is missing
  bool real_time = false;                 // the cell's clock keeps to real time
  std::chrono::hours most_age{0};         // of samples and of journal entries; 0: any
  std::uint64_t most_bytes = 4ULL << 30;  // of samples; 0: any
  std::vector<protocol::Point> points;    // of the picture, as in every view
  std::vector<alarms::AlarmDefinition> alarms;
  std::vector<protocol::TagNote> notes = {};        // what the cell says of its tags
  std::function<std::int64_t()> steady_clock = {};  // ns; without it: that of the machine
};

class CellRecorder {
 public:
  using Clock = std::function<std::int64_t()>;  // real time, ns since 1970

  // Fails with S0001 to S0008, and with what is wrong in the definitions.
  [[nodiscard]] static result::Result<std::unique_ptr<CellRecorder>> open(RecorderOptions options,
                                                                          Clock wall_clock);
  // From here on nothing is known of any tag; writes what is left.
  ~CellRecorder();
  CellRecorder(const CellRecorder&) = delete;
  CellRecorder& operator=(const CellRecorder&) = delete;

  // The next look at the cell; gives the message for pages (hmi_web/doc/protocol.md, alarms), if it is news.
  std::optional<std::string> take(const server::Observation& seen, const server::CellView& view);

  // Waits until everything that was taken is in the files, or has failed to get there.
  [[nodiscard]] result::Result<void> flush();

  const historian::Historian& historian() const { return *historian_; }
  CellAlarms& alarms() { return *alarms_; }
  // The newest time of the history's clock.
  std::int64_t now_ns() const { return *now_ns_; }
  // Up to here readers of the history see all that was taken; what came since may turn out to be missing.
  std::int64_t known_ns() const { return std::max(begun_ns_, historian_->known_until_ns()); }
  // How far the history's clock, which never goes back, stands ahead of a real time that was set back; of a
  // cell in real time only.
  std::chrono::seconds ahead_of_real_time() const { return std::chrono::seconds(ahead_s_.load()); }
  // How far the machine's calendar stands ahead of the history's; 0: it is believed.
  std::chrono::seconds calendar_ahead() const;
  // The calendar is right: the history goes on at its time. False: it is believed already.
  bool accept_calendar() { return calendar_->accept(); }

 private:
  struct Series {
    historian::TagId tag;
    std::optional<double> last;
    std::int64_t appended_ns = 0;
    bool begun = false;
  };

  CellRecorder(RecorderOptions options, Clock wall_clock);
  result::Result<void> start();
  void close_open_ends();
  std::optional<KnownEpoch> known_epoch() const;
  result::Result<Series> series(const std::string& name);
  void take_layout(const std::shared_ptr<const server::ProgramLayout>& layout);
  void record(Series& series, std::int64_t time_ns, std::optional<double> value);
  void record_image(std::int64_t time_ns, const server::CellView& view);
  void record_missing(std::int64_t time_ns);
  bool has_gap(const server::Observation& seen, std::int64_t steady_ns,
               std::optional<std::int64_t> time_ns) const;
  void note_arrival(const server::Observation& seen, bool fresh, std::int64_t steady_ns);
  void record_epoch(std::int64_t time_ns);
  std::optional<std::string> message();

  RecorderOptions options_;
  Clock wall_clock_;
  std::shared_ptr<std::atomic<std::int64_t>> now_ns_;  // shared with the files' retention
  std::int64_t begun_ns_ = 0;                          // the newest time of the process before
  std::int64_t noted_ns_ = 0;                          // as the historian was told
  std::atomic<std::int64_t> ahead_s_ = 0;
  std::unique_ptr<historian::Historian> historian_;
  std::unique_ptr<CellAlarms> alarms_;
  std::optional<HistoryClock> clock_;
  std::optional<Calendar> calendar_;
  std::optional<historian::TagId> epoch_tag_;
  std::int64_t epoch_written_ns_ = 0;
  std::shared_ptr<const server::ProgramLayout> layout_;
  std::vector<Series> points_, tags_;
  std::uint64_t scan_ = 0;
  double scan_time_s_ = -1.0;
  bool has_answered_ = false;  // at the last look the runtime did, with an image
  bool missing_ = true;        // that nothing is known is recorded already
  // Of the newest image: its time; when it came, also once more, by the steady clock, as real time may be set
  // meanwhile; the source's counts by then.
  std::int64_t seen_until_ns_ = 0, came_ns_ = 0;
  std::uint64_t images_ = 0, images_lost_ = 0;
  std::vector<historian::TagSample> batch_;
  std::uint64_t told_revision_ = 0;
  std::chrono::steady_clock::time_point told_{};
  std::string told_message_;
};

}  // namespace stepwright::recorder
