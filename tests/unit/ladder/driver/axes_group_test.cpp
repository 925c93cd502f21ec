// The blocks of a group of axes on both engines, scan by scan: random paths, overrides, interruptions, stops
// and other commands. What is commanded stays on its path and within the limits, and both engines do the same
// to the bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "tests/support/engine_program/engine_program.h"
#include "tests/unit/ladder/driver/path_table.h"

namespace stepwright::driver_test {
namespace {

using support::EngineKind;
using support::EngineProgram;

constexpr const char* kProgram = R"(PROGRAM main
VAR
  g : AXES_GROUP; enable : MC_GroupEnable; stop : MC_GroupStop; hold : MC_GroupInterrupt; on : MC_GroupContinue;
  slow : MC_GroupSetOverride; move : MC_MovePath; first, second : MC_MoveDirectAbsolute; line : MC_MoveLinearAbsolute;
  run : MC_RunAxesGroup; path : MC_PATH; points : ARRAY[0..7] OF MC_WAY_POINT; rows : ARRAY[0..55] OF MC_TIME_ROW;
  goStop, goHold, goOn, goMove, goFirst, goSecond, goLine : BOOL; factor : LREAL := 1.0; cycle : TIME; target : MC_JOINTS;
END_VAR
  enable(Execute := TRUE, AxesGroup := g);
  stop(Execute := goStop, AxesGroup := g);
  hold(Execute := goHold, AxesGroup := g);
  on(Execute := goOn, AxesGroup := g);
  slow(Enable := TRUE, VelFactor := factor, AxesGroup := g);
  first(Execute := goFirst, Position := target, AxesGroup := g);
  move(Execute := goMove, Path := path, Points := points, Rows := rows, AxesGroup := g);
  second(Execute := goSecond, Position := target, AxesGroup := g);
  line(Execute := goLine, Position := target, AxesGroup := g);
  run(CYCLE := cycle, AxesGroup := g);
  g.ActualPosition := g.SetPosition;
END_PROGRAM
)";

// A drive that is 0.7 of its way to the set point from scan to scan.
constexpr const char* kLagging = R"(PROGRAM main
VAR
  g : AXES_GROUP := (Joints := 1, MaxFollowingError := [0.006]); enable : MC_GroupEnable; go : MC_MoveDirectAbsolute;
  run : MC_RunAxesGroup; cycle : TIME := T#10ms; target : MC_JOINTS := [2.0]; stuck : BOOL;
END_VAR
  IF NOT stuck THEN
    g.ActualPosition[1] := g.ActualPosition[1] + 0.7 * (g.SetPosition[1] - g.ActualPosition[1]);
  END_IF;
  enable(Execute := TRUE, AxesGroup := g);
  go(Execute := TRUE, Position := target, AxesGroup := g);
  run(CYCLE := cycle, AxesGroup := g);
END_PROGRAM
)";

// The program in both engines, always with the same inputs.
class Pair {
 public:
  Pair()
      : vm_(support::compile_st(kProgram), EngineKind::Vm),
        native_(support::compile_st(kProgram), EngineKind::Native) {}

  template <typename T>
  void set(const std::string& path, T value) {
    const std::uint32_t address = place(path);
    for (EngineProgram* each : {&vm_, &native_}) std::memcpy(&each->memory()[address], &value, sizeof value);
  }
  void set_real(const std::string& path, double value) { set(path, value); }
  void set_bool(const std::string& path, bool value) { set(path, static_cast<std::uint8_t>(value)); }

  double real(const std::string& path) { return get<double>(path); }
  bool on(const std::string& path) { return get<std::uint8_t>(path) != 0; }

  // False where one traps or the two are not the same.
  bool scan() {
    now_ns_ += 1'000'000;
    if (!vm_.scan(now_ns_) || !native_.scan(now_ns_)) return false;
    const std::uint32_t begin = place("main.g.ActualPosition[1]"),
                        end = place("main.g.Profiles[7].CruiseTime") + 8;
    return std::memcmp(&vm_.memory()[begin], &native_.memory()[begin], end - begin) == 0;
  }

  Joints joints(const std::string& member) {
    Joints all{};
    for (std::size_t j = 0; j < 7; ++j) all[j] = real("main.g." + member + "[" + std::to_string(j + 1) + "]");
    return all;
  }

 private:
  std::uint32_t place(const std::string& path) {
    const auto known = places_.find(path);
    if (known != places_.end()) return known->second;
    return places_[path] = vm_.variable(path).address;
  }
  template <typename T>
  T get(const std::string& path) {
    T value;
    std::memcpy(&value, &vm_.memory()[place(path)], sizeof value);
    return value;
  }

  EngineProgram vm_, native_;
  std::map<std::string, std::uint32_t> places_;
  std::int64_t now_ns_ = 0;
};

std::string element(const std::string& array, std::size_t index, const std::string& member) {
  return "main." + array + "[" + std::to_string(index) + "]." + member;
}

void load(const PathTable& table, double cycle_s, Pair& pair) {
  pair.set("main.g.Joints", static_cast<std::int16_t>(table.joints));
  pair.set("main.cycle", static_cast<std::int64_t>(std::llround(cycle_s * 1e9)));
  for (std::size_t k = 0; k < table.points.size(); ++k) {
    const PathTable::WayPoint& point = table.points[k];
    pair.set_real(element("points", k, "S"), point.place);
    pair.set_real(element("points", k, "H"), point.blend);
    for (std::size_t j = 0; j < table.joints; ++j) {
      pair.set_real(element("points", k, "Q[" + std::to_string(j + 1) + "]"), point.joints[j]);
      pair.set_real(element("points", k, "U[" + std::to_string(j + 1) + "]"), point.direction[j]);
    }
  }
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const PathTable::Row& row = table.rows[k];
    pair.set_real(element("rows", k, "T"), row.begin_s);
    pair.set_real(element("rows", k, "R"), 1.0 / row.length_s);
    for (std::size_t c = 0; c < 6; ++c) pair.set_real(element("rows", k, "C" + std::to_string(c)), row.c[c]);
  }
  pair.set("main.path.Points", static_cast<std::int32_t>(table.points.size()));
  pair.set("main.path.Rows", static_cast<std::int32_t>(table.rows.size()));
  pair.set_real("main.path.Duration", table.duration_s);
  pair.set_real("main.path.RateSlope", table.rate_slope);
  pair.set_real("main.path.RateBend", table.rate_bend);
  for (std::size_t j = 0; j < table.joints; ++j) {
    const std::string index = "[" + std::to_string(j + 1) + "]";
    const Demand most = table.most(j);
    pair.set_real("main.g.MinPosition" + index, -20.0);
    pair.set_real("main.g.MaxPosition" + index, 20.0);
    pair.set_real("main.g.MaxVelocity" + index, most.speed);
    pair.set_real("main.g.MaxAcceleration" + index, 1.5 * most.acceleration);
    pair.set_real("main.g.MaxJerk" + index, 3.0 * most.jerk);
    pair.set_real("main.g.ActualPosition" + index, table.points[0].joints[j]);
  }
}

// Differences of the set points, beside the group's limits.
class Limits {
 public:
  Limits(const PathTable& table, double cycle_s) : table_(table), dt_(cycle_s) {}

  // The worst of all that was seen, as a part of its limit.
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;

  void see(const Joints& q) {
    for (std::size_t j = 0; j < table_.joints; ++j) {
      if (seen_ > 0) {
        const Demand most = table_.most(j);
        const double v = (q[j] - q_[j]) / dt_, a = (v - v_[j]) / dt_, b = (a - a_[j]) / dt_;
        // Set points are rounded, and what is known of them is their differences.
        const double noise = 1e-15 / (dt_ * dt_ * dt_);
        velocity = std::max(velocity, std::abs(v) / most.speed);
        acceleration = std::max(acceleration, (std::abs(a) - noise * dt_) / (1.5 * most.acceleration));
        jerk = std::max(jerk, (std::abs(b) - 8.0 * noise) / (3.0 * most.jerk));
        v_[j] = v;
        a_[j] = a;
      }
      q_[j] = q[j];
    }
    ++seen_;
  }

 private:
  const PathTable& table_;
  double dt_;
  int seen_ = 0;
  Joints q_{}, v_{}, a_{};
};

double gap(const Joints& a, const Joints& b) {
  double most = 0.0;
  for (std::size_t j = 0; j < 7; ++j) most = std::max(most, std::abs(a[j] - b[j]));
  return most;
}

// How far from the straight line between two points.
double aside(const Joints& q, const Joints& from, const Joints& to) {
  std::size_t widest = 0;
  for (std::size_t j = 1; j < 7; ++j)
    if (std::abs(to[j] - from[j]) > std::abs(to[widest] - from[widest])) widest = j;
  const double part = (q[widest] - from[widest]) / (to[widest] - from[widest]);
  double most = 0.0;
  for (std::size_t j = 0; j < 7; ++j)
    most = std::max(most, std::abs(from[j] + part * (to[j] - from[j]) - q[j]));
  return most;
}

void expect_within(const Limits& limits) {
  EXPECT_LE(limits.velocity, 1.0 + 1e-6);
  EXPECT_LE(limits.acceleration, 1.0 + 1e-3);
  EXPECT_LE(limits.jerk, 1.0 + 1e-2);
}

// A random course of the override, with interruptions.
void disturb(Random& random, Pair& pair) {
  if (random.once_in(60)) pair.set_real("main.factor", random.once_in(3) ? 1.0 : random.between(0.0, 1.0));
  if (random.once_in(200)) pair.set_real("main.factor", 0.0);
  if (random.once_in(120)) pair.set_bool("main.goHold", true);
  if (random.once_in(30)) {
    pair.set_bool("main.goHold", false);
    pair.set_bool("main.goOn", !pair.on("main.goOn"));
  }
}

class AxesGroup : public testing::TestWithParam<std::uint32_t> {};

TEST_P(AxesGroup, Path_WhenOverrideAndInterruptionsAreRandom_ThenItStaysOnItAndWithinItsLimits) {
  const PathTable table = random_table(GetParam());
  Random random(GetParam() + 1000);
  const double cycle_s = 0.001 * random.whole(2, 10);
  Pair pair;
  load(table, cycle_s, pair);
  Limits limits(table, cycle_s);
  ASSERT_TRUE(pair.scan());
  pair.set_bool("main.goMove", true);
  const bool stops = random.once_in(3);
  double off = 0.0;
  bool over = false;
  int scans = 0;
  for (; scans < 12000 && !pair.on("main.move.Done") && !pair.on("main.stop.Done"); ++scans) {
    if (scans < 2000) {
      disturb(random, pair);
    } else {
      pair.set_real("main.factor", 1.0);
      pair.set_bool("main.goHold", false);
      pair.set_bool("main.goOn", scans % 2 == 0);
    }
    if (stops && scans == 200) pair.set_bool("main.goStop", true);
    const double time_s = pair.real("main.g.Time");
    ASSERT_TRUE(pair.scan()) << "scan " << scans;
    const Joints q = pair.joints("SetPosition");
    limits.see(q);
    off = std::max(off, gap(q, table.at(time_s)));
    EXPECT_LE(pair.real("main.g.Time") - time_s, cycle_s * (1.0 + 1e-9));
    EXPECT_GE(pair.real("main.g.Time"), time_s);
    int said = 0;
    for (const char* each : {"Busy", "Done", "CommandAborted", "Error"})
      if (pair.on(std::string("main.hold.") + each)) ++said;
    EXPECT_LE(said, 1) << "scan " << scans;
    // One call after Execute fell, and a command that is over, nothing is said any more.
    EXPECT_TRUE(pair.on("main.goHold") || !over || said == 0) << "scan " << scans;
    over = !pair.on("main.hold.Busy") && !pair.on("main.goHold");
  }
  ASSERT_TRUE(pair.on("main.move.Done") || pair.on("main.stop.Done"));
  EXPECT_LT(off, 1e-9);
  expect_within(limits);
  if (pair.on("main.move.Done")) {
    EXPECT_EQ(pair.joints("SetPosition"), table.points.back().joints);
  }
  // It stands, whatever comes.
  const Joints end = pair.joints("SetPosition");
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(pair.scan());
    EXPECT_EQ(pair.joints("SetPosition"), end);
  }
}

TEST_P(AxesGroup, Commands_WhenOthersComeInBetween_ThenEveryJointKeepsItsLimitsAndTheLastTargetIsMet) {
  const PathTable table = random_table(GetParam());
  Random random(GetParam() + 2000);
  const double cycle_s = 0.001 * random.whole(2, 10);
  Pair pair;
  load(table, cycle_s, pair);
  Limits limits(table, cycle_s);
  ASSERT_TRUE(pair.scan());
  pair.set_bool("main.goMove", true);
  int left = random.whole(2, 5), next = random.whole(20, 250);
  bool lined = false, told = false, done = false;
  Joints target{}, start{};
  std::string last = "move";
  double bent = 0.0;
  for (int scans = 0; scans < 8000 && !done; ++scans) {
    if (scans == next && left > 0) {
      --left;
      next = scans + random.whole(5, 250);
      for (std::size_t j = 0; j < table.joints; ++j) {
        // Not further than the path leads: limits of joints that hardly move on it are small.
        const auto [low, high] = table.range(j);
        target[j] = random.between(low, high);
        pair.set_real("main.target[" + std::to_string(j + 1) + "]", target[j]);
      }
      for (const char* const each : {"main.goFirst", "main.goSecond", "main.goLine", "main.goMove"})
        pair.set_bool(each, false);
      // A rising edge needs a scan without it; the path's block is called all the same.
      ASSERT_TRUE(pair.scan());
      limits.see(pair.joints("SetPosition"));
      last = random.once_in(3) ? "line" : random.once_in(2) ? "first" : "second";
      pair.set_bool("main.go" + std::string(1, static_cast<char>(std::toupper(last[0]))) + last.substr(1),
                    true);
      pair.set_real("main.factor", random.once_in(2) ? 1.0 : random.between(0.0, 1.0));
      lined = last == "line";
      told = false;
    }
    if (random.once_in(100))
      pair.set_real("main.factor", left == 0 || random.once_in(2) ? 1.0 : random.between(0.0, 1.0));
    if (left == 0 && scans > next) pair.set_real("main.factor", 1.0);
    ASSERT_TRUE(pair.scan()) << "scan " << scans;
    const Joints q = pair.joints("SetPosition");
    limits.see(q);
    if (lined && pair.on("main.line.Active")) {
      if (!told) start = pair.joints("Start");
      told = true;
      bent = std::max(bent, aside(q, start, target));
    }
    done = left == 0 && pair.on("main." + last + ".Done");
    ASSERT_FALSE(pair.on("main." + last + ".Error")) << last << ", scan " << scans;
  }
  EXPECT_TRUE(done) << last;
  if (last != "move") {
    EXPECT_LT(gap(pair.joints("SetPosition"), target), 1e-15);
  }
  EXPECT_LT(bent, 1e-9);
  expect_within(limits);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AxesGroup, testing::Range(1U, 25U));

// The set point is far ahead then, and the joint needs some scans to be there again.
TEST(AxesGroup, WhenAScanIsLate_ThenAJointThatCatchesUpHasFollowed) {
  EngineProgram program(support::compile_st(kLagging), EngineKind::Vm);
  const auto put = [&](const char* path, auto value) {
    std::memcpy(&program.memory()[program.variable(path).address], &value, sizeof value);
  };
  const auto power = [&] {
    return program.memory()[program.variable("main.g.DriveOn").address] != std::byte{0};
  };
  std::int64_t now_ns = 0;
  const auto scans = [&](int count) {
    for (int k = 0; k < count; ++k) ASSERT_TRUE(program.scan(now_ns += 10'000'000));
  };
  scans(100);
  put("main.cycle", std::int64_t{50'000'000});
  scans(1);
  put("main.cycle", std::int64_t{10'000'000});
  scans(40);
  EXPECT_TRUE(power());
  put("main.stuck", std::uint8_t{1});
  scans(3);
  EXPECT_FALSE(power());
}

}  // namespace
}  // namespace stepwright::driver_test
