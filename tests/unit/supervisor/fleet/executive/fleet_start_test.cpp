// A fleet whose first plan waits for an operator: shown, not downloaded, and begun when somebody wants it.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"
#include "tests/unit/supervisor/fleet/executive/small_hall.h"

namespace stepwright::fleet {
namespace {

using run::Phase;
using run::RunRecord;

std::string code(const result::Result<void>& answer) {
  return answer ? std::string() : answer.error().front().code;
}

// A hall whose executive asks the test at each news what is to be done.
struct WaitingHall {
  explicit WaitingHall(SmallHall& in, std::filesystem::path journal = {}) : hall(in) {
    FleetExecutiveOptions options = hall.options();
    options.operator_starts = true;
    options.journal = std::move(journal);
    executive.emplace(hall.planning(), hall.controller(), options, [this](const RunRecord& now) {
      if (phases.empty() || phases.back() != to_string(now.phase)) phases.emplace_back(to_string(now.phase));
      if (now.phase == Phase::Ready && on_ready) on_ready(now);
    });
  }

  SmallHall& hall;
  std::optional<FleetExecutive> executive;
  std::function<void(const RunRecord&)> on_ready;
  std::vector<std::string> phases;
};

const FleetChange kBox = OrderChange{"box", "dock B", "shelf 2", 1};

TEST(FleetStart, WhenAnOperatorStartsRuns_ThenThePlanIsShownAndNothingIsDownloadedBefore) {
  SmallHall hall;
  WaitingHall waiting(hall);
  EXPECT_EQ(code(waiting.executive->request_start()), "X0008") << "there is no plan yet";
  bool asked = false;
  waiting.on_ready = [&](const RunRecord& now) {
    asked = true;
    ASSERT_EQ(now.episodes.size(), 1u);
    EXPECT_FALSE(now.episodes[0].actions.empty());
    EXPECT_GT(now.episodes[0].planned_makespan_s, 0.0);
    EXPECT_NE(now.details.at("fleet").find("\"revision\":1"), std::string::npos) << "the page shows the ways";
    EXPECT_FALSE(hall.controller().program()) << "nothing was downloaded";
    EXPECT_EQ(code(waiting.executive->request(HoldChange{})), "X0008");
    EXPECT_EQ(code(waiting.executive->request_start()), "");
    EXPECT_EQ(code(waiting.executive->request_start()), "X0008") << "it is under way";
  };
  const RunRecord record = waiting.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_TRUE(asked);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(record.episodes.size(), 1u);
  EXPECT_EQ(record.replans.size(), 0u);
  EXPECT_EQ(waiting.phases, (std::vector<std::string>{"planning", "ready", "planning", "executing", "done"}));
  hall.expect_clean();
}

TEST(FleetStart, WhenSomethingIsOrderedWhileItWaits_ThenAnotherPlanIsShownAndStillNothingMoves) {
  SmallHall hall;
  WaitingHall waiting(hall);
  std::vector<std::size_t> stops;
  waiting.on_ready = [&](const RunRecord& now) {
    if (!stops.empty() && stops.back() == now.episodes.at(0).actions.size()) return;
    stops.push_back(now.episodes.at(0).actions.size());
    if (stops.size() == 1) {
      EXPECT_EQ(code(waiting.executive->request(kBox)), "");
    } else {
      waiting.executive->request_abort();
    }
  };
  const RunRecord record = waiting.executive->run();
  SCOPED_TRACE(story(record));
  ASSERT_EQ(stops.size(), 2u);
  EXPECT_EQ(stops[1], stops[0] + 2);  // fetched and brought
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_EQ(record.message, "aborted by the operator");
  EXPECT_EQ(hall.controller().stops(), 0);
  EXPECT_FALSE(hall.controller().program());
}

// So many crates cannot be brought by the deadline.
TEST(FleetStart, WhenThereIsNoPlanForWhatIsOrderedWhileItWaits_ThenThatIsRefusedAndThePlanBeforeWaits) {
  SmallHall hall;
  WaitingHall waiting(hall);
  std::size_t stops = 0;
  waiting.on_ready = [&](const RunRecord& now) {
    ASSERT_EQ(now.episodes.size(), 1u);
    if (stops == 0) {
      stops = now.episodes[0].actions.size();
      EXPECT_EQ(code(waiting.executive->request(OrderChange{"crate", "dock A", "shelf 1", 24})), "");
      return;
    }
    if (now.incidents.empty()) return;
    EXPECT_EQ(now.episodes[0].actions.size(), stops);
    EXPECT_FALSE(hall.controller().program()) << "nothing was downloaded";
    (void)waiting.executive->request_start();
  };
  const RunRecord record = waiting.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_NE(story(record).find("what was ordered is refused, there is no plan with it: "), std::string::npos);
  ASSERT_EQ(record.incidents.size(), 1u);
  EXPECT_EQ(record.incidents[0].response, run::Response::GoOn);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  hall.expect_clean();
}

struct Killed {};

// Nobody can refuse a place that is blocked: it is waited for, also by another supervisor.
TEST(FleetStart, WhenABlockedPlaceLeavesNoPlanWhileItWaits_ThenItWaitsUntilThePlaceIsFree) {
  SmallHall hall;
  const support::TemporaryFolder folder;
  const auto spill =
      geometry::footprint_at({18.0, 12.0, 0.0}, {.front_m = 0.5, .rear_m = 0.5, .half_width_m = 0.5});
  const auto planless = [](const RunRecord& now) { return now.episodes.empty(); };
  {
    WaitingHall waiting(hall, folder.path() / "executive.json");
    waiting.on_ready = [&](const RunRecord& now) {
      if (now.incidents.empty()) {
        EXPECT_EQ(code(waiting.executive->request(BlockChange{{"spill", spill}})), "");
      }
      if (planless(now)) throw Killed();
    };
    EXPECT_THROW(waiting.executive->run(), Killed);
  }
  WaitingHall waiting(hall, folder.path() / "executive.json");
  int waits = 0;
  waiting.on_ready = [&](const RunRecord& now) {
    if (!planless(now)) return (void)waiting.executive->request_start();
    if (++waits > 1) return;
    EXPECT_TRUE(now.message.starts_with("there is no plan, and nothing can be started: ")) << now.message;
    EXPECT_FALSE(now.details.contains("fleet"));
    EXPECT_EQ(code(waiting.executive->request_start()), "X0008");
    EXPECT_EQ(code(waiting.executive->request(HoldChange{})), "X0008");
    EXPECT_EQ(code(waiting.executive->request(UnblockChange{"spill"})), "");
  };
  const RunRecord record = waiting.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_EQ(waits, 1);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  hall.expect_clean();
}

TEST(FleetStart, WhenTheSupervisorIsRestartedWhileItWaits_ThenItStillWaitsWithWhatWasOrdered) {
  SmallHall hall;
  const support::TemporaryFolder folder;
  {
    WaitingHall waiting(hall, folder.path() / "executive.json");
    waiting.on_ready = [&, shown = 0](const RunRecord& now) mutable {
      if (++shown == 1) {
        EXPECT_EQ(code(waiting.executive->request(kBox)), "");
      }
      if (now.goal.size() == 3) throw Killed();
    };
    EXPECT_THROW(waiting.executive->run(), Killed);
  }
  WaitingHall waiting(hall, folder.path() / "executive.json");
  waiting.on_ready = [&](const RunRecord& now) {
    EXPECT_EQ(now.goal.size(), 3u);
    EXPECT_FALSE(hall.controller().program());
    (void)waiting.executive->request_start();
  };
  const RunRecord record = waiting.executive->run();
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  hall.expect_clean();
}

}  // namespace
}  // namespace stepwright::fleet
