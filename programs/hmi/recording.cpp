#include "programs/hmi/recording.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "cell/hmi/alarm_list.h"
#include "cell/tags/tag_notes.h"
#include "hmi_web/storage/codes.h"

namespace stepwright::hmi {
namespace {

constexpr std::chrono::seconds kBetweenLooks{1};

std::int64_t real_time_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

result::Result<recorder::RecorderOptions> options_of(const config::CellConfig& config,
                                                     const protocol::Synoptic& synoptic) {
  const config::HistoryConfig& history = config.history;
  auto alarms = alarms_of(config, synoptic);
  if (!alarms) return result::forward(alarms);
  recorder::RecorderOptions options;
  options.folder = history.folder;
  options.real_time = config.clock.mode == config::ClockMode::Real;
  options.most_age = history.most_age;
  options.most_bytes = history.max_mb << 20;
  options.points = synoptic.points;
  options.notes = tags::tag_notes(config.tags);
  options.alarms = std::move(*alarms);
  return options;
}

}  // namespace

result::Result<std::unique_ptr<Recording>> Recording::open(const config::CellConfig& config,
                                                           const protocol::Synoptic& synoptic,
                                                           log::Logger& log) {
  if (config.history.folder.empty()) return nullptr;
  auto options = options_of(config, synoptic);
  if (!options) return result::forward(options);
  std::unique_ptr<Recording> recording(new Recording(std::move(*options), log));
  if (auto problem = recording->try_to_open()) {
    if (!storage::is_of_the_disk(*problem)) return tl::unexpected(*std::move(problem));
    log.error("history", "nothing is recorded: " + result::to_string(*problem) + "; tried again every " +
                             std::to_string(kBetweenTries.count()) + " s");
  }
  return recording;
}

std::optional<result::Diagnostics> Recording::try_to_open() {
  next_try_ = std::chrono::steady_clock::now() + kBetweenTries;
  auto recorder = recorder::CellRecorder::open(options_, real_time_ns);
  const std::lock_guard lock(mutex_);
  if (!recorder) return problem_ = recorder.error();
  recorder_ = std::move(*recorder);
  queries_.emplace(*recorder_);
  problem_.clear();
  return std::nullopt;
}

std::optional<std::string> Recording::take(const server::Observation& seen, const server::CellView& view) {
  // Only this thread ever writes them.
  if (!recorder_) {
    const bool told = !problem_.empty() && next_try_ > std::chrono::steady_clock::now();
    if (!told && !try_to_open()) log_.info("history", "values and alarms are recorded from here on");
    if (!recorder_)
      return R"({"type":"alarms",)" + recorder::no_alarms_json(result::to_string(problem_)).substr(1);
  }
  note_calendar();
  auto message = recorder_->take(seen, view);
  note_variables();
  note_disk();
  return message;
}

// What waits for room is written when there is some, as much as memory may keep meanwhile.
void Recording::note_disk() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_look_) return;
  next_look_ = now + kBetweenLooks;
  const historian::HistorianStatus values = recorder_->historian().status();
  const alarms::JournalStatus journal = recorder_->alarms().journal().status();
  const bool failing = values.failing || journal.failing;
  if (std::exchange(failing_, failing) == failing) return;
  if (!failing) return log_.info("history", "values and alarms are recorded again");
  log_.error("history", "nothing can be recorded: " +
                            result::to_string(values.failing ? values.problems : journal.problems) +
                            "; it is kept in memory and tried again");
}

Recording::~Recording() {
  if (!recorder_) return;
  if (const auto done = recorder_->flush(); !done)
    log_.error("history", "what was recorded last is lost: " + result::to_string(done.error()));
}

// A program that lacks what an alarm watches is told once for each: nothing else would show it.
void Recording::note_variables() {
  const std::uint64_t revision = recorder_->alarms().revision();
  if (std::exchange(alarms_revision_, revision) == revision) return;
  auto missing = recorder_->alarms().without_variable();
  for (const auto& each : missing) {
    if (std::ranges::find(without_variable_, each) != without_variable_.end()) continue;
    log_.warning("alarms", "the program has no variable '" + each.second + "': the alarm '" + each.first +
                               "' cannot come");
  }
  for (const auto& each : without_variable_) {
    if (std::ranges::find(missing, each) == missing.end())
      log_.info("alarms", "the alarm '" + each.first + "' has its variable '" + each.second + "' again");
  }
  without_variable_ = std::move(missing);
}

std::vector<notify::StandingAlarm> Recording::unacknowledged() const {
  const std::shared_lock lock(mutex_);
  std::vector<notify::StandingAlarm> all;
  if (!recorder_) return all;
  for (const auto& [definition, view, told] : recorder_->alarms().unacknowledged())
    all.push_back({definition.name, definition.text, definition.source, definition.response,
                   definition.priority, view.raised_ns, view.value, told.is_bool, told.text, told.unit});
  return all;
}

void Recording::note_calendar() {
  const auto ahead = recorder_->calendar_ahead();
  if (doubted_ == (ahead.count() > 0)) return;
  doubted_ = !doubted_;
  if (!doubted_) return log_.info("history", "the machine's calendar is believed again");
  log_.error(
      "history",
      "the machine's calendar stands " + std::to_string(ahead.count() / 86'400) +
          " days ahead of what was recorded last: the history goes on from there until the calendar is "
          "right, or an engineer accepts it on the page");
}

api::Answer Recording::answer(Ask ask, const Parameters& given) const {
  const std::shared_lock lock(mutex_);
  return queries_ ? ((*queries_).*ask)(given) : api::refused(problem_);
}

api::Answer Recording::tags(const Parameters& given) const {
  return answer(&recorder::RecordQueries::tags, given);
}

api::Answer Recording::trend(const Parameters& given) const {
  return answer(&recorder::RecordQueries::trend, given);
}

api::Answer Recording::samples_csv(const Parameters& given) const {
  return answer(&recorder::RecordQueries::samples_csv, given);
}

api::Answer Recording::alarms(const Parameters& given) const {
  return answer(&recorder::RecordQueries::alarms, given);
}

api::Answer Recording::journal(const Parameters& given) const {
  return answer(&recorder::RecordQueries::journal, given);
}

api::Answer Recording::journal_csv(const Parameters& given) const {
  return answer(&recorder::RecordQueries::journal_csv, given);
}

result::Result<api::AlarmChange> Recording::act(const api::AlarmAction& action) {
  const std::shared_lock lock(mutex_);
  if (!queries_) return tl::unexpected(problem_);
  return queries_->act(action);
}

bool Recording::accept_calendar() {
  const std::shared_lock lock(mutex_);
  return queries_ && queries_->accept_calendar();
}

}  // namespace stepwright::hmi
