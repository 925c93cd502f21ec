#include "hmi_web/recorder/cell_recorder.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "hmi_web/storage/codes.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::recorder {
namespace {

using historian::Quality;
using historian::Sample;
using historian::TagId;

// Its value is the epoch of the run in microseconds, its newest sample the newest time of the clock.
constexpr const char* kEpochTag = "@epoch_us";
constexpr std::int64_t kEpochPeriodNs = 1'000'000'000;
// A value that stays is handed over now and then all the same, so that the historian keeps its sign of life.
constexpr std::int64_t kUnchangedNs = 300'000'000'000;
constexpr std::chrono::seconds kFiguresPeriod{5};
// A link sends an image every 30 ms, and pages look every 100 ms if none comes.
constexpr std::int64_t kUnseenNs = 100'000'000;
constexpr std::int64_t kSilentNs = 1'000'000'000;
// Scans of a busy machine and a calendar that is kept right by small steps are no reason to say so.
constexpr std::int64_t kAheadNs = 60'000'000'000;
// Behind the newest image: from here on nothing is known.
constexpr std::int64_t kBehindNs = 1'000;
constexpr std::int64_t kEndOfTime = std::numeric_limits<std::int64_t>::max();

// By the index of the tag.
std::vector<bool> unread_tags(const protocol::CellState& state) {
  std::vector<bool> unread(state.tags.size(), false);
  for (const protocol::UnreadDevice& device : state.unread)
    for (const std::uint32_t tag : device.tags) unread.at(tag) = true;
  return unread;
}

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

result::Result<std::unique_ptr<CellRecorder>> CellRecorder::open(RecorderOptions options, Clock wall_clock) {
  std::unique_ptr<CellRecorder> recorder(new CellRecorder(std::move(options), std::move(wall_clock)));
  if (auto started = recorder->start(); !started) return result::forward(started);
  return recorder;
}

CellRecorder::CellRecorder(RecorderOptions options, Clock wall_clock)
    : options_(std::move(options)),
      wall_clock_(std::move(wall_clock)),
      now_ns_(std::make_shared<std::atomic<std::int64_t>>(0)) {
  if (!options_.steady_clock) options_.steady_clock = steady_ns;
}

CellRecorder::~CellRecorder() {
  if (historian_ && clock_ && scan_time_s_ >= 0) record_missing(*now_ns_ + 1'000);
}

result::Result<void> CellRecorder::start() {
  std::error_code failed;
  std::filesystem::create_directories(options_.folder, failed);
  if (failed)
    return result::fail(storage::kCannotOpen, {options_.folder.string()},
                        "the folder cannot be made: " + failed.message(),
                        "see its rights, or name another one");
  const auto now = [now_ns = now_ns_] { return now_ns->load(); };
  historian::HistorianOptions history;
  history.most_age = options_.most_age;
  history.most_bytes = options_.most_bytes;
  history.now_ns = now;
  auto historian = historian::Historian::open(options_.folder / "history.db", history);
  if (!historian) return result::forward(historian);
  historian_ = std::move(*historian);
  const auto known = known_epoch();
  alarms::JournalOptions journal;
  journal.most_age = options_.most_age;
  journal.now_ns = now;
  auto all = CellAlarms::open(options_.folder / "alarms.db", options_.alarms, options_.points, journal,
                              known ? known->newest_ns : 0, options_.notes);
  if (!all) return result::forward(all);
  alarms_ = std::move(*all);
  clock_.emplace(options_.real_time, known);
  calendar_.emplace(known ? known->newest_ns : 0);
  *now_ns_ = begun_ns_ = known ? known->newest_ns : 0;
  auto epoch = historian_->tag(kEpochTag, {historian::SuppressionKind::None});
  if (!epoch) return result::forward(epoch);
  epoch_tag_ = *epoch;
  for (const protocol::Point& point : options_.points) {
    auto made = series(kPointPrefix + point.id);
    if (!made) return result::forward(made);
    points_.push_back(*made);
  }
  close_open_ends();
  return {};
}

// A process that was killed, or that a full disk kept from writing, has not said that it looks no more.
void CellRecorder::close_open_ends() {
  for (const std::string& name : historian_->names()) {
    const auto tag = historian_->find(name);
    if (!tag || name == kEpochTag) continue;
    const auto end = historian_->range(*tag, {kEndOfTime, kEndOfTime}, 1);
    if (!end || !end->before || end->before->quality == Quality::Missing) continue;
    const std::int64_t time_ns = std::max(end->before->time_ns, begun_ns_) + kBehindNs;
    batch_.push_back({*tag, {time_ns, 0.0, Quality::Missing}});
  }
  historian_->append(batch_);
  batch_.clear();
}

std::optional<KnownEpoch> CellRecorder::known_epoch() const {
  const auto tag = historian_->find(kEpochTag);
  if (!tag) return std::nullopt;
  const auto end = historian_->range(*tag, {kEndOfTime, kEndOfTime}, 1);
  if (!end || !end->before) return std::nullopt;
  return KnownEpoch{std::llround(end->before->value) * 1'000, end->before->time_ns};
}

result::Result<CellRecorder::Series> CellRecorder::series(const std::string& name) {
  auto tag = historian_->tag(name);
  if (!tag) return result::forward(tag);
  return Series{*tag, std::nullopt, 0, false};
}

// Tags keep their history by their names; those that the new program does not have are missing from here on.
void CellRecorder::take_layout(const std::shared_ptr<const server::ProgramLayout>& layout) {
  if (layout == layout_) return;
  layout_ = layout;
  std::vector<Series> before = std::exchange(tags_, {});
  std::unordered_map<std::uint32_t, Series*> old;
  for (Series& one : before) old[one.tag.value] = &one;
  if (layout) {
    for (std::size_t i = 0; i < layout->tags.size(); ++i) {
      // A text has no history, nor has a name that the historian does not take (longer than 255 bytes); its
      // place stays.
      Series one{TagId(~0U), std::nullopt, 0, true};
      if (!bytecode::is_string(layout->tags[i].type)) {
        if (auto made = series(layout->program.tags[i].name)) one = *made;
      }
      if (const auto found = old.find(one.tag.value); found != old.end()) {
        one = *found->second;
        old.erase(found);
      }
      tags_.push_back(one);
    }
  }
  for (const auto& [id, one] : old) record(*one, *now_ns_, std::nullopt);
}

void CellRecorder::record(Series& one, std::int64_t time_ns, std::optional<double> value) {
  if (one.tag.value == ~0U) return;
  if (one.begun && value == one.last && time_ns - one.appended_ns < kUnchangedNs) return;
  if (!one.begun && !value) return;  // nothing was ever known of it
  one.begun = true;
  one.last = value;
  one.appended_ns = time_ns;
  batch_.push_back({one.tag, {time_ns, value.value_or(0.0), value ? Quality::Good : Quality::Missing}});
}

void CellRecorder::record_epoch(std::int64_t time_ns) {
  if (time_ns - epoch_written_ns_ < kEpochPeriodNs && epoch_written_ns_ != 0) return;
  epoch_written_ns_ = time_ns;
  const double epoch_us = static_cast<double>(clock_->epoch_ns() / 1'000);
  batch_.push_back({*epoch_tag_, {time_ns, epoch_us, Quality::Good}});
}

void CellRecorder::record_image(std::int64_t time_ns, const server::CellView& view) {
  take_layout(view.layout);
  const protocol::CellState& state = view.state;
  for (std::size_t i = 0; i < points_.size(); ++i) record(points_[i], time_ns, state.points.at(i));
  const std::vector<bool> unread = unread_tags(state);
  for (std::size_t i = 0; i < tags_.size() && i < state.tags.size(); ++i)
    record(tags_[i], time_ns, unread[i] ? std::nullopt : state.tags[i]);
  record_epoch(time_ns);
  missing_ = false;
}

void CellRecorder::record_missing(std::int64_t time_ns) {
  if (missing_) return;
  missing_ = true;
  for (std::vector<Series>* all : {&points_, &tags_})
    for (Series& one : *all) record(one, time_ns, std::nullopt);
  historian_->append(batch_);
  batch_.clear();
}

// Whether what has come since the newest image was not all that there was to come. Images that waited
// together come together: what lies between them shows in the scan's time, at the pace at which it goes.
bool CellRecorder::has_gap(const server::Observation& seen, std::int64_t steady_ns,
                           std::optional<std::int64_t> time_ns) const {
  if (missing_ || seen.images == 0 || came_ns_ == 0) return false;
  std::int64_t apart_ns = steady_ns - came_ns_;
  if (time_ns) {
    const double pace = !options_.real_time && seen.status ? seen.status->realtime_factor : 1.0;
    const double scan_ns = static_cast<double>(*time_ns - seen_until_ns_) / std::max(1.0, pace);
    apart_ns = std::max(apart_ns, static_cast<std::int64_t>(scan_ns));
  }
  return apart_ns > kSilentNs || (seen.images_lost > images_lost_ && apart_ns > kUnseenNs);
}

void CellRecorder::note_arrival(const server::Observation& seen, bool fresh, std::int64_t steady_ns) {
  if (!fresh && seen.images == images_) return;
  came_ns_ = steady_ns;
  images_ = seen.images;
  images_lost_ = seen.images_lost;
}

std::optional<std::string> CellRecorder::take(const server::Observation& seen, const server::CellView& view) {
  const bool has_image = seen.runtime_alive && seen.snapshot;
  const std::int64_t steady_ns = options_.steady_clock();
  const std::int64_t wall_ns = calendar_->at(wall_clock_(), steady_ns);
  if (has_image) {
    if (!has_answered_) alarms_->runtime_answers(clock_->passed(wall_ns));
    const auto scan_ns = static_cast<std::int64_t>(std::llround(seen.snapshot->time_s * 1e9));
    const std::int64_t time_ns = clock_->at(scan_ns, wall_ns);
    *now_ns_ = time_ns;
    // While the clock stands still (a barrier, a hold) the same image comes again and again.
    const bool fresh =
        seen.snapshot->scan != scan_ || seen.snapshot->time_s != scan_time_s_ || view.layout != layout_;
    const auto next = fresh ? std::optional(time_ns) : std::nullopt;
    if (has_gap(seen, steady_ns, next) && (!fresh || time_ns > seen_until_ns_ + kBehindNs))
      record_missing(seen_until_ns_ + kBehindNs);
    note_arrival(seen, fresh, steady_ns);
    if (fresh) {
      seen_until_ns_ = time_ns;
      scan_ = seen.snapshot->scan;
      scan_time_s_ = seen.snapshot->time_s;
      record_image(time_ns, view);
      historian_->append(batch_);
      batch_.clear();
    }
  } else {
    *now_ns_ = clock_->without_scan(wall_ns);
    // Who was kept from looking for long does not know when the runtime has gone.
    record_missing(has_gap(seen, steady_ns, {}) ? seen_until_ns_ + kBehindNs : now_ns_->load());
  }
  has_answered_ = has_image;
  const std::int64_t ahead_ns = options_.real_time ? *now_ns_ - wall_ns : 0;
  ahead_s_ = ahead_ns > kAheadNs ? ahead_ns / 1'000'000'000 : 0;
  if (noted_ns_ != *now_ns_) historian_->note_until(noted_ns_ = *now_ns_);
  alarms_->take({*now_ns_, &seen, &view});
  return message();
}

std::chrono::seconds CellRecorder::calendar_ahead() const {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::nanoseconds(calendar_->ahead_ns()));
}

result::Result<void> CellRecorder::flush() {
  if (auto done = historian_->flush(); !done) return done;
  return alarms_->flush();
}

std::optional<std::string> CellRecorder::message() {
  const auto now = std::chrono::steady_clock::now();
  const std::uint64_t revision = alarms_->revision();
  if (revision == told_revision_ && now - told_ < kFiguresPeriod) return std::nullopt;
  told_revision_ = revision;
  told_ = now;
  std::string text = R"({"type":"alarms",)" + alarms_->json(false).substr(1);
  if (text == told_message_) return std::nullopt;
  told_message_ = text;
  return text;
}

}  // namespace stepwright::recorder
