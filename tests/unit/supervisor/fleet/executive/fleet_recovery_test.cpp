// What befalls a fleet in the middle of its work, from the fault to the last goal: vehicles that die and come
// back, a navigation that walks away, the emergency stop.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "supervisor/fleet/executive/standing.h"
#include "tests/unit/supervisor/fleet/executive/small_hall.h"

namespace stepwright::fleet {
namespace {

using run::IncidentKind;
using run::Phase;
using run::Response;
using run::RunRecord;

std::string state_of(const RunRecord& record, std::size_t vehicle) {
  return nlohmann::json::parse(record.details.at("fleet"))["vehicles"][vehicle]["state"];
}

bool told(const RunRecord& record, const std::string& words) {
  return story(record).find(words) != std::string::npos;
}

TEST(FleetReturn, WhenADeadVehicleComesBack_ThenItTakesPartAgainAndAllIsDelivered) {
  SmallHall hall({{12.0, "dead_v2", 1.0}, {20.0, "dead_v2", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{25.0, ReturnChange{"truck 2"}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  ASSERT_EQ(record.replans.size(), 2u);
  EXPECT_EQ(state_of(record, 1), "resting");
  // It has driven back to where it parks.
  EXPECT_NEAR(hall.truth("true_x_v2"), 32.0, 0.3);
  EXPECT_NEAR(hall.truth("true_y_v2"), 4.0, 0.3);
  hall.expect_clean();
}

TEST(FleetReturn, WhenItHasALoadAboard_ThenItDeliversThatItself) {
  SmallHall hall({{30.0, "dead_v2", 1.0}, {40.0, "dead_v2", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{45.0, ReturnChange{"truck 2"}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_TRUE(told(record, "truck 2: set_down 1 crate"));
  EXPECT_GT(finished_s(record, "truck 2: set_down 1 crate"), 45.0);
  hall.expect_clean();
}

TEST(FleetReturn, WhenItIsStillDead_ThenItIsLostAgainAndOthersKeepClearOfWhereItTrulyStands) {
  SmallHall hall({{5.0, "dead_v2", 1.0}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{25.0, ReturnChange{"truck 2"}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_TRUE(told(record, "truck 2 cannot come back"));
  EXPECT_EQ(state_of(record, 1), "lost");
  hall.expect_clean();
}

TEST(FleetNavigation, WhenItWalksAwaySlowly_ThenTheVehicleStopsAndOthersDoItsWork) {
  SmallHall hall({{20.0, "drift_v3", 20.0}});
  const RunRecord record = hall.run(hall.options());
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  ASSERT_FALSE(record.incidents.empty());
  const auto& incident = record.incidents.front();
  EXPECT_EQ(incident.kind, IncidentKind::FailedSensor);
  EXPECT_EQ(incident.action, "truck 3");
  EXPECT_TRUE(told(record, "error 30"));
  EXPECT_LT(incident.time_s, 24.0);
  hall.expect_clean();
}

TEST(FleetEmergencyStop, WhenItIsReleasedAndTheFleetResumed_ThenAllGoOnFromWhereTheyStand) {
  SmallHall hall({{12.0, "press_estop", 1.0}, {20.0, "press_estop", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{16.0, ResumeChange{}}, {25.0, ResumeChange{}}};
  std::vector<std::string> phases;
  const RunRecord record = hall.run(options, [&](const RunRecord& now) {
    if (phases.empty() || phases.back() != to_string(now.phase)) phases.emplace_back(to_string(now.phase));
  });
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(phases, (std::vector<std::string>{"planning", "executing", "waiting", "replanning", "executing",
                                              "done"}));
  EXPECT_TRUE(told(record, "the emergency stop is still pressed"));
  EXPECT_EQ(record.incidents.front().response, Response::Replan);
  ASSERT_EQ(record.replans.size(), 1u);
  EXPECT_GE(record.replans[0].time_s, 25.0);
  for (std::size_t v = 0; v < 3; ++v) EXPECT_EQ(state_of(record, v), "resting");
  hall.expect_clean();
}

TEST(FleetEmergencyStop, WhenItIsPressedWhileTheFleetComesToRest_ThenItIsHeldAndGoesOnAllTheSame) {
  SmallHall hall({{20.3, "press_estop", 1.0}, {22.0, "press_estop", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{20.0, OrderChange{"box", "dock B", "shelf 2", 1}}, {24.0, ResumeChange{}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_EQ(record.goal.size(), 3u);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(record.episodes.size(), 2u);
  hall.expect_clean();
}

TEST(FleetEmergencyStop, WhenNobodyLetsTheFleetGoOn_ThenTheRunEndsSafely) {
  SmallHall hall({{12.0, "press_estop", 1.0}, {14.0, "press_estop", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.hold = std::chrono::seconds(10);
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_TRUE(told(record, "nobody has let the fleet go on"));
  EXPECT_FALSE(hall.controller().any_output());
  hall.expect_clean();
}

// Nothing can be planned, and nobody is in danger: people mend it, and the run goes on.
TEST(FleetStay, WhenNoVehicleIsLeft_ThenTheRunWaitsForPeopleAndGoesOn) {
  SmallHall hall({{3.0, "dead_v1", 1.0},
                  {3.0, "dead_v2", 1.0},
                  {3.0, "dead_v3", 1.0},
                  {40.0, "dead_v1", 0.0, true},
                  {40.0, "dead_v2", 0.0, true},
                  {40.0, "dead_v3", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{45.0, ReturnChange{"truck 1"}},
                      {45.0, ReturnChange{"truck 2"}},
                      {45.0, ReturnChange{"truck 3"}},
                      {50.0, ResumeChange{}}};
  hall.tell_time();
  bool waited = false;
  const RunRecord record = hall.run(options, [&](const RunRecord& now) {
    waited = waited || (now.phase == Phase::Held && now.message.starts_with("no vehicle is left"));
  });
  SCOPED_TRACE(story(record));
  EXPECT_TRUE(waited);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  hall.expect_clean();
}

TEST(FleetStay, WhenNobodyComes_ThenTheRunEndsWithTheReasonOfTheWait) {
  SmallHall hall({{12.0, "dead_v1", 1.0}, {12.0, "dead_v2", 1.0}, {12.0, "dead_v3", 1.0}});
  FleetExecutiveOptions options = hall.options();
  options.hold = std::chrono::seconds(10);
  hall.tell_time();
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_EQ(record.message, "no vehicle is left that can drive; nobody has let the fleet go on");
  EXPECT_FALSE(hall.controller().any_output());
  hall.expect_clean();
}

// A load is aboard of a dead truck, and everything else is done.
TEST(FleetStay, WhenSomethingIsMissingAtTheEnd_ThenTheRunWaitsForPeopleAndGoesOn) {
  SmallHall hall({{12.0, "dead_v2", 1.0}, {150.0, "dead_v2", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{160.0, ReturnChange{"truck 2"}}, {165.0, ResumeChange{}}};
  options.attended = false;  // who comes at a given time is waited for all the same
  hall.tell_time();
  bool waited = false;
  const RunRecord record = hall.run(options, [&](const RunRecord& now) {
    waited =
        waited || (now.phase == Phase::Held && now.message.starts_with("all that could be done is done"));
  });
  SCOPED_TRACE(story(record));
  EXPECT_TRUE(waited);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  hall.expect_clean();
}

TEST(FleetStay, WhenNobodyIsThere_ThenARunInWhichSomethingIsMissingEndsAtOnce) {
  SmallHall hall({{12.0, "dead_v2", 1.0}});
  FleetExecutiveOptions options = hall.options();
  options.attended = false;
  bool waited = false;
  const RunRecord record =
      hall.run(options, [&](const RunRecord& now) { waited = waited || now.phase == Phase::Held; });
  SCOPED_TRACE(story(record));
  EXPECT_FALSE(waited);
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_TRUE(record.message.starts_with("all that could be done is done: 1 of 1 of ")) << record.message;
  EXPECT_FALSE(hall.controller().any_output());
  hall.expect_clean();
}

TEST(FleetHold, WhenAnOperatorHoldsTheFleet_ThenAllRestUntilItIsResumedAndAllIsDelivered) {
  SmallHall hall;
  FleetExecutiveOptions options = hall.options();
  options.max_replans = 0;  // a hold is no fault of the plan
  options.requests = {{12.0, HoldChange{}}, {40.0, HoldChange{}}, {45.0, ResumeChange{}}};
  std::vector<std::string> phases;
  bool held = false;
  std::vector<double> stood_at;
  hall.controller().on_scan = [&, scans = 0](std::span<const std::byte>) mutable {
    if (!held) return;
    const double x = hall.truth("true_x_v1") + hall.truth("true_x_v2") + hall.truth("true_x_v3");
    stood_at.push_back(x);
    if (++scans % 50 == 0) hall.controller().interrupt();  // nobody who rests causes an event
  };
  const RunRecord record = hall.run(options, [&](const RunRecord& now) {
    if (phases.empty() || phases.back() != to_string(now.phase)) phases.emplace_back(to_string(now.phase));
    held = now.phase == Phase::Held;
  });
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(phases, (std::vector<std::string>{"planning", "executing", "holding", "held", "replanning",
                                              "executing", "done"}));
  ASSERT_GT(stood_at.size(), 500u);
  EXPECT_NEAR(stood_at.front(), stood_at.back(), 0.05);
  EXPECT_TRUE(told(record, "the fleet is held already"));
  ASSERT_EQ(record.replans.size(), 1u);
  EXPECT_TRUE(record.replans[0].held);
  EXPECT_GE(record.episodes.back().started_s, 45.0);
  hall.expect_clean();
}

TEST(FleetHold, WhenTheEmergencyStopIsPressedOnTheWayToRest_ThenOneResumeLetsTheFleetGoOn) {
  SmallHall hall({{12.3, "press_estop", 1.0}, {14.0, "press_estop", 0.0, true}});
  FleetExecutiveOptions options = hall.options();
  options.requests = {{12.0, HoldChange{}}, {20.0, ResumeChange{}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_TRUE(told(record, "the emergency stop is pressed"));
  hall.expect_clean();
}

TEST(FleetHold, WhenTheRuntimeIsNotHeardOfForAWhile_ThenItIsWaitedForAndTheFleetRestsAndGoesOn) {
  SmallHall hall;
  FleetExecutiveOptions options = hall.options();
  options.requests = {{12.0, HoldChange{}}, {45.0, ResumeChange{}}};
  Phase phase = Phase::Planning;
  int silences = 0;
  hall.controller().on_scan = [&, scans = 0](std::span<const std::byte>) mutable {
    const bool once = (phase == Phase::Holding && silences == 0) || (phase == Phase::Held && silences == 1);
    if (++scans % 50 != 0) return;
    hall.controller().interrupt();
    if (!once) return;
    hall.controller().silence_runtime();
    ++silences;
  };
  const RunRecord record = hall.run(options, [&](const RunRecord& now) { phase = now.phase; });
  SCOPED_TRACE(story(record));
  EXPECT_EQ(silences, 2);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_TRUE(told(record, "the runtime was not seen for a while; it has gone on"));
  hall.expect_clean();
}

// The drum arrives at least a minute behind the crate.
constexpr const char* kCrateFirst = R"([{"name": "crate first", "from": {"goal": "crate", "at": "end"},
  "to": {"goal": "drum", "at": "end"}, "distance_ms": [60000, null]}])";

TEST(FleetConstraints, WhenTheFirstOnesVehicleDies_ThenTheOrderHoldsInTheNextPlan) {
  SmallHall hall({{5.0, "dead_v2", 1.0}}, kCrateFirst);
  const RunRecord record = hall.run(hall.options());
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(record.replans.size(), 1u);
  const double crate_s = finished_s(record, "set_down 1 crate");
  EXPECT_GT(crate_s, 5.0);
  EXPECT_GE(finished_s(record, "set_down 1 drum"), crate_s + 60.0);
  hall.expect_clean();
}

TEST(FleetConstraints, WhenTheFirstOneIsAboardOfALostVehicle_ThenItIsToldThatTheOrderDoesNotBind) {
  SmallHall hall({{30.0, "dead_v2", 1.0}}, kCrateFirst);
  const RunRecord record = hall.run(hall.options());
  SCOPED_TRACE(story(record));
  EXPECT_TRUE(told(record, "'crate first' does not bind: what it counts from will not happen"));
  EXPECT_GT(finished_s(record, "set_down 1 drum"), 30.0);
  const auto document = nlohmann::json::parse(record.details.at("fleet"));
  for (const auto& goal : document["goals"]) {
    if (goal["name"] != "crate") continue;
    EXPECT_EQ(goal["reason"], "1 aboard of truck 2, which is lost");
  }
  hall.expect_clean();
}

TEST(FleetConstraints, WhenAPlaceIsBlockedBetweenTheTwo_ThenTheSecondStillWaitsForWhatWasDoneBefore) {
  SmallHall hall({}, kCrateFirst);
  FleetExecutiveOptions options = hall.options();
  // Once the crate stands where it belongs, in the way of the drum.
  const RunRecord calm = hall.run(options);
  const double crate_s = finished_s(calm, "set_down 1 crate");
  SmallHall again({}, kCrateFirst);
  const auto spill =
      geometry::footprint_at({4.0, 16.5, 0.0}, {.front_m = 0.3, .rear_m = 0.3, .half_width_m = 0.3});
  options.requests = {{crate_s + 2.0, BlockChange{{"spill", spill}}}};
  const RunRecord record = again.run(options);
  SCOPED_TRACE(story(calm) + "\n" + story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  EXPECT_EQ(record.replans.size(), 1u);
  EXPECT_DOUBLE_EQ(finished_s(record, "set_down 1 crate"), crate_s);
  EXPECT_GE(finished_s(record, "set_down 1 drum"), crate_s + 60.0);
  again.expect_clean();
}

TEST(FleetConstraints, WhenAnUpperBoundCannotBeKeptInTheNextPlan_ThenItIsToldAndAllIsDelivered) {
  SmallHall hall({{25.0, "dead_v3", 1.0}},
                 R"([{"name": "fresh", "to": {"goal": "drum", "at": "end"}, "distance_ms": [0, 85000]}])");
  const RunRecord record = hall.run(hall.options());
  SCOPED_TRACE(story(record));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  ASSERT_EQ(record.replans.size(), 1u);
  const std::string& evidence = record.incidents.front().evidence.back();
  EXPECT_TRUE(evidence.starts_with("not to be kept any more:")) << evidence;
  EXPECT_NE(evidence.find("fresh"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(record.details.at("fleet"))["goals"][1]["late"]);
  EXPECT_GT(finished_s(record, "set_down 1 drum"), 85.0);
  hall.expect_clean();
}

// It was planned for again and again, with the load that nobody can bring there.
TEST(FleetRecovery, WhenWhereALoadAboardIsWantedIsBlocked_ThenItStaysAboardAndTheRestIsDone) {
  const auto spill =
      geometry::footprint_at({18.0, 12.0, 0.0}, {.front_m = 0.5, .rear_m = 0.5, .half_width_m = 0.5});
  for (const bool cleared : {false, true}) {
    SmallHall hall;
    FleetExecutiveOptions options = hall.options();
    options.requests = {{30.0, BlockChange{{"spill", spill}}}};
    if (cleared) options.requests.push_back({45.0, UnblockChange{"spill"}});
    const RunRecord record = hall.run(options);
    SCOPED_TRACE(story(record));
    EXPECT_TRUE(told(record, "'crate' stays aboard of truck 2: it finds no way there"));
    EXPECT_GT(finished_s(record, "set_down 1 drum"), 30.0);
    EXPECT_EQ(record.phase, cleared ? Phase::Done : Phase::Safe);
    EXPECT_EQ(all_met(record), cleared);
    if (!cleared) {
      EXPECT_NE(record.message.find("(1 aboard of truck 2): truck 2 finds no way there"), std::string::npos);
    }
    hall.expect_clean();
  }
}

// Nothing was given up for it, and yet it waits for the place.
TEST(FleetRecovery, WhenThePlaceUnderAVehicleIsBlockedForAWhile_ThenItGoesOnOnceThatIsFree) {
  SmallHall calm;
  geometry::Pose there;
  calm.controller().on_scan = [&, scans = 0](std::span<const std::byte>) mutable {
    if (++scans == 1'500)
      there = {calm.truth("true_x_v2"), calm.truth("true_y_v2"), calm.truth("true_heading_v2")};
  };
  ASSERT_EQ(calm.run(calm.options()).phase, Phase::Done);
  SmallHall hall;
  FleetExecutiveOptions options = hall.options();
  const auto spill = geometry::footprint_at(there, {.front_m = 3.0, .rear_m = 3.0, .half_width_m = 1.0});
  options.requests = {{30.0, BlockChange{{"spill", spill}}}, {60.0, UnblockChange{"spill"}}};
  const RunRecord record = hall.run(options);
  SCOPED_TRACE(story(record));
  EXPECT_TRUE(told(record, "truck 2 cannot leave where it stands"));
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_TRUE(all_met(record));
  hall.expect_clean();
}

// Its last command would go on for ever: the block that gave it is in no program any more.
TEST(FleetRecovery, WhenAVehicleDrivesAndTheNextProgramHasNoWayForIt_ThenItStands) {
  SmallHall hall;
  auto& controller = hall.controller();
  const auto outcome = hall.planning().plan(FleetLedger(hall.planning().problem()),
                                            {.rest = {.starts = hall.planning().first_starts()}});
  ASSERT_TRUE(outcome && outcome->prepared.program);
  ASSERT_TRUE(controller.download(outcome->prepared.container));
  ASSERT_TRUE(controller.start(false));
  const auto place = [&](std::size_t v) {
    const std::string of = "_v" + std::to_string(v + 1);
    return geometry::Pose{hall.truth("true_x" + of), hall.truth("true_y" + of),
                          hall.truth("true_heading" + of)};
  };
  const auto run = [&](int scans) {
    int left = scans;
    controller.on_scan = [&](std::span<const std::byte>) {
      if (--left == 0) controller.interrupt();
    };
    while (left > 0) {
      if (const auto event = controller.wait_event({})) (void)controller.acknowledge(event->sequence);
    }
  };
  std::vector<geometry::Pose> before;
  const std::size_t vehicles = hall.planning().problem().vehicles.size();
  run(250);
  for (std::size_t v = 0; v < vehicles; ++v) before.push_back(place(v));
  run(10);
  double fastest_m = 0.0;
  FleetPlan standing;
  standing.schedule.verdict = Verdict::Scheduled;
  for (std::uint32_t v = 0; v < vehicles; ++v) {
    fastest_m = std::max(fastest_m, geometry::distance(place(v).position(), before[v].position()));
    const VehicleModel model = hall.planning().model(v);
    insert_standing(standing, v, hall.planning().problem().vehicles[v].name, model, place(v),
                    place_around(place(v), model.footprint(), 2.5, 0.3));
  }
  ASSERT_GT(fastest_m, 0.1) << "somebody drives";
  const auto prepared = hall.planning().program_of(standing, 2);
  ASSERT_TRUE(prepared) << result::to_string(prepared.error());
  ASSERT_TRUE(controller.change(prepared->container));
  run(200);
  for (std::size_t v = 0; v < vehicles; ++v) before[v] = place(v);
  run(200);
  for (std::size_t v = 0; v < vehicles; ++v)
    EXPECT_LT(geometry::distance(place(v).position(), before[v].position()), 0.01) << "v" << v + 1;
  hall.expect_clean();
}

}  // namespace
}  // namespace stepwright::fleet
