#include "supervisor/run/run_record.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "supervisor/executive/journal.h"
#include "supervisor/run/report.h"

namespace stepwright::executive {
namespace {

run::RunRecord sample() {
  run::ActionRecord done;
  done.text = "(load v1 f1 level8)";
  done.step = "S01_LOAD";
  done.state = run::ActionState::Done;
  done.planned_finish_s = 9.5;
  done.started_s = 1.0;
  done.finished_s = 10.25;
  done.planned_cost = 1.0;
  done.actual_cost = 1.5;
  done.expected = {{"(lev v1)", 10.0}};
  done.observed = {{"(lev v1)", 9.9}};
  run::ActionRecord pending;
  pending.text = "(move v1 f1 a1) <&>";
  run::Episode episode;
  episode.digest = "abc";
  episode.cost = 108.0;
  episode.origin = "repaired";
  episode.kept = 1;
  episode.remaining = 2;
  episode.repair_ms = 0.5;
  episode.actions = {done, pending};
  run::RunRecord record;
  record.cell = "bench";
  record.phase = run::Phase::Executing;
  record.episodes = {episode};
  record.replans = {{3.0, "a level is wrong", "(load v1 f1 level8)"},
                    {5.0, "held by the operator", "", true}};
  run::Incident incident;
  incident.time_s = 3.0;
  incident.kind = run::IncidentKind::FailedActuator;
  incident.evidence = {"(load v1 f1 level8) had no effect in 4.3 s: B1 was on"};
  incident.action = "(load v1 f1 level8)";
  incident.alarms = {{"(load v1 f1 level8)", "invariant", "level of a2 within 0.2 of 2", 812, 1.7, "S3"}};
  incident.response = run::Response::Repair;
  incident.decision_ms = 12.5;
  incident.repair_ms = 3.5;
  incident.replan_ms = 8.25;
  incident.kept = 4;
  incident.remaining = 6;
  incident.restarts = 1;
  incident.devices = {"supply pump"};
  record.incidents = {incident};
  record.goal = {{"(= (level a1) 5)", false}};
  record.tare = {{"S3", 41.5}};
  return record;
}

TEST(RunRecord, WhenWrittenAndRead_ThenItIsTheSame) {
  const run::RunRecord record = sample();
  const auto read = run::record_from_json(to_json(record), "test");
  ASSERT_TRUE(read.has_value()) << result::to_string(read.error());
  EXPECT_EQ(*read, record);
}

TEST(RunRecord, WhenTheTextIsDamaged_ThenItIsRefused) {
  const std::string text = to_json(sample());
  EXPECT_FALSE(run::record_from_json(text.substr(0, text.size() / 2), "test").has_value());
  EXPECT_FALSE(run::record_from_json("{\"cell\": 3}", "test").has_value());
  std::string odd = text;
  odd.replace(odd.find("executing"), 9, "exploding");
  EXPECT_FALSE(run::record_from_json(odd, "test").has_value());
}

TEST(Journal, WhenWrittenAndRead_ThenItIsTheSame) {
  const std::filesystem::path file = testing::TempDir() + "journal.json";
  Journal journal;
  journal.record = sample();
  journal.start.planning.facts = {"(is-at v1 f1)"};
  journal.start.planning.fluents = {{"(lev v1)", 2.0}};
  journal.start.tare = {{"S1", 12.5}};
  journal.plan.actions = {{"load", {"v1", "f1", "level8"}}, {"move", {"v1", "f1", "a1"}}};
  journal.plan.orderings = std::vector<model::Ordering>{{0, 1}};
  journal.changed = {{"(demand c1)", 8.0}};
  journal.clock = {42.5, 12.5, 0xFFFF'FFFF'FFFF'FFF1u};
  ASSERT_TRUE(write_journal(file, journal).has_value());
  const auto read = read_journal(file);
  ASSERT_TRUE(read.has_value() && read->has_value());
  EXPECT_EQ((*read)->record, journal.record);
  EXPECT_EQ((*read)->start.planning, journal.start.planning);
  EXPECT_EQ((*read)->plan.actions, journal.plan.actions);
  EXPECT_EQ((*read)->plan.orderings, journal.plan.orderings);
  EXPECT_EQ((*read)->changed, journal.changed);
  EXPECT_EQ((*read)->clock.now_s, journal.clock.now_s);
  EXPECT_EQ((*read)->clock.offset_s, journal.clock.offset_s);
  EXPECT_EQ((*read)->clock.incarnation, journal.clock.incarnation);
}

// A search that its budget ended knows no bound; JSON has no infinity.
TEST(RunRecord, WhenNoBoundIsKnown_ThenItIsReadBackAndTheReportSaysSo) {
  run::RunRecord record = sample();
  record.episodes[0].bound.reset();
  const auto read = run::record_from_json(to_json(record), "test");
  ASSERT_TRUE(read.has_value()) << result::to_string(read.error());
  EXPECT_EQ(*read, record);
  EXPECT_NE(run::report_table(record).find("no bound known"), std::string::npos);
}

TEST(RunRecord, WhenAMessageIsNoUtf8_ThenItIsWrittenAllTheSame) {
  run::RunRecord record = sample();
  record.message = "stopped from outside: \xFF";
  const auto read = run::record_from_json(to_json(record), "test");
  ASSERT_TRUE(read.has_value()) << result::to_string(read.error());
  EXPECT_EQ(read->message, "stopped from outside: \xEF\xBF\xBD");
}

TEST(Journal, WhenItsRecordIsOfAnotherPlan_ThenItIsRefused) {
  const std::filesystem::path file = testing::TempDir() + "other_plan.json";
  Journal journal;
  journal.record = sample();  // two actions
  journal.plan.actions = {{"load", {"v1", "f1", "level8"}}};
  ASSERT_TRUE(write_journal(file, journal).has_value());
  const auto read = read_journal(file);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error()[0].code, "X0001");
  EXPECT_EQ(read.error()[0].where.file, file.string());
}

TEST(Journal, WhenAnEarlierVersionHasWrittenIt_ThenItIsReadAsWell) {
  const std::filesystem::path file = testing::TempDir() + "earlier_version.json";
  Journal journal;
  journal.next_request = 3;
  ASSERT_TRUE(write_journal(file, journal).has_value());
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string earlier = text.str();
  earlier.replace(earlier.find("next_request"), 12, "next_change");
  std::ofstream(file) << earlier;
  const auto read = read_journal(file);
  ASSERT_TRUE(read.has_value() && read->has_value()) << result::to_string(read.error());
  EXPECT_EQ((*read)->next_request, 3u);
}

TEST(Journal, WhenItIsOfAnotherVersion_ThenItIsRefused) {
  const std::filesystem::path file = testing::TempDir() + "other_version.json";
  std::ofstream(file) << R"({"version": 2})";
  const auto read = read_journal(file);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error()[0].code, "X0001");
}

TEST(Journal, WhenThereIsNone_ThenNothingIsRead) {
  const auto read = read_journal(testing::TempDir() + "no-such-journal.json");
  ASSERT_TRUE(read.has_value());
  EXPECT_FALSE(read->has_value());
}

TEST(Journal, WhenItIsDamaged_ThenTheErrorNamesTheFile) {
  const std::filesystem::path file = testing::TempDir() + "damaged.json";
  std::ofstream(file) << "{\"version\": 3, \"record\": ";
  const auto read = read_journal(file);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error()[0].where.file, file.string());
}

TEST(Report, WhenDrawn_ThenEveryActionIsThereAndTextIsEscaped) {
  const std::string gantt = run::gantt_svg(sample());
  EXPECT_NE(gantt.find("(load v1 f1 level8)"), std::string::npos);
  EXPECT_NE(gantt.find("&lt;&amp;&gt;"), std::string::npos);
  EXPECT_EQ(gantt.find("<&>"), std::string::npos);
  EXPECT_NE(run::cost_svg(sample()).find("polyline"), std::string::npos);
  EXPECT_NE(run::report_table(sample()).find("NOT MET"), std::string::npos);
}

TEST(Report, WhenThereAreIncidents_ThenTableAndPictureTellEvidenceDecisionAndTime) {
  const std::string table = run::report_table(sample());
  EXPECT_NE(table.find("Incident at 3.00 s, failed_actuator: (load v1 f1 level8) had no effect"),
            std::string::npos)
      << table;
  EXPECT_NE(
      table.find(
          "alarm: invariant of (load v1 f1 level8) lost in scan 812: level of a2 within 0.2 of 2 (1.7)"),
      std::string::npos)
      << table;
  EXPECT_NE(table.find("decision: repair in 12.5 ms, 4 of 6 actions kept (repair 3.5 ms, new plan 8.2 ms)"),
            std::string::npos)
      << table;
  EXPECT_NE(run::gantt_svg(sample()).find("failed_actuator: "), std::string::npos);
}

TEST(RunRecord, WhenAnIncidentHasAnUnknownKind_ThenItIsRefused) {
  std::string text = to_json(sample());
  text.replace(text.find("failed_actuator"), 15, "bored_actuator!");
  EXPECT_FALSE(run::record_from_json(text, "test").has_value());
}

// The plan of the first episode came from a replan already, and the last replan found none.
TEST(Report, WhenReplansAndPlansDoNotPair_ThenEveryCauseStandsBeforeThePlanThatItLedTo) {
  run::RunRecord record = sample();
  record.episodes[0].started_s = 5.0;
  record.replans = {{3.0, "FIRST", ""}, {8.0, "LAST", ""}};
  const std::string table = run::report_table(record);
  const std::size_t plan = table.find("Plan 1 of 1");
  ASSERT_NE(plan, std::string::npos);
  EXPECT_LT(table.find("FIRST"), plan);
  EXPECT_GT(table.find("LAST"), plan);
  EXPECT_NE(table.find("LAST"), std::string::npos);
}

TEST(Report, WhenTheLastActionFails_ThenItsBarEndsAtTheReplan) {
  run::RunRecord record = sample();
  run::ActionRecord& failed = record.episodes[0].actions[1];
  failed.state = run::ActionState::Failed;
  failed.started_s = 11.0;
  record.finished_s = 10.25;
  record.started_s = 1.0;
  record.replans = {{101.0, "it never ended", ""}};
  // 90 of the 100 s of the picture, whose plot is 710 wide.
  EXPECT_NE(run::gantt_svg(record).find("<rect class=\"f\" x=\"301.0\" y=\"78\" width=\"639.0\""),
            std::string::npos)
      << run::gantt_svg(record);
}

TEST(Report, WhenWrittenAndRead_ThenTheFiguresAreTheSame) {
  run::Report report{sample(), {}};
  report.runtime.scan = 1234;
  report.runtime.trace_hash = 0xFFFF'FFFF'FFFF'FFFFull;
  report.runtime.plant = {{"level_a1_percent", 50.25}};
  const auto read = run::report_from_json(to_json(report), "test");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->record, report.record);
  EXPECT_EQ(read->runtime.trace_hash, report.runtime.trace_hash);
  EXPECT_EQ(read->runtime.plant, report.runtime.plant);
}

}  // namespace
}  // namespace stepwright::executive
