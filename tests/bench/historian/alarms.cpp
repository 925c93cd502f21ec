#include "tests/bench/historian/alarms.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hmi_web/alarms/engine.h"
#include "hmi_web/alarms/journal.h"
#include "hmi_web/alarms/statistics.h"
#include "hmi_web/storage/database.h"

namespace stepwright::bench {
namespace {

using namespace alarms;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kSingleCommits = 500;  // each waits for the disk

template <typename T>
T checked(result::Result<T> made) {
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*made);
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<AlarmDefinition> make_definitions(std::uint32_t count) {
  std::vector<AlarmDefinition> made(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    made[i].name = "alarm" + std::to_string(i);
    made[i].source = "main.level[" + std::to_string(i) + "]";
    made[i].condition = {ConditionKind::High, 9.0, 0.5};
    made[i].group = "group" + std::to_string(i / 10);
  }
  return made;
}

class Plant {
 public:
  Plant(const AlarmLoad& load, const std::filesystem::path& file)
      : definitions_(make_definitions(load.alarms)),
        engine_(checked(AlarmEngine::create(definitions_))),
        statistics_(definitions_),
        journal_(checked(AlarmJournal::open(file, definitions_))) {}

  // One change of one alarm: all are raised, then all return.
  void change() {
    const auto alarm = static_cast<std::uint32_t>(changes_ % definitions_.size());
    const bool raise = changes_ / definitions_.size() % 2 == 0;
    ++changes_;
    engine_.offer(SourceId(alarm), static_cast<std::int64_t>(changes_) * 10'000, raise ? 9.5 : 8.0, true);
  }
  void hand_over() {
    const auto transitions = engine_.take();
    for (const Transition& transition : transitions) statistics_.note(transition);
    journal_->append(transitions);
  }
  // How many changes the journal does not have.
  std::size_t lost() {
    checked(journal_->flush());
    return changes_ - checked(journal_->find({}, changes_ + 1)).size();
  }
  void flush() { checked(journal_->flush()); }

 private:
  std::vector<AlarmDefinition> definitions_;
  AlarmEngine engine_;
  AlarmStatistics statistics_;
  std::unique_ptr<AlarmJournal> journal_;
  std::size_t changes_ = 0;
};

// Rows of the same shape.
double plain_rows_per_s(const std::filesystem::path& file, std::size_t rows, bool one_transaction) {
  storage::DatabaseOptions options;
  options.durable = true;
  auto database =
      checked(storage::Database::open(file, options,
                                      "CREATE TABLE entry(id INTEGER PRIMARY KEY, time_ns INTEGER, alarm "
                                      "INTEGER, event INTEGER, state INTEGER, value REAL, "
                                      "user TEXT, comment TEXT); CREATE INDEX t ON entry(time_ns); CREATE "
                                      "INDEX a ON entry(alarm, time_ns);"));
  auto insert = checked(database.prepare(
      "INSERT INTO entry(time_ns, alarm, event, state, value, user, comment) VALUES(?, ?, ?, ?, ?, '', '')"));
  const auto begin = Clock::now();
  if (one_transaction) checked(database.execute("BEGIN"));
  for (std::size_t i = 0; i < rows; ++i) {
    const auto n = static_cast<std::int64_t>(i);
    insert.bind(1, n).bind(2, n % 1000).bind(3, n % 2).bind(4, n % 2);
    checked(insert.bind(5, 9.5).run());
  }
  if (one_transaction) checked(database.execute("COMMIT"));
  return static_cast<double>(rows) / seconds_since(begin);
}

struct Burst {
  std::size_t changes = 0;
  std::size_t lost = 0;
  double longest_ms = 0.0;  // of handing over the changes of 10 ms
};

Burst measure_burst(const AlarmLoad& load, const std::filesystem::path& file) {
  Plant plant(load, file);
  Burst burst;
  const auto period = std::chrono::milliseconds(10);
  const auto per_period = static_cast<std::size_t>(load.rate / 100.0);
  auto due = Clock::now();
  for (int i = 0; i < static_cast<int>(load.seconds * 100.0); ++i) {
    std::this_thread::sleep_until(due += period);
    const auto begin = Clock::now();
    for (std::size_t k = 0; k < per_period; ++k) plant.change();
    plant.hand_over();
    burst.longest_ms = std::max(burst.longest_ms, 1e3 * seconds_since(begin));
    burst.changes += per_period;
  }
  burst.lost = plant.lost();
  return burst;
}

}  // namespace

nlohmann::json measure_alarms(const AlarmLoad& load, const std::filesystem::path& folder) {
  double changes_per_s = 0.0;
  std::size_t lost = 0;
  {
    Plant plant(load, folder / "fast.db");
    const auto begin = Clock::now();
    for (std::size_t i = 0; i < load.changes; ++i) {
      plant.change();
      if (i % 100 == 99) plant.hand_over();
    }
    plant.hand_over();
    plant.flush();
    changes_per_s = static_cast<double>(load.changes) / seconds_since(begin);
    lost = plant.lost();
  }
  const double batched = plain_rows_per_s(folder / "batched.db", load.changes, true);
  const double single = plain_rows_per_s(folder / "single.db", kSingleCommits, false);
  const Burst burst = measure_burst(load, folder / "burst.db");
  std::printf("\nalarms: engine, figures and journal   %10.0f changes/s, %zu of %zu lost\n", changes_per_s,
              lost, load.changes);
  std::printf("plain inserts, one transaction        %10.0f rows/s\n", batched);
  std::printf("plain inserts, a commit for each      %10.0f rows/s\n", single);
  std::printf("%.0f changes/s for %.0f s: %zu of %zu lost, longest hand-over of 10 ms' changes %.2f ms\n",
              load.rate, load.seconds, burst.lost, burst.changes, burst.longest_ms);
  return {{"alarm_changes_per_s", changes_per_s}, {"alarm_changes_lost", lost + burst.lost},
          {"plain_rows_per_s", batched},          {"plain_commits_per_s", single},
          {"burst_changes_per_s", load.rate},     {"burst_longest_hand_over_ms", burst.longest_ms}};
}

}  // namespace stepwright::bench
