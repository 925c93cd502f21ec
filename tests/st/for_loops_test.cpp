// FOR over every integer type with first values, limits and steps near the ends of the type, constants and
// variables, on every engine, beside a reference that counts in 128 bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "tests/st/compiled_text.h"
#include "tests/st/machine.h"

namespace {

using namespace stepwright;
using st_test::compiled;
using Wide = __int128;

constexpr int kMostTurns = 20;  // a loop that has not ended by then is left by EXIT

std::string text_of(Wide value) {
  if (value < 0) return "-" + text_of(-value);
  if (value >= 10) return text_of(value / 10) + text_of(value % 10);
  return std::string(1, static_cast<char>('0' + static_cast<int>(value)));
}

struct IntegerType {
  const char* name;
  int bits;
  bool is_signed;

  Wide low() const { return is_signed ? -(Wide{1} << (bits - 1)) : Wide{0}; }
  Wide high() const { return (Wide{1} << (is_signed ? bits - 1 : bits)) - 1; }
  Wide wrapped(Wide value) const {
    const Wide modulus = Wide{1} << bits;
    const Wide rest = ((value % modulus) + modulus) % modulus;
    return rest > high() ? rest - modulus : rest;
  }
};

const IntegerType kTypes[] = {{"SINT", 8, true},    {"INT", 16, true},   {"DINT", 32, true},
                              {"LINT", 64, true},   {"USINT", 8, false}, {"UINT", 16, false},
                              {"UDINT", 32, false}, {"ULINT", 64, false}};

struct Case {
  Wide first;
  Wide limit;
  Wide step;
};

struct Outcome {
  int turns = 0;
  Wide last = 0;   // the value in the last turn; 0 if there was none
  Wide after = 0;  // the variable behind the loop
  bool traps = false;
};

// What ladder/doc/language.md says. `low`, `high`: of the variable's type, a subrange or not.
Outcome counted(const IntegerType& type, Wide low, Wide high, const Case& loop) {
  const auto within = [&](Wide value) { return loop.step >= 0 ? value <= loop.limit : value >= loop.limit; };
  Outcome outcome;
  outcome.after = loop.first;
  if (!within(loop.first)) return outcome;
  for (;;) {
    ++outcome.turns;
    outcome.last = outcome.after;
    if (outcome.turns == kMostTurns) return outcome;
    const Wide next = outcome.after + loop.step;
    if (within(next)) {
      outcome.traps = next < low || next > high;
      if (outcome.traps) return outcome;
      outcome.after = next;
      continue;
    }
    const Wide behind = type.wrapped(next);
    if (behind >= low && behind <= high) outcome.after = behind;
    return outcome;
  }
}

std::vector<Wide> edges_of(const IntegerType& type) {
  std::vector<Wide> edges;
  for (const Wide middle : {type.low(), Wide{0}, type.high()})
    for (int offset = -2; offset <= 2; ++offset)
      if (middle + offset >= type.low() && middle + offset <= type.high()) edges.push_back(middle + offset);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<Wide> steps_of(const IntegerType& type) {
  std::vector<Wide> steps{0, 1, 2, 3, type.high() / 2 + 1, type.high()};
  if (type.is_signed) steps.insert(steps.end(), {-1, -2, -3, type.low() / 2, type.low()});
  return steps;
}

std::vector<Case> cases_of(const IntegerType& type) {
  std::vector<Case> cases;
  for (const Wide first : edges_of(type))
    for (const Wide limit : edges_of(type))
      for (const Wide step : steps_of(type)) cases.push_back({first, limit, step});
  return cases;
}

std::string shown(const Case& loop) {
  return "FOR i := " + text_of(loop.first) + " TO " + text_of(loop.limit) + " BY " + text_of(loop.step);
}

std::string turn(const std::string& number) {
  return " DO n := n + 1; last := i; IF n >= " + number + " THEN EXIT; END_IF; END_FOR;\n";
}

class ForLoops : public testing::TestWithParam<IntegerType> {
 protected:
  const IntegerType& type() const { return GetParam(); }

  // One loop whose first value, limit and step are variables, run once for each case.
  void count_by_variables(const std::string& variable_type, Wide low, Wide high,
                          const std::vector<Case>& cases) {
    const std::string name = type().name;
    const reader::LoadedProgram program =
        compiled("PROGRAM main VAR first, limit, step, last : " + name + "; n : DINT; i : " + variable_type +
                 "; END_VAR\nn := 0; last := 0;\nFOR i := first TO limit BY step" +
                 turn(text_of(kMostTurns)) + "END_PROGRAM\n");
    for (const st_test::EngineKind engine : st_test::engines()) {
      st_test::Machine machine(program, engine);
      for (const Case& each : cases) {
        machine.set("first", text_of(each.first));
        machine.set("limit", text_of(each.limit));
        machine.set("step", text_of(each.step));
        const Outcome expected = counted(type(), low, high, each);
        const scan::ScanReport report = machine.scan();
        const auto trap = expected.traps ? bytecode::TrapCode::SubrangeRange : bytecode::TrapCode::None;
        const bool right = report.trap.code == trap && machine.equals("n", text_of(expected.turns)) &&
                           machine.equals("last", text_of(expected.last)) &&
                           machine.equals("i", text_of(expected.after));
        EXPECT_TRUE(right) << st_test::name_of(engine) << ", " << variable_type << ": " << shown(each)
                           << ": trap " << static_cast<int>(report.trap.code) << ", turns "
                           << machine.shown("n") << ", last " << machine.shown("last") << ", behind "
                           << machine.shown("i") << "; expected " << expected.traps << ", " << expected.turns
                           << ", " << text_of(expected.last) << ", " << text_of(expected.after);
        if (!right) return;  // one of a kind is enough
        machine.restart_after_trap();
      }
    }
  }
};

TEST_P(ForLoops, Count_WhenAllAreVariables_ThenIsThatOfTheReference) {
  count_by_variables(type().name, type().low(), type().high(), cases_of(type()));
}

TEST_P(ForLoops, Count_WhenTheVariableIsOfASubrange_ThenItNeverLeavesTheRange) {
  const Wide middle = type().is_signed ? -2 : 3;
  const std::pair<Wide, Wide> ranges[] = {{type().low(), type().low() + 4},
                                          {middle, middle + 4},
                                          {type().high() - 4, type().high()},
                                          {type().low() + 1, type().high() - 1}};
  for (const auto& [low, high] : ranges) {
    std::vector<Case> cases;
    for (const Case& each : cases_of(type()))
      for (const Wide first : {low, low + 1, high - 1, high})
        if (each.first == 0) cases.push_back({first, each.limit, each.step});
    for (const Wide limit : {low - 1, low, low + 2, high - 1, high, high + 1})
      for (const Wide first : {low, low + 1, high - 1, high})
        for (const Wide step : steps_of(type()))
          if (limit >= type().low() && limit <= type().high()) cases.push_back({first, limit, step});
    count_by_variables(type().name + ("(" + text_of(low)) + ".." + text_of(high) + ")", low, high, cases);
  }
}

enum class Written { AllConstant, LimitVariable, StepVariable };

// One program with a loop for each case, what is not variable written down.
void count_as_written(const IntegerType& type, const std::string& variable_type, Wide low, Wide high,
                      const std::vector<Case>& cases, Written written) {
  std::string body;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string limit = written == Written::LimitVariable ? "limit" : text_of(cases[i].limit);
    const std::string step = written == Written::StepVariable ? "step" : text_of(cases[i].step);
    const std::string at = "[" + std::to_string(i) + "]";
    body += "limit := " + text_of(cases[i].limit) + "; step := " + text_of(cases[i].step) +
            "; n := 0; last := 0;\nFOR i := " + text_of(cases[i].first) + " TO " + limit + " BY " + step +
            turn(text_of(kMostTurns)) + "turns" + at + " := n; lasts" + at + " := last; behind" + at +
            " := i;\n";
  }
  const std::string name = type.name;
  const std::string size = "[0.." + std::to_string(cases.size() - 1) + "]";
  const reader::LoadedProgram program =
      compiled("PROGRAM main VAR limit, step, last : " + name + "; n : DINT; i : " + variable_type +
               "; turns : ARRAY" + size + " OF DINT; lasts, behind : ARRAY" + size + " OF " + name +
               "; END_VAR\n" + body + "END_PROGRAM\n");
  for (const st_test::EngineKind engine : st_test::engines()) {
    st_test::Machine machine(program, engine);
    const scan::ScanReport report = machine.scan();
    ASSERT_EQ(static_cast<int>(report.trap.code), 0) << variable_type;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Outcome expected = counted(type, low, high, cases[i]);
      const std::string at = "[" + std::to_string(i) + "]";
      const bool right = machine.equals("turns" + at, text_of(expected.turns)) &&
                         machine.equals("lasts" + at, text_of(expected.last)) &&
                         machine.equals("behind" + at, text_of(expected.after));
      ASSERT_TRUE(right) << st_test::name_of(engine) << ", " << variable_type << ": " << shown(cases[i])
                         << ": turns " << machine.shown("turns" + at) << ", last "
                         << machine.shown("lasts" + at) << ", behind " << machine.shown("behind" + at)
                         << "; expected " << expected.turns << ", " << text_of(expected.last) << ", "
                         << text_of(expected.after);
    }
  }
}

// A constant step is not 0; of the rest every third, from another one on for each way to write it.
std::vector<Case> some_cases(const IntegerType& type, std::size_t from) {
  std::vector<Case> cases;
  const std::vector<Case> all = cases_of(type);
  for (std::size_t i = from; i < all.size(); i += 3)
    if (all[i].step != 0) cases.push_back(all[i]);
  return cases;
}

TEST_P(ForLoops, Count_WhenAllIsConstant_ThenIsThatOfTheReference) {
  count_as_written(type(), type().name, type().low(), type().high(), some_cases(type(), 0),
                   Written::AllConstant);
}

TEST_P(ForLoops, Count_WhenTheLimitIsAVariable_ThenIsThatOfTheReference) {
  count_as_written(type(), type().name, type().low(), type().high(), some_cases(type(), 1),
                   Written::LimitVariable);
}

TEST_P(ForLoops, Count_WhenTheStepIsAVariable_ThenIsThatOfTheReference) {
  count_as_written(type(), type().name, type().low(), type().high(), some_cases(type(), 2),
                   Written::StepVariable);
}

TEST_P(ForLoops, Count_WhenTheRangeOfTheVariableEndsAtTheLimit_ThenItKeepsItsLastValue) {
  const Wide low = type().high() - 4;
  const Wide high = type().high() - 1;
  std::vector<Case> cases;
  for (const Wide first : {low, low + 1, high})
    for (const Wide limit : {low, low + 2, high})
      for (const Wide step : steps_of(type()))
        if (step != 0) cases.push_back({first, limit, step});
  for (const Written written : {Written::AllConstant, Written::LimitVariable, Written::StepVariable})
    count_as_written(type(), type().name + ("(" + text_of(low)) + ".." + text_of(high) + ")", low, high,
                     cases, written);
}

INSTANTIATE_TEST_SUITE_P(, ForLoops, testing::ValuesIn(kTypes),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
