// Networks of pipes, valves and pumps whose pressures Newton's method alone does not find: nothing flows, or
// hardly anything, and flow has a steep root or a kink there.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

constexpr double kWeight = 9806.65;  // N/m3

std::string part(const std::string& name, const std::string& more) {
  return "[components." + name + "]\n" + more + "\n";
}
std::string tower(const std::string& name, double height_m, double start_percent) {
  return part(name, "type = \"tank\"\nvolume = \"1000 m3\"\nheight = \"" + std::to_string(height_m) +
                        " m\"\nstart = \"" + std::to_string(start_percent) + " percent\"");
}

TEST(Network, WhenAPumpStandsBelowATank_ThenNothingFlowsUntilItRuns) {
  for (const double start : {0.0, 1.0, 10.0, 50.0, 100.0}) {
    ModelRig rig(
        part("well", "type = \"source\"") +
        part("pump",
             "type = \"pump\"\nhead = \"18 m\"\nresistance = \"200 m/(m3/s)\"\nin = \"well\"\n"
             "out = \"line.in\"\ncommand = \"RUN\"") +
        part("line", "type = \"pipe\"\nflow = \"25 l/s\"\npressure_drop = \"0.3 bar\"\nout = \"tower\"") +
        tower("tower", 9.0, start) + "[terminals]\nRUN = \"%QX0.0\"\n");
    ASSERT_TRUE(rig.run(1.0)) << start;
    EXPECT_NEAR(rig.truth("line.flow_out"), 0.0, 1e-6);
    rig.set("RUN", 1);
    ASSERT_TRUE(rig.run(5.0)) << start;
    EXPECT_GT(rig.truth("line.flow_out"), 10.0);
    EXPECT_NEAR(rig.truth("line.flow_out"), rig.truth("pump.flow"), 1e-6);
    rig.set("RUN", 0);
    ASSERT_TRUE(rig.run(5.0)) << start;
    EXPECT_NEAR(rig.truth("line.flow_out"), 0.0, 1e-6);
  }
}

TEST(Network, WhenFourPumpsFeedOneLine_ThenEachMayStartAndStop) {
  std::string text =
      part("well", "type = \"source\"") + tower("tower", 9.0, 50.0) +
      part("header", "type = \"pipe\"\nflow = \"50 l/s\"\npressure_drop = \"0.3 bar\"\nout = \"tower\"");
  std::string terminals = "[terminals]\n";
  for (int i = 0; i < 4; ++i) {
    const std::string n = std::to_string(i);
    text += part("pump" + n,
                 "type = \"pump\"\nhead = \"18 m\"\nresistance = \"200 m/(m3/s)\"\nin = \"well\"\nout = "
                 "\"valve" +
                     n + ".in\"\ncommand = \"RUN" + n + "\"");
    text +=
        part("valve" + n,
             "type = \"on_off_valve\"\nkv = \"40 l/s\"\nout = \"header.in\"\ncommand = \"OPEN" + n + "\"");
    terminals += "RUN" + n + " = \"%QX0." + n + "\"\nOPEN" + n + " = \"%QX1." + n + "\"\n";
  }
  ModelRig rig(text + terminals);
  ASSERT_TRUE(rig.run(1.0));
  for (const int order : {0, 1, 2, 3}) {
    rig.set("RUN" + std::to_string(order), 1);
    ASSERT_TRUE(rig.run(1.0)) << rig.plant().trouble();
    rig.set("OPEN" + std::to_string(order), 1);
    ASSERT_TRUE(rig.run(3.0)) << rig.plant().trouble();
  }
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += rig.truth("pump" + std::to_string(i) + ".flow");
  EXPECT_GT(sum, 40.0);
  EXPECT_NEAR(rig.truth("header.flow_out"), sum, 1e-6);
  for (const int order : {2, 0, 3, 1}) {
    rig.set("OPEN" + std::to_string(order), 0);
    ASSERT_TRUE(rig.run(3.0)) << rig.plant().trouble();
    rig.set("RUN" + std::to_string(order), 0);
    ASSERT_TRUE(rig.run(3.0)) << rig.plant().trouble();
  }
  EXPECT_NEAR(rig.truth("header.flow_out"), 0.0, 1e-6);
  EXPECT_NEAR(rig.truth("plant.liquid") / 500'000.0, 1.0, 1e-9);
}

TEST(Network, WhenAWarmFeedGoesThroughAJunction_ThenItArrivesWarm) {
  for (const double degrees : {5.0, 20.0, 20.5, 80.0}) {
    ModelRig rig(
        part("main", "type = \"source\"\npressure = \"2 bar\"\ntemperature = \"" + std::to_string(degrees) +
                         " degC\"") +
        part("line",
             "type = \"pipe\"\nflow = \"1 l/s\"\npressure_drop = \"1 bar\"\nin = \"main\"\nout = "
             "\"valve.in\"") +
        part("valve",
             "type = \"control_valve\"\nkv = \"1 l/s\"\nstart = \"50 percent\"\ncommand = \"50 percent\"\n"
             "out = \"bath\"") +
        part("bath",
             "type = \"tank\"\nvolume = \"1 m3\"\nheight = \"1 m\"\nthermal = \"yes\"\nstart = \"1 "
             "percent\""));
    ASSERT_TRUE(rig.run(600.0)) << degrees << ": " << rig.plant().trouble();
    // 10 l of 20 degC, and what has come since.
    const double come = rig.truth("bath.volume_out") - 10.0;
    EXPECT_GT(come, 100.0);
    EXPECT_NEAR(rig.truth("bath.temperature_out"), (10.0 * 20.0 + come * degrees) / (10.0 + come), 1e-3);
  }
}

// Pipes and valves in a row between two tanks: one flow, found by bisection.
class Row {
 public:
  explicit Row(std::mt19937& dice) {
    heads_ = {pick(dice, {0.5, 2.0, 10.0}) * level(dice), pick(dice, {0.5, 2.0, 10.0}) * level(dice)};
    const int count = static_cast<int>(pick(dice, {2.0, 3.0, 4.0}));
    for (int i = 0; i < count; ++i) {
      const std::string ends = std::string(i == 0 ? "in = \"a\"\n" : "") + "out = \"" +
                               (i + 1 == count ? "b" : "e" + std::to_string(i + 1) + ".in") + "\"";
      const double flow = pick(dice, {1.0, 5.0, 20.0});
      const double drop = pick(dice, {0.1, 0.3, 1.0});
      const auto q = "\"" + std::to_string(flow) + " l/s\"\n";
      const auto p = "pressure_drop = \"" + std::to_string(drop) + " bar\"\n";
      std::string words;
      switch (static_cast<int>(pick(dice, {0, 1, 2, 3, 4}))) {
        case 0:
          words = "type = \"pipe\"\nlaw = \"laminar\"\nflow = " + q + p;
          parts_.push_back({true, flow, drop});
          break;
        case 1:
          words = "type = \"on_off_valve\"\ncommand = \"false\"\nkv = " + q;
          parts_.push_back({false, 0.0, 1.0});
          break;
        case 2:
          words = "type = \"control_valve\"\nstart = \"20 percent\"\ncommand = \"20 percent\"\nkv = " + q;
          parts_.push_back({false, 0.2 * flow, 1.0});
          break;
        default:
          words = "type = \"pipe\"\nflow = " + q + p;
          parts_.push_back({false, flow, drop});
      }
      names_.push_back("e" + std::to_string(i) +
                       (words.find("pipe") != std::string::npos ? ".flow_out" : ".flow"));
      text_ += part("e" + std::to_string(i), words + ends);
    }
    text_ += tower("a", heads_[0], 100.0) + tower("b", heads_[1], 100.0);
  }

  const std::string& text() const { return text_; }
  const std::vector<std::string>& flows() const { return names_; }
  // l/s.
  double flow() const {
    const double drop = (heads_[0] - heads_[1]) * kWeight / 1e5;
    for (const Part& each : parts_)
      if (each.flow == 0.0) return 0.0;
    double low = -100.0;
    double high = 100.0;
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2.0;
      double sum = 0.0;
      for (const Part& each : parts_) sum += drop_of(each, middle);
      (sum < drop ? low : high) = middle;
    }
    return low;
  }

 private:
  struct Part {
    bool laminar;
    double flow, drop;  // l/s at bar
  };
  static double pick(std::mt19937& dice, std::vector<double> of) { return of[dice() % of.size()]; }
  static double level(std::mt19937& dice) { return pick(dice, {0.1, 0.5, 1.0}); }
  // The inverse of q = q_n x / (x^2 + 1e-6)^(1/4): x^4 / (x^2 + 1e-6) = (q / q_n)^4.
  static double drop_of(const Part& part, double flow) {
    const double share = flow / part.flow;
    if (part.laminar) return share * part.drop;
    const double fourth = std::pow(share, 4.0);
    const double square = (fourth + std::sqrt(fourth * fourth + 4e-6 * fourth)) / 2.0;
    return std::copysign(std::sqrt(square), share) * part.drop;
  }

  std::vector<double> heads_;
  std::vector<Part> parts_;
  std::vector<std::string> names_;
  std::string text_;
};

TEST(Network, WhenPartsAreInARow_ThenTheFlowIsThatOfTheBisection) {
  std::mt19937 dice(7);
  for (int k = 0; k < 150; ++k) {
    const Row row(dice);
    ModelRig rig(row.text());
    ASSERT_TRUE(rig.run(0.02)) << k << ": " << rig.plant().trouble() << "\n" << row.text();
    for (const std::string& name : row.flows())
      ASSERT_NEAR(rig.truth(name), row.flow(), 1e-4 * std::max(1.0, std::abs(row.flow()))) << k << "\n"
                                                                                           << row.text();
  }
}

}  // namespace
}  // namespace stepwright::components
