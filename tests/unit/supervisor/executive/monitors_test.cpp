// The monitors of a generated program in the real scan and plant: what is lost in scan k is an alarm of scan
// k.

#include "supervisor/translate/monitors.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "supervisor/pddl/plan/describe_run.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using support::PlantFault;
using support::SimulatedController;
using translate::Monitor;
using translate::MonitorKind;

struct Raised {
  Monitor monitor;
  std::string action;
  std::uint64_t scan = 0;     // as the program says
  std::uint64_t seen_in = 0;  // in which the test saw it
  double value = 0.0;
};

// The optimal plan's program on a bench with exact sensors, for so many scans.
class MonitoredRun {
 public:
  explicit MonitoredRun(std::vector<PlantFault> faults, const PlanningService& planning = bench_planning())
      : controller_(exact_bench(), std::move(faults)) {
    const auto initial = pddl::to_named(planning.task().initial());
    prepared_ = std::move(planning.prepare({.start = {.planning = initial}})->prepared);
    std::vector<std::string> names = {
        translate::kAlarmCount, "S1_filtered", "S2_filtered", "S3_filtered", "fc1", "fc2", "fc3"};
    for (std::size_t i = 0; i < prepared_.translation.monitors.size(); ++i) {
      names.push_back(translate::alarm_scan_variable(i));
      names.push_back(translate::alarm_value_variable(i));
    }
    reader_ = *run::ImageReader::create(prepared_.container, prepared_.translation.instance, names);
    controller_.on_scan = [this](std::span<const std::byte> image) { look(image); };
  }

  // Until the chart is done or has failed, or `scans` have passed.
  void run(std::uint64_t scans) {
    ASSERT_TRUE(controller_.download(prepared_.container));
    ASSERT_TRUE(controller_.start(true));
    while (scan_ < scans) {
      const auto event = controller_.wait_event(std::chrono::milliseconds(0));
      if (!event) break;
      events_.push_back(event->scan);
      (void)controller_.acknowledge(event->sequence);
      const auto now = translate::progress(prepared_.translation, reader_->active_steps(event->image));
      if (now.finished || !now.failed_steps.empty()) break;
    }
  }

  const std::vector<Raised>& raised() const { return raised_; }
  const std::vector<std::uint64_t>& events() const { return events_; }
  const PreparedPlan& prepared() const { return prepared_; }
  double value(std::uint64_t scan, const std::string& name) const { return history_.at(name).at(scan - 1); }

 private:
  void look(std::span<const std::byte> image) {
    ++scan_;
    const auto values = reader_->values(image);
    for (const char* name : {"S1_filtered", "S2_filtered", "S3_filtered", "fc1", "fc2", "fc3"}) {
      history_[name].push_back(values.at(name));
    }
    if (values.at(translate::kAlarmCount) == static_cast<double>(raised_.size())) return;
    for (std::size_t i = 0; i < prepared_.translation.monitors.size(); ++i) {
      const double scan = values.at(translate::alarm_scan_variable(i));
      if (scan == 0.0 || !told_.insert(i).second) continue;
      const Monitor& monitor = prepared_.translation.monitors[i];
      raised_.push_back(
          {monitor, monitor.action ? model::to_string(prepared_.plan.actions[*monitor.action]) : "",
           static_cast<std::uint64_t>(scan), scan_, values.at(translate::alarm_value_variable(i))});
    }
  }

  SimulatedController controller_;
  PreparedPlan prepared_;
  std::optional<run::ImageReader> reader_;
  std::uint64_t scan_ = 0;
  std::set<std::size_t> told_;
  std::vector<Raised> raised_;
  std::vector<std::uint64_t> events_;
  std::map<std::string, std::vector<double>> history_;
};

TEST(Monitors, WhenNothingGoesWrong_ThenNoAlarmIsRaised) {
  MonitoredRun run({});
  run.run(20'000);
  EXPECT_GT(run.events().back(), 5'000u);
  EXPECT_GT(run.prepared().translation.monitors.size(), 50u);
  for (const Raised& raised : run.raised()) ADD_FAILURE() << raised.action << ": " << raised.monitor.text;
}

TEST(Monitors, WhenASwitchClosesInScanK_ThenTheAlarmIsOfScanK) {
  MonitoredRun run({{5.0, "stuck_fc2", 1.0}});
  run.run(1'000);
  ASSERT_FALSE(run.raised().empty());
  const Raised& first = run.raised().front();
  std::uint64_t closed = 1;
  while (run.value(closed, "fc2") == 0.0) ++closed;
  EXPECT_NEAR(static_cast<double>(closed), 500.0, 2.0);
  EXPECT_EQ(first.scan, closed);
  EXPECT_EQ(first.seen_in, closed);
  EXPECT_EQ(first.monitor.kind, MonitorKind::Invariant);
  EXPECT_EQ(first.monitor.text, "not 'vehicle at a1'");
  EXPECT_EQ(first.value, 1.0);
  // Whoever follows the program is told in the same scan.
  EXPECT_NE(std::find(run.events().begin(), run.events().end(), closed), run.events().end());
}

TEST(Monitors, WhenALevelLeavesItsToleranceInScanK_ThenTheAlarmIsOfScanK) {
  MonitoredRun run({{4.0, "drift_s3", 50.0}});
  run.run(1'000);
  ASSERT_FALSE(run.raised().empty());
  const Raised& first = run.raised().front();
  // 0.2 of a level above 2: (1773 - 1061) / 3 counts each.
  std::uint64_t left = 1;
  while (run.value(left, "S3_filtered") <= 1108.0) ++left;
  EXPECT_EQ(first.scan, left);
  EXPECT_EQ(first.seen_in, left);
  EXPECT_EQ(first.monitor.kind, MonitorKind::Invariant);
  EXPECT_EQ(first.monitor.sensor, "S3");
  EXPECT_EQ(first.value, run.value(left, "S3_filtered"));
}

// It leaks while it is loaded and after: the pump stops at the level, and there is less when the action is
// done.
TEST(Monitors, WhenAnActionEndsWithoutItsEffect_ThenTheAlarmIsOfTheScanInWhichItIsDone) {
  MonitoredRun run({{3.0, "leak_v1", 3.0}});
  run.run(4'000);
  const auto effect = std::find_if(run.raised().begin(), run.raised().end(), [](const Raised& raised) {
    return raised.monitor.kind == MonitorKind::Effect && raised.monitor.sensor == "S1";
  });
  ASSERT_NE(effect, run.raised().end());
  EXPECT_EQ(effect->action.rfind("(load v1 f1", 0), 0u) << effect->action;
  EXPECT_EQ(effect->scan, effect->seen_in);
}

TEST(Monitors, WhenAnActionIsRefused_ThenThePartOfItsPreconditionIsNamed) {
  MonitoredRun run({{15.5, "leak_v1", 3.0}});
  run.run(4'000);
  const auto refused = std::find_if(run.raised().begin(), run.raised().end(), [](const Raised& raised) {
    return raised.monitor.kind == MonitorKind::Precondition;
  });
  ASSERT_NE(refused, run.raised().end());
  EXPECT_EQ(refused->action, "(unload v1 a1 level7)");
  EXPECT_NE(refused->monitor.text.find("S1_filtered >= "), std::string::npos) << refused->monitor.text;
  EXPECT_EQ(refused->scan, refused->seen_in);
  EXPECT_EQ(refused->scan, run.events().back());
}

// What two levels must be together is no comparison of counts but an expression over their values.
TEST(Monitors, WhenAPreconditionAddsLevels_ThenTheirSumIsWatchedToo) {
  const support::TemporaryFolder folder;
  PlanningOptions options = bench_planning_options();
  std::stringstream text;
  text << std::ifstream(options.domain).rdbuf();
  std::string domain = text.str();
  const std::string guard = "(>= (- (lev ?v) (amount ?l)) (critical ?v))";
  ASSERT_NE(domain.find(guard), std::string::npos);
  domain.insert(domain.find(guard), "(>= (+ (lev ?v) (level ?d)) (+ (amount ?l) 4)) ");
  options.domain = folder / "domain.pddl";
  std::ofstream(options.domain) << domain;
  const auto planning = PlanningService::open(options);
  ASSERT_TRUE(planning) << result::to_string(planning.error());
  MonitoredRun run({{15.5, "leak_v1", 6.0}}, *planning);
  run.run(4'000);
  const auto sum = std::find_if(run.raised().begin(), run.raised().end(), [](const Raised& raised) {
    return raised.monitor.kind == MonitorKind::Precondition && raised.monitor.reading == "S1_value";
  });
  ASSERT_NE(sum, run.raised().end());
  EXPECT_NE(sum->monitor.text.find("S2_value"), std::string::npos) << sum->monitor.text;
  EXPECT_EQ(sum->scan, run.events().back());
  EXPECT_GT(sum->value, 1.0);  // levels, not counts
  EXPECT_LT(sum->value, 9.0);
}

// Its counts are still after that, as those of any transmitter without noise are: only of one that must move
// that is a fault of its own.
TEST(Monitors, WhenAPumpStandsStillHalfway_ThenTheAlarmComesAfterTheNominalTimeOfThreeUnits) {
  const support::TemporaryFolder folder;
  const PlanningService plain = bench_planning_without("must_move = true\n", folder.path());
  for (const PlanningService* planning : {&bench_planning(), &plain}) {
    MonitoredRun run({{5.0, "weak_b1", 0.0}}, *planning);
    run.run(1'200);
    std::map<MonitorKind, std::vector<Raised>> of;
    for (const Raised& raised : run.raised()) of[raised.monitor.kind].push_back(raised);
    EXPECT_EQ(of[MonitorKind::Motion].size(), planning == &plain ? 0u : 1u);
    ASSERT_EQ(of[MonitorKind::Standstill].size(), 1u);
    const Raised& still = of[MonitorKind::Standstill].front();
    EXPECT_EQ(still.action.rfind("(load v1 f1", 0), 0u) << still.action;
    EXPECT_EQ(still.monitor.text, "level of v1 goes on while it is moved");
    EXPECT_EQ(still.scan, still.seen_in);
    EXPECT_GT(still.scan, 500u + 250u);
    EXPECT_LT(still.scan, 500u + 600u);
  }
}

bool is_rate(const Raised& raised) {
  return raised.monitor.kind == MonitorKind::Rate;
}

// S3 has 237 counts a unit and a filter of 25 scans.
TEST(Monitors, WhenAReadingChangesFasterThanThePlantCan_ThenTheAlarmComesWithinTheTimeOfItsFilter) {
  const support::TemporaryFolder folder;
  const PlanningService planning =
      bench_planning_with("must_move = true\n", "must_move = true\nmax_rate = 1\n", folder.path());
  MonitoredRun sound({}, planning);
  sound.run(20'000);
  for (const Raised& raised : sound.raised()) ADD_FAILURE() << raised.action << ": " << raised.monitor.text;
  MonitoredRun slow({{4.0, "drift_s3", 200.0}}, planning);
  slow.run(1'000);
  EXPECT_TRUE(std::none_of(slow.raised().begin(), slow.raised().end(), is_rate));
  MonitoredRun fast({{4.0, "drift_s3", 1'000.0}}, planning);
  fast.run(1'000);
  const auto leap = std::find_if(fast.raised().begin(), fast.raised().end(), is_rate);
  ASSERT_NE(leap, fast.raised().end());
  EXPECT_EQ(leap->action, "");
  EXPECT_EQ(leap->monitor.sensor, "S3");
  EXPECT_EQ(leap->monitor.text, "level of a2 changes by no more than 1 in a second");
  EXPECT_EQ(leap->scan, leap->seen_in);
  EXPECT_GT(leap->scan, 403u);
  EXPECT_LE(leap->scan, 428u);
}

TEST(Monitors, WhenTheBindingHasTheirNames_ThenRefused) {
  const auto initial = pddl::to_named(bench_planning().task().initial());
  auto prepared = bench_planning().prepare({.start = {.planning = initial}});
  ASSERT_TRUE(prepared);
  translate::Translation& made = prepared->prepared.translation;  // it has them already
  const auto again = translate::add_monitors(made, prepared->prepared.run, bench_planning().binding(), {});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().front().code, "T0006");
}

}  // namespace
}  // namespace stepwright::executive
