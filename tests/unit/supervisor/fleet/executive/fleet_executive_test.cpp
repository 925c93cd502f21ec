// The fleet's executive with its real planner, compiler, scan and plant, in one thread. The judges are the
// plant's: exact outlines along the motion, contacts, where vehicles stand in the end.

#include "supervisor/fleet/executive/fleet_executive.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/supervisor/fleet/executive/small_hall.h"

namespace stepwright::fleet {
namespace {

using run::IncidentKind;
using run::Phase;
using run::Response;
using run::RunRecord;

TEST(FleetExecutiveRun, WhenSomethingIsOrderedMeanwhile_ThenAllIsDeliveredAndNobodyMeets) {
  SmallHall hall;
  FleetExecutiveOptions options = hall.options();
  options.requests = {{20.0, OrderChange{"box", "dock B", "shelf 2", 1}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  ASSERT_EQ(record.goal.size(), 3u);
  EXPECT_TRUE(all_met(record));
  ASSERT_EQ(record.replans.size(), 1u);
  EXPECT_EQ(record.episodes.size(), 2u);
  const auto& incident = record.incidents.front();
  EXPECT_EQ(incident.kind, IncidentKind::NewGoal);
  EXPECT_EQ(incident.response, Response::Replan);
  EXPECT_GT(incident.replan_ms, 0.0);
  EXPECT_GE(hall.controller().changes(), 2);  // to rest, and to the new plan
  EXPECT_EQ(hall.controller().stops(), 1);    // at the end
  hall.expect_clean();
  EXPECT_NE(record.details.at("fleet").find("\"revision\":2"), std::string::npos);
}

TEST(FleetExecutiveRun, WhenNobodyCanDoWhatIsLeft_ThenTheOutputsAreSafeAndItIsSaidWhatIsMissing) {
  SmallHall hall({{5.0, "dead_v1", 1.0}, {5.0, "dead_v2", 1.0}, {5.0, "dead_v3", 1.0}});
  hall.tell_time();
  const RunRecord record = hall.run(hall.options());
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_EQ(record.exit, result::ExitCode::RuntimeFault);
  EXPECT_FALSE(all_met(record));
  EXPECT_EQ(record.incidents.back().response, Response::SafeStop);
  EXPECT_FALSE(hall.controller().any_output());
}

TEST(FleetExecutiveRun, WhenAChangeIsRefused_ThenTheFleetIsStoppedAndTheNextProgramDownloaded) {
  SmallHall hall;
  hall.controller().refuse_changes();
  FleetExecutiveOptions options = hall.options();
  options.requests = {{5.0, OrderChange{"box", "dock B", "shelf 2", 1}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(hall.controller().changes(), 0);
  hall.expect_clean();
}

struct Killed {};

TEST(FleetExecutiveRun, WhenTheSupervisorIsKilled_ThenTheNextOneGoesOnWithTheSamePlan) {
  SmallHall hall;
  int seen = 0;
  const auto kill = [&](const RunRecord& record) {
    // After the first plan runs, at the first news of it.
    if (record.phase == Phase::Executing && ++seen == 2) throw Killed();
  };
  FleetExecutiveOptions options = hall.options();
  options.between_documents = {};
  EXPECT_THROW(hall.run(options, kill), Killed);
  // The service repeats an event for whoever comes anew; here nobody does.
  ASSERT_TRUE(hall.controller().acknowledge(1'000'000));
  const RunRecord record = hall.run(hall.options());
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(record.episodes.size(), 1u);
  EXPECT_EQ(record.incidents.front().kind, IncidentKind::LostSupervisor);
  EXPECT_EQ(hall.controller().stops(), 1);
  hall.expect_clean();
}

TEST(FleetExecutiveRequests, WhenTheyCannotBeMeant_ThenTheyAreRefusedAtOnce) {
  SmallHall hall;
  FleetExecutive executive(hall.planning(), hall.controller(), hall.options(), {});
  for (const FleetChange& change :
       {FleetChange(OrderChange{"box", "dock B", "nowhere", 1}), FleetChange(ReturnChange{"truck 9"})}) {
    const auto refused = executive.request(change);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().front().code, "X0003");
  }
  EXPECT_TRUE(executive.request(OrderChange{"box", "dock B", "shelf 2", 1}));
}

TEST(FleetPlanningOpen, WhenTheProblemIsMissingOrHasOtherVehicles_ThenThatIsSaid) {
  SmallHall hall;
  FleetPlanningOptions options = hall.planning().options();
  options.terminals = terminals_in_a_row(2);
  const auto fewer = FleetPlanning::open(options);
  ASSERT_FALSE(fewer);
  EXPECT_EQ(fewer.error().front().code, "F1105");
  options.problem = "nowhere.json";
  const auto missing = FleetPlanning::open(options);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().front().where.file, "nowhere.json");
}

}  // namespace
}  // namespace stepwright::fleet
