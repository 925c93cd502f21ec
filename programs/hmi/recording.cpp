#include "programs/hmi/recording.h"

#include <chrono>
#include <utility>

#include "hmi_web/alarms/definition_file.h"

namespace stepwright::hmi {
namespace {

// A program with more monitors than a page is told values of has none of them among its tags.
constexpr std::uint32_t kMostMonitors = 128;

std::int64_t real_time_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

result::Result<std::unique_ptr<recorder::CellRecorder>> open_recorder(const config::CellConfig& config,
                                                                      const protocol::Synoptic& synoptic) {
  const config::HistoryConfig& history = config.history;
  if (history.folder.empty()) return nullptr;
  const bool plans = !config.planning.domain.empty();
  recorder::BuiltInAlarms wanted;
  wanted.supervisor = plans || !config.fleet.problem.empty();
  wanted.monitors = plans && config.planning.monitors ? kMostMonitors : 0;
  recorder::RecorderOptions options;
  options.folder = history.folder;
  options.real_time = config.clock.mode == config::ClockMode::Real;
  options.most_age = history.most_age;
  options.most_bytes = history.max_mb << 20;
  options.points = synoptic.points;
  options.alarms = recorder::built_in_alarms(synoptic, wanted);
  if (!history.alarms.empty()) {
    auto more = alarms::load_alarms(history.alarms);
    if (!more) return result::forward(more);
    options.alarms.insert(options.alarms.end(), std::make_move_iterator(more->begin()),
                          std::make_move_iterator(more->end()));
  }
  return recorder::CellRecorder::open(std::move(options), real_time_ns);
}

}  // namespace stepwright::hmi
