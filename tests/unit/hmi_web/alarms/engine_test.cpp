#include "hmi_web/alarms/engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace stepwright::alarms {
namespace {

using std::chrono::nanoseconds;

AlarmDefinition on(std::string name, std::string source, std::string group = "") {
  AlarmDefinition made;
  made.name = std::move(name);
  made.source = std::move(source);
  made.group = std::move(group);
  return made;
}

SourceId source(const AlarmEngine& engine, std::string_view name) {
  const auto& names = engine.sources();
  return SourceId(static_cast<std::uint32_t>(std::find(names.begin(), names.end(), name) - names.begin()));
}

// "7 b unacknowledged*": time, alarm, state, a star for the first.
std::string told(AlarmEngine& engine) {
  std::string text;
  for (const Transition& t : engine.take())
    text += std::to_string(t.time_ns) + " " + engine.definitions()[t.alarm.value].name + " " +
            to_string(t.to) + (t.first_out ? "*; " : "; ");
  return text;
}

AlarmState state(const AlarmEngine& engine, std::string_view name) {
  return engine.view(*engine.find(name)).status.state();
}

TEST(AlarmEngine, WhenAValueChanges_ThenItsAlarmsChangeWithTheTimeOfTheScan) {
  AlarmDefinition high = on("high", "level"), low = on("low", "level");
  high.condition = {ConditionKind::High, 9.0, 0.5};
  low.condition = {ConditionKind::Low, 1.0, 0.5};
  auto engine = AlarmEngine::create({high, low}).value();
  ASSERT_EQ(engine.sources(), (std::vector<std::string>{"level"}));
  for (const auto& [time, level] :
       std::vector<std::pair<std::int64_t, double>>{{10, 5}, {20, 9.5}, {30, 9}, {40, 8}, {50, 0}})
    engine.offer(SourceId(0), time, level, true);
  const auto transitions = engine.take();
  ASSERT_EQ(transitions.size(), 3u);
  EXPECT_EQ(transitions[0].value, 9.5);
  EXPECT_EQ(transitions[0].time_ns, 20);
  EXPECT_EQ(transitions[1].to, AlarmState::ReturnedUnacknowledged);
  EXPECT_EQ(transitions[2].alarm, *engine.find("low"));
  EXPECT_EQ(transitions[2].sequence, 3u);
  EXPECT_TRUE(engine.take().empty());
}

TEST(AlarmEngine, WhenDelaysAndShelvesEnd_ThenAdvanceTellsThemInTheOrderOfTheirEnds) {
  AlarmDefinition slow = on("slow", "s"), shelved = on("shelved", "t");
  slow.condition.on_delay = nanoseconds(50);
  auto engine = AlarmEngine::create({slow, shelved}).value();
  ASSERT_TRUE(
      engine.command({AlarmId(1), AlarmEvent::Shelve, 0, "anna", "works", nanoseconds(30)}).has_value());
  engine.offer(source(engine, "s"), 10, 1, true);
  engine.offer(source(engine, "t"), 12, 1, true);
  EXPECT_EQ(told(engine), "0 shelved shelved; 12 shelved shelved; ");
  engine.advance(1000);
  EXPECT_EQ(told(engine), "30 shelved unacknowledged; 60 slow unacknowledged; ");
}

TEST(AlarmEngine, WhenADesignSuppresses_ThenItsAlarmsAreHiddenUntilItEnds) {
  AlarmDefinition flow = on("no_flow", "no_flow");
  flow.suppress_when = "pump_off";
  auto engine = AlarmEngine::create({flow}).value();
  engine.offer(source(engine, "pump_off"), 1, 1, true);
  engine.offer(source(engine, "no_flow"), 2, 1, true);
  EXPECT_EQ(state(engine, "no_flow"), AlarmState::SuppressedByDesign);
  engine.offer(source(engine, "pump_off"), 3, 0, false);
  EXPECT_EQ(state(engine, "no_flow"), AlarmState::SuppressedByDesign) << "a bad value says nothing";
  engine.offer(source(engine, "pump_off"), 4, 0, true);
  EXPECT_EQ(state(engine, "no_flow"), AlarmState::Unacknowledged);
}

TEST(AlarmEngine, WhenTheDesignLeavesSuppressionToPeople_ThenItHoldsUntilTheyEndItAndOverARestart) {
  AlarmDefinition tank = on("tank.low", "low"), flow = on("no_flow", "no_flow");
  tank.suppress_by_hand = true;
  flow.suppress_when = "pump_off";
  auto engine = AlarmEngine::create({tank, flow, on("plain", "plain")}).value();
  for (const char* name : {"no_flow", "plain"})
    EXPECT_EQ(engine.command({*engine.find(name), AlarmEvent::Suppress, 1, "anna"}).error()[0].code, "C0606");
  ASSERT_TRUE(engine.command({AlarmId(0), AlarmEvent::Suppress, 1, "anna", "is cleaned"}).has_value());
  engine.offer(source(engine, "low"), 2, 1, true);
  EXPECT_EQ(state(engine, "tank.low"), AlarmState::SuppressedByDesign);
  auto after = AlarmEngine::create({tank, flow}).value();
  after.restore(AlarmId(0), engine.view(AlarmId(0)));
  EXPECT_EQ(state(after, "tank.low"), AlarmState::SuppressedByDesign);
  ASSERT_TRUE(after.command({AlarmId(0), AlarmEvent::Unsuppress, 9, "anna"}).has_value());
  EXPECT_EQ(state(after, "tank.low"), AlarmState::Unacknowledged) << "its condition holds still";
  tank.suppress_when = "cleaning";
  EXPECT_EQ(AlarmEngine::create({tank}).error()[0].code, "C0605");
}

TEST(AlarmEngine, WhenSeveralAlarmsOfAGroupAreRaised_ThenThoseOfTheFirstScanAreFirstOut) {
  auto engine =
      AlarmEngine::create({on("a", "a", "g"), on("b", "b", "g"), on("c", "c", "g"), on("x", "x")}).value();
  const auto set = [&](const char* name, std::int64_t time, double value) {
    engine.offer(source(engine, name), time, value, true);
  };
  set("x", 5, 1);
  set("b", 10, 1);
  set("c", 10, 1);
  set("a", 20, 1);
  EXPECT_EQ(told(engine),
            "5 x unacknowledged; 10 b unacknowledged*; 10 c unacknowledged*; 20 a unacknowledged; ");
  for (const char* name : {"a", "b", "c"}) {
    set(name, 30, 0);
    EXPECT_TRUE(engine.command({*engine.find(name), AlarmEvent::Acknowledge, 31, "anna"}).has_value());
  }
  (void)engine.take();
  set("a", 40, 1);
  set("b", 41, 1);
  EXPECT_EQ(told(engine), "40 a unacknowledged*; 41 b unacknowledged; ") << "the group began anew";
  set("c", 39, 1);
  EXPECT_EQ(told(engine), "39 c unacknowledged*; ") << "news of an earlier scan that came later";
  EXPECT_FALSE(engine.view(*engine.find("a")).first_out);
}

TEST(AlarmEngine, WhenACommandIsNotAllowed_ThenTheReasonIsTold) {
  AlarmDefinition never = on("never", "n");
  never.longest_shelving = nanoseconds(0);
  auto engine = AlarmEngine::create({never, on("b", "b")}).value();
  const auto refused = [&](const Command& command) {
    const auto done = engine.command(command);
    return done ? std::string("done") : done.error()[0].code + " " + done.error()[0].message;
  };
  EXPECT_EQ(refused({AlarmId(0), AlarmEvent::Acknowledge}),
            "C0606 never: acknowledge is refused, because there is nothing to acknowledge");
  EXPECT_EQ(refused({AlarmId(0), AlarmEvent::Shelve, 0, "", "", std::chrono::seconds(5)}),
            "C0606 never cannot be shelved for 5 s");
  EXPECT_EQ(refused({AlarmId(1), AlarmEvent::Shelve}), "C0606 b cannot be shelved for 0 s");
  EXPECT_EQ(refused({AlarmId(1), AlarmEvent::Shelve, 0, "", "", std::chrono::hours(9)}),
            "C0606 b cannot be shelved for 32400 s");
  EXPECT_EQ(refused({AlarmId(1), AlarmEvent::Raise}), "C0606 'raise' is for the plant, not for people");
  EXPECT_EQ(refused({AlarmId(2), AlarmEvent::Reset}), "C0606 there is no alarm with the number 2");
  EXPECT_EQ(refused({AlarmId(1), AlarmEvent::RemoveFromService}), "done");
  EXPECT_EQ(engine.take().size(), 1u);
}

TEST(AlarmEngine, WhenDefinitionsAreWrong_ThenEachIsToldAtItsPlace) {
  AlarmDefinition twice = on("a", "a"), nothing = on("", ""), numbers = on("n", "n");
  twice.where = {"alarms.toml", 7, 1};
  numbers.condition.deadband = -1;
  numbers.condition.off_delay = nanoseconds(-1);
  const auto engine = AlarmEngine::create({on("a", "a"), twice, nothing, numbers});
  ASSERT_FALSE(engine.has_value());
  std::vector<std::string> codes;
  for (const auto& problem : engine.error()) codes.push_back(problem.code);
  EXPECT_EQ(codes, (std::vector<std::string>{"C0601", "C0602", "C0602", "C0605", "C0605"}));
  EXPECT_EQ(engine.error()[0].where.line, 7u);
}

TEST(AlarmEngine, WhenItIsRestored_ThenItGoesOnWhereTheOtherEnded) {
  const std::vector<AlarmDefinition> definitions = {on("a", "a", "g"), on("b", "b", "g"), on("c", "c")};
  auto before = AlarmEngine::create(definitions).value();
  before.offer(source(before, "a"), 10, 1, true);
  before.offer(source(before, "b"), 20, 1, true);
  ASSERT_TRUE(before.command({AlarmId(0), AlarmEvent::Acknowledge, 25}).has_value());
  ASSERT_TRUE(before.command({AlarmId(2), AlarmEvent::Shelve, 25, "", "", nanoseconds(100)}).has_value());
  auto after = AlarmEngine::create(definitions).value();
  for (std::uint32_t i = 0; i < 3; ++i) after.restore(AlarmId(i), before.view(AlarmId(i)));
  for (const char* name : {"a", "b", "c"}) after.offer(source(after, name), 30, 1, true);
  EXPECT_EQ(told(after), "30 c shelved; ") << "what is known already is no news";
  after.offer(source(after, "a"), 40, 0, true);
  after.advance(200);
  EXPECT_EQ(told(after), "40 a normal*; 125 c unacknowledged; ") << "the group's first is remembered";
  EXPECT_EQ(after.view(AlarmId(1)).raised_ns, 20);
}

// Whatever comes, in whatever order: every transition joins the one before it, and nothing is told twice.
TEST(AlarmEngine, WhenInputIsRandom_ThenTransitionsAreAChain) {
  std::mt19937 random(1);
  std::vector<AlarmDefinition> definitions;
  for (int i = 0; i < 20; ++i) {
    AlarmDefinition one = on("a" + std::to_string(i), "s" + std::to_string(i % 7), i % 3 == 0 ? "g" : "");
    one.traits = {i % 2 == 0, i % 5 == 0};
    one.condition.on_delay = nanoseconds(i % 4);
    if (i % 6 == 0) one.suppress_when = "s" + std::to_string((i + 1) % 7);
    definitions.push_back(one);
  }
  auto engine = AlarmEngine::create(definitions).value();
  std::vector<AlarmState> states(20, AlarmState::Normal);
  std::uint64_t sequence = 0;
  std::vector<std::int64_t> newest(20, 0);
  for (std::int64_t time = 0; time < 20'000; ++time) {
    engine.offer(SourceId(static_cast<std::uint32_t>(random() % engine.sources().size())), time,
                 static_cast<double>(random() % 2), random() % 9 != 0);
    const AlarmId alarm(static_cast<std::uint32_t>(random() % 20));
    (void)engine.command(
        {alarm, static_cast<AlarmEvent>(random() % kAlarmEvents), time, "", "", nanoseconds(random() % 50)});
    if (time % 3 == 0) engine.advance(time);
    for (const Transition& t : engine.take()) {
      ASSERT_EQ(t.sequence, ++sequence);
      ASSERT_EQ(t.from, states[t.alarm.value]);
      ASSERT_EQ(t.to, t.status.state());
      ASSERT_LE(newest[t.alarm.value], t.time_ns) << "times of an alarm ascend";
      ASSERT_LE(t.time_ns, time);
      newest[t.alarm.value] = t.time_ns;
      states[t.alarm.value] = t.to;
    }
  }
  EXPECT_GT(sequence, 10'000u);
}

TEST(AlarmEngine, WhenItIsRestored_ThenFirstOutIsOfWhatStandsAndNothingIsSuppressedForEver) {
  auto engine = AlarmEngine::create({on("a", "a", "g"), on("b", "b", "g"), on("c", "c", "g")}).value();
  AlarmView view;
  view.status.active = true;
  view.status.annunciated = AlarmState::Unacknowledged;
  view.first_out = true;
  view.raised_ns = 20;
  engine.restore(AlarmId(0), view);
  view.raised_ns = 10;  // told later, of an earlier scan
  engine.restore(AlarmId(1), view);
  view.status = {};
  view.status.suppressed = true;  // by a variable that its definition no longer names
  engine.restore(AlarmId(2), view);
  EXPECT_FALSE(engine.view(AlarmId(0)).first_out);
  EXPECT_TRUE(engine.view(AlarmId(1)).first_out);
  EXPECT_FALSE(engine.view(AlarmId(2)).first_out);
  EXPECT_EQ(engine.view(AlarmId(2)).status.state(), AlarmState::Normal);
  engine.offer(source(engine, "c"), 30, 1, true);
  EXPECT_FALSE(engine.view(AlarmId(2)).first_out) << "the group stands already";
}

}  // namespace
}  // namespace stepwright::alarms
