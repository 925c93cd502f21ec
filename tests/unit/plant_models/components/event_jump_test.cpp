// Events of own types whose condition jumps through zero, where no solver finds a root.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

// Counts what rises, and each time that its own count has passed 2.5.
const std::string kCounter = R"toml([types.counter]
inputs.sw = { switch = true, default = "false" }
inputs.u = { unit = "percent", default = "0 percent" }
parameters.limit = { unit = "percent", default = "50 percent" }
parameters.step = { default = "1" }
states.n = { derivative = "0" }
states.above = { derivative = "0" }
states.m = { derivative = "0" }
faults.hit = { high = 1 }
events.count = { when = "(sw ? 1 : 0) - 0.5", set = { n = "n + step" } }
events.rise = { when = "u - limit", set = { above = "above + 1" } }
events.struck = { when = "hit - 0.5", set = { above = "above + 10" } }
events.many = { when = "n - 2.5", set = { m = "m + 1" } }
outputs.n_out = { value = "n" }
outputs.above_out = { value = "above" }
outputs.m_out = { value = "m" }
outputs.many = { switch = true, value = "n > 2.5" }
)toml";

const std::string kTerminal = R"toml([components.x]
type = "counter"
sw = "P"
[components.after]
type = "counter"
sw = "x.many"
[terminals]
P = "%QX0.0"
)toml";

bool pulse(ModelRig& rig, int pulses) {
  for (; pulses > 0; --pulses) {
    rig.set("P", 1);
    if (!rig.run(0.1)) return false;
    rig.set("P", 0);
    if (!rig.run(0.1)) return false;
  }
  return true;
}

TEST(EventJump, WhenATerminalRises_ThenEachEdgeCounts) {
  ModelRig rig(kCounter + kTerminal);
  ASSERT_TRUE(pulse(rig, 4));
  EXPECT_EQ(rig.truth("x.n_out"), 4.0);
}

TEST(EventJump, WhenAnEventSetsAState_ThenOthersFollowAtThatInstant) {
  ModelRig rig(kCounter + kTerminal);
  ASSERT_TRUE(pulse(rig, 2));
  EXPECT_EQ(rig.truth("x.m_out"), 0.0);
  EXPECT_EQ(rig.truth("after.n_out"), 0.0);
  rig.set("P", 1);
  ASSERT_TRUE(rig.run(0.01));
  EXPECT_EQ(rig.truth("x.m_out"), 1.0);
  EXPECT_EQ(rig.truth("after.n_out"), 1.0);  // of another component
  ASSERT_TRUE(pulse(rig, 3));
  EXPECT_EQ(rig.truth("x.m_out"), 1.0);
}

TEST(EventJump, WhenTheEyeOfAConveyorSeesItems_ThenEachCounts) {
  ModelRig rig(kCounter + R"toml([components.belt]
type = "conveyor"
run = "true"
place = "true"
[components.eye]
type = "photo_eye"
of = "belt.seen"
[components.x]
type = "counter"
sw = "eye"
)toml");
  double seen = 0.0;
  bool before = rig.truth("belt.seen") > 0.5;
  for (int i = 0; i < 2'000; ++i) {
    ASSERT_TRUE(rig.run(0.01));
    const bool now = rig.truth("belt.seen") > 0.5;
    if (now && !before) ++seen;
    before = now;
  }
  EXPECT_GT(seen, 10.0);
  EXPECT_EQ(rig.truth("x.n_out"), seen);
}

TEST(EventJump, WhenAnAnalogOutputSteps_ThenItPassesTheLimit) {
  ModelRig rig(kCounter + R"toml([components.x]
type = "counter"
u = "card"
[components.card]
type = "analog_output"
low = "0 percent"
high = "100 percent"
counts = "V"
[terminals]
V = "%QW0"
)toml");
  for (const int counts : {10'000, 20'000, 25'000, 0, 20'000}) {
    rig.set("V", counts);
    ASSERT_TRUE(rig.run(0.1));
  }
  EXPECT_EQ(rig.truth("x.above_out"), 2.0);
}

TEST(EventJump, WhenAFaultBegins_ThenItIsAnEventToo) {
  ModelRig rig(kCounter +
               "[components.x]\ntype = \"counter\"\n[components.eye]\ntype = \"photo_eye\"\nof = "
               "\"x.many\"\n");
  ASSERT_TRUE(rig.run(0.1));
  ASSERT_TRUE(rig.plant().inject_fault("x.hit", 1.0));
  ASSERT_TRUE(rig.run(0.1));
  EXPECT_EQ(rig.truth("x.above_out"), 10.0);
}

TEST(EventJump, WhenItStartsBeyondZero_ThenNothingHasPassed) {
  ModelRig rig(kCounter +
               "[components.x]\ntype = \"counter\"\nsw = \"true\"\nu = \"P2\"\nlimit = \"-1 percent\"\n"
               "[components.P2]\ntype = \"analog_output\"\nlow = \"0 percent\"\nhigh = \"100 "
               "percent\"\ncounts = \"V\"\n[terminals]\nV = \"%QW0\"\n");
  rig.set("V", 100);
  ASSERT_TRUE(rig.run(0.1));
  EXPECT_EQ(rig.truth("x.n_out"), 0.0);
  EXPECT_EQ(rig.truth("x.above_out"), 0.0);
}

TEST(EventJump, WhenATerminalIsSetAndTakenBackAtOnce_ThenNothingHappens) {
  ModelRig rig(kCounter + kTerminal);
  ASSERT_TRUE(rig.run(0.1));
  rig.set("P", 1);
  rig.set("P", 0);
  ASSERT_TRUE(rig.run(0.1));
  EXPECT_EQ(rig.truth("x.n_out"), 0.0);
}

// However finely time is sliced.
TEST(EventJump, WhenStepsAreFiner_ThenTheStateIsTheSame) {
  using namespace std::chrono_literals;
  ModelRig coarse(kCounter + kTerminal);
  ModelRig fine(kCounter + kTerminal);
  for (int i = 0; i < 20; ++i) {
    coarse.set("P", i % 2);
    fine.set("P", i % 2);
    ASSERT_EQ(coarse.plant().advance(10ms), core::PlantStatus::Good);
    for (int k = 0; k < 10; ++k) ASSERT_EQ(fine.plant().advance(1ms), core::PlantStatus::Good);
  }
  ASSERT_EQ(coarse.truth("x.n_out"), 10.0);
  EXPECT_TRUE(std::ranges::equal(coarse.plant().state(), fine.plant().state()));
}

const std::string kFlip = R"toml([types.flip]
inputs.go = { switch = true }
states.x = { derivative = "0" }
outputs.up = { switch = true, value = "x > 0.5" }
)toml";
const std::string kFlips = R"toml([components.f]
type = "flip"
go = "P"
[components.l]
type = "lamp"
command = "f.up"
[terminals]
P = "%QX0.0"
)toml";

TEST(EventJump, WhenEventsCallEachOtherWithoutEnd_ThenThePlantFailsAndNamesTheComponent) {
  ModelRig rig(kFlip + R"toml(events.start = { when = "(go ? 1 : 0) - 0.5", set = { x = "1" } }
events.down = { when = "x - 0.5", set = { x = "0" } }
events.up = { when = "x - 0.5", falling = true, set = { x = "1" } }
)toml" + kFlips);
  ASSERT_TRUE(rig.run(0.1));
  rig.set("P", 1);
  EXPECT_FALSE(rig.run(0.1));
  EXPECT_NE(rig.plant().trouble().find("an event of 'f' happens again and again"), std::string::npos)
      << rig.plant().trouble();
}

// A saw tooth in both directions: where it jumps to is not its next event.
TEST(EventJump, WhenAnEventSetsItsOwnConditionBack_ThenItHappensOnce) {
  ModelRig rig(R"toml([types.saw]
parameters.tick = { unit = "s", default = "1 s" }
states.x = { derivative = "1 / tick" }
states.n = { derivative = "0" }
events.tooth = { when = "x - 0.95", rising = true, falling = true, set = { x = "0", n = "n + 1" } }
outputs.up = { switch = true, value = "x > 0.5" }
outputs.n_out = { value = "n" }
[components.s]
type = "saw"
[components.l]
type = "lamp"
command = "s.up"
)toml");
  ASSERT_TRUE(rig.run(2.0));
  EXPECT_EQ(rig.truth("s.n_out"), 2.0);
}

// What an event throws far beyond zero does not bounce there.
TEST(EventJump, WhenAnEventSetsItsStateFarBeyondZero_ThenItGoesOn) {
  ModelRig rig(R"toml([types.lift]
parameters.v = { unit = "m/s", default = "1 m/s" }
parameters.below = { unit = "m", default = "-5 m" }
parameters.top = { unit = "m", default = "0.1 m" }
states.h = { unit = "m", start = "top", derivative = "d" }
states.d = { unit = "m/s", start = "-v", derivative = "0 * v * v / top" }
events.floor = { when = "h", falling = true, set = { h = "below", d = "v" } }
outputs.height = { unit = "m", value = "h" }
outputs.low = { switch = true, value = "h < below" }
[components.b]
type = "lift"
[components.l]
type = "lamp"
command = "b.low"
)toml");
  ASSERT_TRUE(rig.run(1.1)) << rig.plant().trouble();
  EXPECT_NEAR(rig.truth("b.height"), -4.0, 1e-3);
}

}  // namespace
}  // namespace stepwright::components
