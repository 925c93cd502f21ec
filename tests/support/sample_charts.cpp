#include "tests/support/sample_charts.h"

#include <utility>

namespace stepwright::support {
namespace {

using graphic::ActionBlock;
using graphic::all;
using graphic::always;
using graphic::any;
using graphic::compare;
using graphic::CompareOp;
using graphic::Condition;
using graphic::contact;
using graphic::Qualifier;
using graphic::SfcChart;

void step(SfcChart& chart, std::string name, std::vector<ActionBlock> actions = {},
          std::string comment = {}) {
  graphic::Step result;
  result.name = std::move(name);
  result.initial = chart.steps.empty();
  result.actions = std::move(actions);
  result.comment = std::move(comment);
  chart.steps.push_back(std::move(result));
}

void transition(SfcChart& chart, std::string name, const std::vector<std::uint32_t>& sources,
                const std::vector<std::uint32_t>& targets, Condition condition) {
  graphic::Transition result;
  result.name = std::move(name);
  for (const std::uint32_t id : sources) result.sources.emplace_back(id);
  for (const std::uint32_t id : targets) result.targets.emplace_back(id);
  result.condition = std::move(condition);
  chart.transitions.push_back(std::move(result));
}

}  // namespace

SfcChart sequence_chart() {
  SfcChart chart;
  step(chart, "S00_START");
  step(chart, "S01_LOAD", {{Qualifier::N, "B1"}}, "(load v1 f1 level8)");
  step(chart, "S02_MOVE", {{Qualifier::N, "drive_left"}}, "(move v1 f1 a1)");
  step(chart, "S03_UNLOAD", {{Qualifier::N, "B2"}}, "(unload v1 a1 level8)");
  step(chart, "S04_MOVE", {{Qualifier::N, "drive_right"}}, "(move v1 a1 f1)");
  transition(
      chart, "T00", {0}, {1},
      all({contact("fc1"), compare("S1", CompareOp::Less, "1400"), compare("S2", CompareOp::Less, "800")}));
  transition(chart, "T01", {1}, {2}, compare("S1", CompareOp::Greater, "3783"));
  transition(chart, "T02", {2}, {3}, contact("fc2"));
  transition(chart, "T03", {3}, {4}, compare("S1", CompareOp::LessEqual, "1322"));
  transition(chart, "T04", {4}, {0}, all({contact("fc1"), contact("fc2", true)}));
  return chart;
}

SfcChart nested_chart() {
  SfcChart chart;
  step(chart, "INIT");
  step(chart, "FILL", {{Qualifier::N, "V1"}, {Qualifier::S, "HEATER"}}, "fill the tank");
  step(chart, "STIR", {{Qualifier::L, "M1", "T#30s"}});
  step(chart, "EMPTY_LEFT", {{Qualifier::N, "V2"}});
  step(chart, "EMPTY_RIGHT", {{Qualifier::N, "V3"}});
  step(chart, "EMPTY_DONE");
  step(chart, "STIR_DONE");
  transition(chart, "START", {0}, {1, 2}, contact("go"));
  transition(chart, "LEFT", {1}, {3},
             all({compare("LEVEL", CompareOp::GreaterEqual, "900"), contact("side")}));
  transition(chart, "RIGHT", {1}, {4},
             all({compare("LEVEL", CompareOp::GreaterEqual, "900"), contact("side", true)}));
  transition(chart, "L_OUT", {3}, {5}, contact("low"));
  transition(chart, "R_OUT", {4}, {5}, contact("low"));
  transition(chart, "STIRRED", {2}, {6}, compare("STIR.T", CompareOp::GreaterEqual, "T#40s"));
  transition(chart, "AGAIN", {5, 6}, {0}, always());
  return chart;
}

SfcChart partial_order_chart() {
  SfcChart chart;
  step(chart, "START");                                                       // 0
  step(chart, "A", {{Qualifier::N, "B1"}}, "(load v1 f1 level8)");            // 1
  step(chart, "B", {{Qualifier::N, "B3"}}, "(complete_order a1 c1 level7)");  // 2
  step(chart, "C", {{Qualifier::N, "drive_left"}}, "(move v1 f1 a1)");        // 3
  step(chart, "W_AD");                                                        // 4
  step(chart, "W_BD");                                                        // 5
  step(chart, "D", {{Qualifier::N, "B2"}}, "(unload v1 a1 level8)");          // 6
  step(chart, "E", {{Qualifier::N, "B4"}}, "(partial_order a2 c2 level8)");   // 7
  step(chart, "W_C");                                                         // 8
  step(chart, "W_D");                                                         // 9
  step(chart, "W_E");                                                         // 10
  step(chart, "GOAL");                                                        // 11
  transition(chart, "T_START", {0}, {1, 2}, contact("fc1"));
  transition(chart, "T_A", {1}, {3, 4}, compare("S1", CompareOp::Greater, "3783"));
  transition(chart, "T_B", {2}, {5, 7}, compare("S2", CompareOp::Less, "736"));
  transition(chart, "T_D", {4, 5}, {6}, always());
  transition(chart, "T_C", {3}, {8}, contact("fc2"));
  transition(chart, "T_D_DONE", {6}, {9}, compare("S1", CompareOp::LessEqual, "1322"));
  transition(chart, "T_E", {7}, {10}, compare("S3", CompareOp::Less, "1061"));
  transition(chart, "T_GOAL", {8, 9, 10}, {11}, always());
  return chart;
}

SfcChart rich_chart() {
  SfcChart chart;
  step(chart, "IDLE", {{Qualifier::P, "q0"}, {Qualifier::R, "q1"}});
  step(chart, "RUN",
       {{Qualifier::S, "q1"},
        {Qualifier::D, "q2", "T#2s"},
        {Qualifier::L, "q3", "T#1s"},
        {Qualifier::N, "COUNT"}});
  step(chart, "HOLD",
       {{Qualifier::P1, "q4"},
        {Qualifier::P0, "q5"},
        {Qualifier::SD, "q6", "T#3s"},
        {Qualifier::DS, "q7", "T#3s"}});
  step(chart, "WATCH", {{Qualifier::SL, "q0", "T#500ms"}});
  chart.steps[3].initial = true;
  chart.actions = {{"COUNT", "n := n + 1;"}};
  transition(chart, "GO", {0}, {1}, any({all({contact("a"), contact("b", true)}), contact("c")}));
  transition(chart, "PAUSE", {1}, {2}, any({compare("n", CompareOp::GreaterEqual, "10"), contact("hold")}));
  transition(chart, "", {1}, {0}, compare("RUN.T", CompareOp::Greater, "T#10s"));
  transition(chart, "RESUME", {2}, {1}, contact("hold", true));
  transition(chart, "STOP", {2}, {0}, contact("stop"));
  transition(chart, "WATCHED", {3}, {3}, contact("WATCH.X"));
  return chart;
}

}  // namespace stepwright::support
