// ARM_DISTANCE beside forward kinematics and distances of its own, on random arms, on both engines.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/engine_program/engine_program.h"
#include "tests/unit/ladder/driver/path_table.h"
#include "tests/unit/ladder/driver/two_arms.h"

namespace stepwright::driver_test {
namespace {

using support::EngineKind;
using support::EngineProgram;
using Vec = std::array<double, 3>;

constexpr const char* kDistanceProgram = R"(PROGRAM main
VAR a, b : ARM_MODEL; p, q : MC_JOINTS; d : ARM_DISTANCE; END_VAR
  d(FirstArm := a, SecondArm := b, FirstPosition := p, SecondPosition := q);
END_PROGRAM
)";

struct Frame {
  std::array<Vec, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec place{};

  Vec apply(const Vec& v) const {
    Vec out = place;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) out[r] += rows[r][c] * v[c];
    return out;
  }
  Frame operator*(const Frame& next) const {
    Frame out;
    out.place = apply(next.place);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        out.rows[r][c] = 0.0;
        for (std::size_t k = 0; k < 3; ++k) out.rows[r][c] += rows[r][k] * next.rows[k][c];
      }
    return out;
  }
};

Frame turn(std::size_t axis, double angle) {
  Frame out;
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  out.rows[u][u] = out.rows[v][v] = std::cos(angle);
  out.rows[u][v] = -std::sin(angle);
  out.rows[v][u] = std::sin(angle);
  return out;
}

struct Body {
  Vec from{}, to{};
  double radius = 0.0;
};

class Both {
 public:
  Both()
      : vm_(support::compile_st(kDistanceProgram), EngineKind::Vm),
        native_(support::compile_st(kDistanceProgram), EngineKind::Native) {}
  template <typename T>
  void set(const std::string& path, T value) {
    const std::uint32_t address = vm_.variable(path).address;
    for (EngineProgram* each : {&vm_, &native_}) std::memcpy(&each->memory()[address], &value, sizeof value);
  }
  bool scan() { return vm_.scan() && native_.scan(); }
  double distance() {
    const std::uint32_t address = vm_.variable("main.d.Distance").address;
    double first = 0.0, second = 0.0;
    std::memcpy(&first, &vm_.memory()[address], 8);
    std::memcpy(&second, &native_.memory()[address], 8);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(first), std::bit_cast<std::uint64_t>(second));
    return first;
  }

 private:
  EngineProgram vm_, native_;
};

// Draws an arm into the program; its bodies where it stands then.
std::vector<Body> draw_arm(Random& random, const std::string& arm, const std::string& position, double aside,
                           Both& both) {
  std::vector<Body> bodies;
  Frame at;
  const int joints = random.whole(1, 7);
  int capsules = 0;
  both.set("main." + arm + ".Joints", static_cast<std::int16_t>(joints));
  for (int j = 0; j <= joints; ++j) {
    if (j > 0) {
      const std::string name = "main." + arm + ".Joint[" + std::to_string(j) + "].";
      Frame fixed = turn(0, random.between(-3, 3)) * turn(2, random.between(-3, 3));
      fixed.place = {j == 1 ? aside : random.between(0.0, 0.3), random.between(-0.3, 0.3),
                     random.between(-0.3, 0.3)};
      const bool slides = random.once_in(5);
      const double value = random.between(-2.0, 2.0) * (slides ? 0.2 : 1.0);
      for (std::size_t k = 0; k < 9; ++k)
        both.set(name + "R[" + std::to_string(k) + "]", fixed.rows[k / 3][k % 3]);
      both.set(name + "X", fixed.place[0]);
      both.set(name + "Y", fixed.place[1]);
      both.set(name + "Z", fixed.place[2]);
      both.set(name + "Slides", static_cast<std::uint8_t>(slides));
      both.set("main." + position + "[" + std::to_string(j) + "]", value);
      Frame moved = slides ? Frame{} : turn(2, value);
      if (slides) moved.place = {0.0, 0.0, value};
      at = at * fixed * moved;
    }
    for (int k = random.whole(j == joints && capsules == 0 ? 1 : 0, 2); k > 0 && capsules < 12 && j > 0;
         --k) {
      const std::string name = "main." + arm + ".Capsule[" + std::to_string(++capsules) + "].";
      Vec from{}, to{};
      for (std::size_t c = 0; c < 3; ++c) from[c] = to[c] = random.between(-0.2, 0.2);
      if (!random.once_in(4))
        for (double& each : to) each += random.between(-0.4, 0.4);
      const double radius = random.between(0.02, 0.08);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::string axis(1, "XYZ"[c]);
        both.set(name + axis + "1", from[c]);
        both.set(name + axis + "2", to[c]);
      }
      both.set(name + "Radius", radius);
      both.set(name + "Joint", static_cast<std::int16_t>(j));
      bodies.push_back({at.apply(from), at.apply(to), radius});
    }
  }
  both.set("main." + arm + ".Capsules", static_cast<std::int16_t>(capsules));
  return bodies;
}

Vec mixed(const Vec& a, const Vec& b, double part) {
  return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])};
}

double apart(const Vec& a, const Vec& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// From a point to a line, exactly; from a line to a line by many of its points.
double to_line(const Vec& p, const Body& line) {
  double along = 0.0, square = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    along += (p[c] - line.from[c]) * (line.to[c] - line.from[c]);
    square += (line.to[c] - line.from[c]) * (line.to[c] - line.from[c]);
  }
  return apart(p, mixed(line.from, line.to, square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0));
}

double least(const std::vector<Body>& first, const std::vector<Body>& second) {
  double best = 1e3;
  for (const Body& a : first)
    for (const Body& b : second)
      for (int k = 0; k <= 400; ++k)
        best = std::min(best, to_line(mixed(a.from, a.to, k / 400.0), b) - a.radius - b.radius);
  return best;
}

TEST(ArmDistance, WhenArmsAreRandom_ThenItIsThatOfTheirBodies) {
  Both both;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const auto first = draw_arm(random, "a", "p", 0.0, both);
    const auto second = draw_arm(random, "b", "q", random.between(0.2, 1.5), both);
    ASSERT_TRUE(both.scan());
    const double distance = both.distance(), sampled = least(first, second);
    // Never more than what is true; the samples are a little more.
    EXPECT_LE(distance, sampled + 1e-9) << "seed " << seed;
    EXPECT_GE(distance, sampled - 2e-3) << "seed " << seed;
  }
}

std::string interlock_program() {
  return std::string("PROGRAM main\nVAR") + kTwoArms +
         R"(  a, b : AXES_GROUP := (MaxVelocity := [2.0, 2.0, 2.5, 2.5, 3.0, 3.0, 3.0], MaxAcceleration := [7(8.0)],
                         MaxJerk := [7(80.0)]);
  enableA, enableB : MC_GroupEnable; resetA, resetB : MC_GroupReset; moveA, moveB : MC_MoveDirectAbsolute;
  runA, runB : MC_RunAxesGroup; watch : MC_WatchDistance; goA, goB, goReset, started : BOOL;
  targetA, targetB : MC_JOINTS;
END_VAR
  IF NOT started THEN
    started := TRUE;)" +
         kRightArm + R"(    rightArm.Joint[1].Y := -0.08;
  END_IF;
  a.ActualPosition := a.SetPosition;
  b.ActualPosition := b.SetPosition;
  enableA(Execute := TRUE, AxesGroup := a);
  enableB(Execute := TRUE, AxesGroup := b);
  resetA(Execute := goReset, AxesGroup := a);
  resetB(Execute := goReset, AxesGroup := b);
  moveA(Execute := goA, Position := targetA, AxesGroup := a);
  moveB(Execute := goB, Position := targetB, AxesGroup := b);
  watch(MinDistance := 0.05, CYCLE := T#4ms, FirstArm := leftArm, SecondArm := rightArm, FirstGroup := a,
        SecondGroup := b);
  runA(CYCLE := T#4ms, AxesGroup := a);
  runB(CYCLE := T#4ms, AxesGroup := b);
END_PROGRAM
)";
}

class Interlocked {
 public:
  Interlocked() : program_(support::compile_st(interlock_program()), EngineKind::Native) {}
  template <typename T>
  void set(const std::string& path, T value) {
    std::memcpy(&program_.memory()[program_.variable("main." + path).address], &value, sizeof value);
  }
  template <typename T>
  T get(const std::string& path) {
    T value;
    std::memcpy(&value, &program_.memory()[program_.variable("main." + path).address], sizeof value);
    return value;
  }
  void command(Random& random, const std::string& arm) {
    constexpr std::array<double, 7> kMost = {2.0, 2.0, 1.7, 2.0, 1.9, 1.4, 1.4};
    for (std::size_t j = 0; j < 7; ++j)
      set("target" + arm + "[" + std::to_string(j + 1) + "]",
          random.between(j == 3 ? 0.0 : -kMost[j], kMost[j]));
    set("go" + arm, std::uint8_t{1});
  }
  void scan() { ASSERT_TRUE(program_.scan()); }

 private:
  EngineProgram program_;
};

// A body that appears in a hand is no motion: only how near it is counts.
TEST(ArmDistance, WhenAHandTakesAThing_ThenTheStepOfTheDistanceStopsNobody) {
  Random random(4);
  Interlocked cell;
  cell.scan();
  cell.set("rightArm.Joint[1].Y", -0.45);
  cell.command(random, "A");
  for (int scan = 0; scan < 60; ++scan) cell.scan();
  const double before = cell.get<double>("watch.Distance");
  ASSERT_EQ(cell.get<std::uint16_t>("a.ErrorID"), 0);
  cell.set("rightArm.Capsule[8].Joint", std::int16_t{7});
  cell.set("rightArm.Capsule[8].Z2", -0.78);  // as far back as the shoulder
  cell.set("rightArm.Capsule[8].Radius", 0.45);
  cell.set("rightArm.Capsules", std::int16_t{8});
  cell.scan();
  const double after = cell.get<double>("watch.Distance");
  ASSERT_GT(after, 0.1);
  ASSERT_LT(after - 2.0 * (before - after), 0.05) << "the step is too small to tell";
  EXPECT_EQ(cell.get<std::uint16_t>("a.ErrorID"), 0);
  EXPECT_GT(cell.get<double>("watch.Room"), 0.05);
}

// Both arms get one target after the other at random; whenever the interlock has stopped them, others.
TEST(ArmDistance, WhenCommandsAreRandom_ThenTheInterlockKeepsTheArmsApart) {
  int stops = 0;
  double nearest = 1e3;
  for (std::uint32_t seed = 1; seed <= 24; ++seed) {
    Random random(seed);
    Interlocked cell;
    bool stopped = false;
    for (int scan = 0; scan < 4000; ++scan) {
      const int phase = scan % 400;
      cell.set("goReset", static_cast<std::uint8_t>(phase == 396));
      for (const std::string arm : {"A", "B"}) {
        const bool first = arm == "A";
        if (phase == 398 || phase == (first ? 96 : 196)) cell.set("go" + arm, std::uint8_t{0});
        if (phase == (first ? 0 : 20) || phase == (first ? 100 : 200)) cell.command(random, arm);
      }
      cell.scan();
      nearest = std::min(nearest, cell.get<double>("watch.Distance"));
      const bool error = cell.get<std::uint16_t>("a.ErrorID") == 33;
      stops += error && !stopped ? 1 : 0;
      stopped = error;
    }
  }
  RecordProperty("nearest_um", static_cast<int>(1e6 * nearest));
  EXPECT_GE(stops, 10);
  // Between the places that are looked at it may be a few millimetres less.
  EXPECT_GE(nearest, 0.04);
}

}  // namespace
}  // namespace stepwright::driver_test
