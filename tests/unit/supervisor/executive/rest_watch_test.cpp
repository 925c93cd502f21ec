#include "supervisor/executive/rest_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/run/image_reader.h"
#include "supervisor/translate/estimate.h"
#include "supervisor/translate/progress.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

// The bench with 2 in every tank and the vehicle at f1.
class RestWatchTest : public ::testing::Test {
 protected:
  RestWatchTest() {
    model::NamedState start;
    start.facts = {"(is-at v1 f1)"};
    start.fluents = {{"(lev v1)", 2.0}, {"(level a1)", 2.0}, {"(level a2)", 2.0}};
    watch_.emplace(bench_planning().binding(), translate::Tare{}, start);
  }

  std::optional<std::string> see(double s2_level) {
    const auto& sensors = bench_planning().binding().sensors;
    values_["S1"] = sensors[0].calibration.counts_at(2.0);
    values_["S2"] = sensors[1].calibration.counts_at(s2_level);
    values_["S3"] = sensors[2].calibration.counts_at(2.0);
    return watch_->see(values_, ++scan_);
  }

  std::map<std::string, double> values_ = {{"fc1", 1.0}, {"fc2", 0.0}, {"fc3", 0.0}};
  std::optional<RestWatch> watch_;
  std::uint64_t scan_ = 0;
};

TEST_F(RestWatchTest, WhenNothingMoves_ThenThereIsNoNews) {
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(see(2.0 + (i % 2 == 0 ? 0.3 : -0.3)));
}

TEST_F(RestWatchTest, WhenALevelWalksAway_ThenItIsNamed) {
  std::optional<std::string> news;
  int i = 0;
  for (; i < 100 && !news; ++i) news = see(2.0 - 0.02 * i);
  ASSERT_TRUE(news);
  EXPECT_NE(news->find("level of a1"), std::string::npos) << *news;
  EXPECT_LT(i, 45);
}

TEST_F(RestWatchTest, WhenASwitchBounces_ThenOnlyALastingChangeIsNews) {
  values_["fc1"] = 0.0;
  EXPECT_FALSE(see(2.0));
  values_["fc1"] = 1.0;
  EXPECT_FALSE(see(2.0));
  values_["fc1"] = 0.0;
  EXPECT_FALSE(see(2.0));
  const auto news = see(2.0);
  ASSERT_TRUE(news);
  EXPECT_EQ(*news, "'vehicle at f1' is not observed now");
}

TEST_F(RestWatchTest, WhenAScanIsSeenTwice_ThenItCountsOnce) {
  values_["fc1"] = 0.0;
  EXPECT_FALSE(see(2.0));
  --scan_;
  EXPECT_FALSE(see(2.0));
}

// The bench itself, with noise and bias on its sensors, looked at in every scan of a program from a certain
// time on.
class MovingPlant {
 public:
  explicit MovingPlant(std::vector<support::PlantFault> faults)
      : controller_(parameters(), std::move(faults)) {}

  // Looks at the plant at rest as a decision of the executive does, and watches from then until `until_s`.
  void watch_at_rest(double until_s) {
    look();
    watch(until_s);
  }

  // The plan's own program drives the plant while its start is watched.
  void watch_driven(double until_s) {
    const StartState now = look();
    const auto plan = bench_planning().prepare({.start = now});
    start(plan->prepared);
    watch(until_s);
  }

  const std::optional<std::string>& news() const { return news_; }
  double news_s() const { return news_s_; }

 private:
  static assemblies::BenchParameters parameters() {
    assemblies::BenchParameters parameters;
    parameters.seed = 11;
    return parameters;
  }

  static double seconds(const support::SimulatedController& controller) {
    return static_cast<double>(controller.snapshot()->time_ns) * 1e-9;
  }

  void start(const PreparedPlan& program) {
    std::vector<std::string> variables;
    for (const translate::Sensor& sensor : bench_planning().binding().sensors) {
      variables.push_back(translate::filtered_variable(sensor));
      variables.push_back(sensor.tag);
    }
    for (const translate::ObservedFact& fact : bench_planning().binding().facts)
      variables.push_back(fact.tag);
    reader_ = *run::ImageReader::create(program.container, program.translation.instance, variables);
    ASSERT_TRUE(controller_.download(program.container));
    ASSERT_TRUE(controller_.start(false));
  }

  void step(const PreparedPlan& observer) {
    const auto event = controller_.wait_event(std::chrono::milliseconds(0));
    if (!event) throw std::runtime_error("the observer does not end");
    (void)controller_.acknowledge(event->sequence);
    if (translate::progress(observer.translation, reader_->active_steps(event->image)).finished) {
      means_ = reader_->values(event->image);
    }
  }

  StartState look() {
    const PreparedPlan observer = *bench_planning().observer(false, std::chrono::milliseconds(3'000));
    start(observer);
    while (!means_) step(observer);
    const model::NamedState known = pddl::to_named(bench_planning().task().initial());
    const translate::Tare tare = *translate::identify_tare(bench_planning().binding(), *means_, known);
    const auto seen = *translate::estimate(bench_planning().binding(), *means_, tare, known);
    watch_.emplace(bench_planning().binding(), tare, seen.measured);
    return {.planning = seen.planning, .measured = seen.measured.fluents, .tare = tare, .goal = {}};
  }

  void watch(double until_s) {
    std::uint64_t scan = 0;
    controller_.on_scan = [&](std::span<const std::byte> image) {
      const auto seen = watch_->see(reader_->values(image), ++scan);
      if (!seen || news_) return;
      news_ = seen;
      news_s_ = seconds(controller_);
    };
    controller_.kill_runtime_at(until_s);  // ends the watch
    while (controller_.alive()) {
      if (const auto event = controller_.wait_event(std::chrono::milliseconds(0)))
        (void)controller_.acknowledge(event->sequence);
    }
  }

  support::SimulatedController controller_;
  std::optional<run::ImageReader> reader_;
  std::optional<translate::Values> means_;
  std::optional<RestWatch> watch_;
  std::optional<std::string> news_;
  double news_s_ = 0.0;
};

TEST(RestWatchOfThePlant, WhenItIsAtRest_ThenNoiseIsNoNews) {
  MovingPlant plant({});
  plant.watch_at_rest(40.0);
  EXPECT_FALSE(plant.news()) << *plant.news();
}

// 1 percent a second from 10 s on; the tolerance of 0.2 levels counts twice.
TEST(RestWatchOfThePlant, WhenATankLeaks_ThenItIsNewsWithinSeconds) {
  MovingPlant plant({{10.0, "leak_a1", 1.0}});
  plant.watch_at_rest(30.0);
  ASSERT_TRUE(plant.news());
  EXPECT_NE(plant.news()->find("level of a1 is 1."), std::string::npos) << *plant.news();
  EXPECT_GT(plant.news_s(), 12.0);
  EXPECT_LT(plant.news_s(), 16.0);
}

TEST(RestWatchOfThePlant, WhenACustomerDraws_ThenItIsNews) {
  MovingPlant plant({{10.0, "draw_c2", 10.0}});
  plant.watch_at_rest(30.0);
  ASSERT_TRUE(plant.news());
  EXPECT_NE(plant.news()->find("level of a2"), std::string::npos) << *plant.news();
}

TEST(RestWatchOfThePlant, WhenASwitchChanges_ThenItIsNewsAfterTwoScans) {
  MovingPlant plant({{10.0, "stuck_fc1", 0.0}});
  plant.watch_at_rest(20.0);
  ASSERT_TRUE(plant.news());
  EXPECT_EQ(*plant.news(), "'vehicle at f1' is not observed now");
  EXPECT_LT(plant.news_s(), 10.1);
}

// What still runs moves the plant away from the state that the next plan would start in.
TEST(RestWatchOfThePlant, WhenAProgramDrivesIt_ThenWhatMovesFirstIsNews) {
  MovingPlant plant({});
  plant.watch_driven(30.0);
  ASSERT_TRUE(plant.news());
  EXPECT_NE(plant.news()->find("level of v1"), std::string::npos) << *plant.news();
}

}  // namespace
}  // namespace stepwright::executive
