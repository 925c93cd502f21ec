// Loops of drawn blocks without an execution order: the leftmost block goes first and reads what the last
// evaluation left.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <vector>

#include "ladder/driver/sheets.h"
#include "ladder/exchange/plcopen_reader.h"
#include "ladder/print/program_document.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/drawn_elements.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string blocks(const std::string& variables, const std::string& body) {
  return editor_project(editor_program(variables, "<FBD>\n" + body + "</FBD>\n"));
}

// set or q, and keep: drawn with the AND at this place.
std::string latch(int and_x, int and_y) {
  return input(1, 0, 10, "set") + block(2, 100, 10, "OR", "IN1=1 IN2=3:OUT", "OUT") +
         input(4, 0, 60, "keep") + block(3, and_x, and_y, "AND", "IN1=2:OUT IN2=4", "OUT") +
         output(5, 300, 10, "3:OUT", "q");
}

TEST(DrawnFeedback, WhenALatchIsDrawnFromLeftToRight_ThenItSetsInTheSameScan) {
  for (const int y : {10, 0, 60})
    EXPECT_EQ(run(blocks(bools("set keep q"), latch(200, y)), "set keep", "set keep|keep|keep| |keep", "q"),
              "1 1 1 0 0");
}

TEST(DrawnFeedback, WhenTheSecondBlockIsLeft_ThenItIsOneScanLate) {
  EXPECT_EQ(run(blocks(bools("set keep q"), latch(50, 10)), "set keep", "set keep|keep|keep| |keep", "q"),
            "0 1 1 0 0");
}

TEST(DrawnFeedback, WhenTheFileGivesAnOrder_ThenItCounts) {
  std::string body = latch(200, 10);
  const auto number = [&](const std::string& id, const std::string& order) {
    const std::string mark = "localId=\"" + id + "\"";
    body.insert(body.find(mark), "executionOrderId=\"" + order + "\" ");
  };
  number("3", "1");
  number("2", "2");
  number("5", "3");
  EXPECT_EQ(run(blocks(bools("set keep q"), body), "set keep", "set keep|keep|keep| |keep", "q"),
            "0 1 1 0 0");
}

TEST(DrawnFeedback, WhenAVariableEndsTheLoop_ThenItIsReadAsItIs) {
  const std::string body =
      input(1, 0, 10, "set") + block(2, 100, 10, "OR", "IN1=1 IN2=5", "OUT") + input(4, 0, 60, "keep") +
      block(3, 200, 10, "AND", "IN1=2:OUT IN2=4", "OUT") +
      at("inOutVariable", 5, 50, 90, in("3:OUT") + "<connectionPointOut/><expression>q</expression>");
  EXPECT_EQ(run(blocks(bools("set keep q"), body), "set keep", "set keep|keep|keep| |keep", "q"),
            "1 1 1 0 0");
}

TEST(DrawnFeedback, WhenALoopHasNoOrder_ThenTheDrawingTellsWhoGoesFirst) {
  const auto project = read_plcopen("plc.xml", blocks(bools("set keep q"), latch(200, 10)));
  ASSERT_TRUE(project);
  const auto sheets = driver::sheets_of(input_of(*project));
  ASSERT_TRUE(sheets);
  const auto* rungs = std::get_if<graphic::LadderProgram>(&sheets->front().body);
  ASSERT_NE(rungs, nullptr);
  EXPECT_THAT(rungs->rungs.front().comment,
              HasSubstr("Feedback: block OR is evaluated first and reads the last value of block AND."));
}

// [x]-(r)-[y]-(q): what is read behind the first coil is a wire.
TEST(DrawnLadder, WhenItIsShown_ThenItIsAsItWasDrawn) {
  const std::string body = contact(2, 50, 10, "1", "x") + coil(3, 100, 10, "2", "r") +
                           contact(4, 150, 10, "3", "y") + coil(5, 200, 10, "4", "q");
  const auto project = read_plcopen("plc.xml", ladder(bools("x r y q"), body));
  ASSERT_TRUE(project);
  const auto sheets = driver::sheets_of(input_of(*project));
  ASSERT_TRUE(sheets);
  EXPECT_THAT(print::program_document(*sheets), Not(HasSubstr("__")));
  const auto* rungs = std::get_if<graphic::LadderProgram>(&sheets->front().body);
  ASSERT_NE(rungs, nullptr);
  ASSERT_FALSE(rungs->rungs.empty());
  EXPECT_EQ(rungs->rungs.back().coils.at(0).variable, "q");
}

// Its actions and conditions are drawn in every form.
TEST(DrawnChart, WhenItIsShown_ThenNothingIsCalledByItsWires) {
  const auto project = read_plcopen("plc.xml", editor_chart());
  ASSERT_TRUE(project);
  const auto sheets = driver::sheets_of(input_of(*project));
  ASSERT_TRUE(sheets) << result::to_string(sheets.error());
  EXPECT_THAT(print::program_document(*sheets), Not(HasSubstr("__")));
}

struct Gate {
  std::string type;
  std::vector<int> from;  // gates, or -1 - number of an input
  int x = 0;
};

constexpr int kInputs = 3;

std::vector<Gate> random_gates(std::mt19937& random) {
  std::vector<Gate> gates(2 + random() % 7);
  for (std::size_t i = 0; i < gates.size(); ++i) gates[i].x = 50 * static_cast<int>(i);
  for (std::size_t i = gates.size() - 1; i > 0; --i) std::swap(gates[i].x, gates[random() % (i + 1)].x);
  for (Gate& each : gates) {
    each.type = random() % 3 == 0 ? "AND" : random() % 2 == 0 ? "OR" : "XOR";
    for (int k = 0; k < 2; ++k)
      each.from.push_back(random() % 3 == 0 ? -1 - static_cast<int>(random() % kInputs)
                                            : static_cast<int>(random() % gates.size()));
  }
  return gates;
}

std::string xml_of(const std::vector<Gate>& gates) {
  std::string body;
  std::string names = "i0 i1 i2";
  int id = 100;
  for (std::size_t i = 0; i < gates.size(); ++i) {
    std::string pins;
    for (std::size_t k = 0; k < 2; ++k) {
      const int from = gates[i].from[k];
      if (from < 0) body += input(id += 1, 0, 400, "i" + std::to_string(-1 - from));
      pins += " IN" + std::to_string(k + 1) + "=" +
              (from < 0 ? std::to_string(id) : std::to_string(from + 1) + ":OUT");
    }
    const int place = static_cast<int>(i);
    body += block(place + 1, gates[i].x, 300 - 7 * place, gates[i].type, pins, "OUT");
    body += output(id += 1, 900, 400, std::to_string(place + 1) + ":OUT", "q" + std::to_string(i));
    names += " q" + std::to_string(i);
  }
  return blocks(bools(names), body);
}

// Gates in the order of their evaluation: a gate whose inputs are known, or else the leftmost of those that
// lead to themselves and wait for nobody outside of their loop.
std::vector<std::size_t> order_of(const std::vector<Gate>& gates) {
  const std::size_t count = gates.size();
  std::vector<bool> is_done(count, false);
  std::vector<std::size_t> order;
  while (order.size() < count) {
    // leads[a][b]: b needs a, of what is left.
    std::vector<std::vector<bool>> leads(count, std::vector<bool>(count, false));
    for (std::size_t b = 0; b < count; ++b)
      for (const int a : gates[b].from)
        if (a >= 0 && !is_done[static_cast<std::size_t>(a)] && !is_done[b])
          leads[static_cast<std::size_t>(a)][b] = true;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b)
          if (leads[a][k] && leads[k][b]) leads[a][b] = true;
    std::size_t next = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (is_done[i]) continue;
      bool waits = false;
      for (std::size_t a = 0; a < count; ++a) waits = waits || (leads[a][i] && !leads[i][a]);
      if (!waits && (next == count || gates[i].x < gates[next].x)) next = i;
    }
    is_done[next] = true;
    order.push_back(next);
  }
  return order;
}

TEST(DrawnFeedback, WhenLoopsAreRandom_ThenTheyFollowTheRule) {
  for (unsigned seed = 1; seed <= 300 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const std::vector<Gate> gates = random_gates(random);
    const std::vector<std::size_t> order = order_of(gates);
    const auto project = read_plcopen("plc.xml", xml_of(gates));
    ASSERT_TRUE(project) << result::to_string(project.error());
    support::CompiledProgram program(input_of(*project));
    std::vector<bool> state(gates.size(), false);
    for (int scan = 0; scan < 6; ++scan) {
      bool inputs[kInputs] = {};
      for (int i = 0; i < kInputs; ++i) {
        inputs[i] = random() % 2 == 0;
        program.set("run.i" + std::to_string(i), inputs[i] ? 1 : 0);
      }
      const auto value = [&](int from) {
        return from < 0 ? inputs[-1 - from] : state[static_cast<std::size_t>(from)];
      };
      for (const std::size_t i : order) {
        const bool a = value(gates[i].from[0]);
        const bool b = value(gates[i].from[1]);
        state[i] = gates[i].type == "AND" ? a && b : gates[i].type == "OR" ? a || b : a != b;
      }
      ASSERT_FALSE(program.scan().trap);
      for (std::size_t i = 0; i < gates.size(); ++i)
        ASSERT_EQ(program.get("run.q" + std::to_string(i)) != 0, state[i])
            << "scan " << scan << ", gate " << i << xml_of(gates);
    }
  }
}

}  // namespace
}  // namespace stepwright::exchange
