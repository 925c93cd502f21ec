#include "ladder/graphic/sfc_hazards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "ladder/graphic/marking_graph.h"
#include "ladder/graphic/token_net.h"
#include "tests/support/sample_charts.h"
#include "tests/unit/ladder/lowering/chart_builder.h"
#include "tests/unit/ladder/lowering/random_chart.h"

namespace stepwright::graphic {
namespace {

using lowering::step;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Arc {
  const char* name;
  std::vector<const char*> sources;
  std::vector<const char*> targets;
  Condition condition = contact("i");
};

// The first step is initial; steps come in the order in which the arcs name them.
SfcChart chart_of(const std::vector<Arc>& arcs) {
  SfcChart chart;
  std::map<std::string, std::uint32_t> numbers;
  const auto number = [&](const std::string& name) {
    const auto [found, added] = numbers.emplace(name, static_cast<std::uint32_t>(chart.steps.size()));
    if (added) chart.steps.push_back(step(name, chart.steps.empty()));
    return StepId(found->second);
  };
  for (const Arc& arc : arcs) {
    Transition transition;
    transition.name = arc.name;
    transition.condition = arc.condition;
    for (const char* name : arc.sources) transition.sources.push_back(number(name));
    for (const char* name : arc.targets) transition.targets.push_back(number(name));
    chart.transitions.push_back(std::move(transition));
  }
  return chart;
}

// "W0703 C" for each finding: its code and the first name in quotes.
std::vector<std::string> findings(const SfcChart& chart, std::size_t limit = 20'000) {
  std::vector<std::string> lines;
  for (const result::Diagnostic& each : find_hazards(chart, {limit})) {
    EXPECT_NE(each.severity, result::Severity::Error);
    EXPECT_FALSE(each.hint.empty());
    const std::size_t open = each.message.find('\'');
    const std::size_t close = each.message.find('\'', open + 1);
    lines.push_back(each.code +
                    (open == std::string::npos ? "" : " " + each.message.substr(open + 1, close - open - 1)));
  }
  return lines;
}

TEST(SfcHazards, WhenChartIsSafe_ThenNothingIsFound) {
  EXPECT_THAT(findings(support::sequence_chart()), IsEmpty());
  EXPECT_THAT(findings(support::nested_chart()), IsEmpty());
  EXPECT_THAT(findings(support::partial_order_chart()), IsEmpty());
  EXPECT_THAT(findings(support::rich_chart()), IsEmpty());
}

TEST(SfcHazards, WhenOnePartLeavesASimultaneousBranchToAnEnd_ThenATokenIsLost) {
  const SfcChart chart = chart_of({{"FORK", {"A"}, {"B", "C"}},
                                   {"LEAVE", {"B"}, {"END_STOP"}},
                                   {"ON", {"B"}, {"B2"}},
                                   {"STEP_C", {"C"}, {"C2"}},
                                   {"JOIN", {"B2", "C2"}, {"A"}}});
  EXPECT_THAT(findings(chart), ElementsAre("W0704 C2"));
  const auto found = find_hazards(chart);
  EXPECT_THAT(found[0].hint,
              HasSubstr("after 'FORK', 'LEAVE', 'STEP_C' transition 'JOIN' waits for step 'B2'"));
}

TEST(SfcHazards, WhenOnePartJumpsBackBeforeTheFork_ThenAStepIsEnteredTwice) {
  const SfcChart chart = chart_of({{"FORK", {"A"}, {"B", "C"}},
                                   {"BACK", {"B"}, {"A"}},
                                   {"ON", {"B"}, {"D"}},
                                   {"JOIN", {"D", "C"}, {"A"}}});
  EXPECT_THAT(findings(chart), ElementsAre("W0703 C"));
  EXPECT_THAT(find_hazards(chart)[0].hint,
              HasSubstr("after 'FORK', 'BACK' transition 'FORK' enters it a second"));
}

TEST(SfcHazards, WhenSimultaneousBranchesEndLikeAlternatives_ThenAStepIsEnteredTwice) {
  EXPECT_THAT(findings(chart_of({{"FORK", {"A"}, {"B", "C"}}, {"T1", {"B"}, {"D"}}, {"T2", {"C"}, {"D"}}})),
              ElementsAre("W0703 D"));
}

TEST(SfcHazards, WhenAlternativesConvergeLikeSimultaneous_ThenItIsADeadlock) {
  const SfcChart chart = chart_of(
      {{"T1", {"A"}, {"B"}}, {"T2", {"A"}, {"C"}}, {"JOIN", {"B", "C"}, {"D"}}, {"T4", {"D"}, {"A"}}});
  EXPECT_THAT(findings(chart), ElementsAre("W0702 JOIN", "W0705 B", "W0705 C"));
  const auto found = find_hazards(chart);
  EXPECT_THAT(found[0].hint, HasSubstr("so step 'D' can never become active"));
  EXPECT_THAT(found[1].message, HasSubstr("stop for ever in step 'B'"));
  EXPECT_THAT(found[1].hint, HasSubstr("'JOIN' waits for step 'C'"));
}

// SFC-U-2
TEST(SfcHazards, WhenNothingLeadsToAStep_ThenOnlyTheFirstOfItsBranchIsReported) {
  EXPECT_THAT(findings(chart_of({{"T1", {"A"}, {"A2"}}, {"T2", {"X"}, {"Y"}}, {"T3", {"Y"}, {"Z"}}})),
              ElementsAre("W0701 X"));
  EXPECT_THAT(findings(chart_of({{"T1", {"A"}, {"A2"}}, {"T2", {"X"}, {"Y"}}, {"T3", {"Y"}, {"X"}}})),
              ElementsAre("W0701 X"));
}

TEST(SfcHazards, WhenATrueConditionGoesBefore_ThenTheOtherTransitionNeverFires) {
  EXPECT_THAT(
      findings(chart_of({{"T1", {"A"}, {"B"}, always()}, {"T2", {"A"}, {"C"}}, {"T3", {"B"}, {"A"}}})),
      ElementsAre("W0702 T2"));
  SfcChart chart = chart_of({{"T1", {"A"}, {"B"}, always()}, {"T2", {"A"}, {"B"}}, {"T3", {"B"}, {"A"}}});
  chart.transitions[0].priority = 2;
  chart.transitions[1].priority = 1;
  EXPECT_THAT(findings(chart), IsEmpty());
}

TEST(SfcHazards, WhenPlacesAreKnown_ThenFindingsHaveThem) {
  SfcChart chart = chart_of({{"FORK", {"A"}, {"B", "C"}}, {"T1", {"B"}, {"D"}}, {"T2", {"C"}, {"D"}}});
  for (std::uint32_t i = 0; i < 3; ++i) chart.transitions[i].where = {"f.st", 10 + i, 1};
  const auto found = find_hazards(chart);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].where.line, 12U);
}

// `branches` simultaneous branches of `length` steps between A and END; END jumps back.
SfcChart wide_chart(int branches, int length, bool broken) {
  SfcChart chart;
  chart.steps.push_back(step("A", true));
  Transition fork{"FORK", {StepId(0)}, {}, contact("i"), 0, "", {}, {}};
  Transition join{"JOIN", {}, {StepId(0)}, contact("i"), 0, "", {}, {}};
  for (int b = 0; b < branches; ++b) {
    for (int i = 0; i < length; ++i) {
      const auto id = static_cast<std::uint32_t>(chart.steps.size());
      chart.steps.push_back(step("S" + std::to_string(b) + "_" + std::to_string(i)));
      if (i == 0) fork.targets.emplace_back(id);
      if (i + 1 == length) join.sources.emplace_back(id);
      if (i > 0)
        chart.transitions.push_back({"", {StepId(id - 1)}, {StepId(id)}, contact("i"), 0, "", {}, {}});
    }
  }
  chart.transitions.push_back(fork);
  chart.transitions.push_back(join);
  if (broken) chart.transitions.push_back({"BACK", {StepId(1)}, {StepId(0)}, contact("i"), 0, "", {}, {}});
  return chart;
}

TEST(SfcHazards, WhenAThousandStepsRunInTenBranches_ThenTheAnswerIsStillExact) {
  EXPECT_THAT(findings(wide_chart(10, 100, false)), IsEmpty());
  const auto found = findings(wide_chart(10, 100, true));
  EXPECT_THAT(found, ::testing::Contains(HasSubstr("W0703")));
  EXPECT_THAT(found, ::testing::Not(::testing::Contains("W0706")));
}

TEST(SfcHazards, WhenTheSearchIsCut_ThenItSaysSoAndKeepsWhatIsCertain) {
  // Two branches that take two tools one after the other: they do not melt.
  const SfcChart chart = chart_of({{"START", {"I"}, {"A", "B", "T1", "T2"}},
                                   {"TAKE1", {"A", "T1"}, {"A1"}},
                                   {"TAKE2", {"A1", "T2"}, {"A2"}},
                                   {"GIVE", {"A2"}, {"A", "T1", "T2"}},
                                   {"TAKE3", {"B", "T1"}, {"B1"}},
                                   {"TAKE4", {"B1", "T2"}, {"B2"}},
                                   {"GIVE2", {"B2"}, {"B", "T1", "T2"}},
                                   {"T9", {"X"}, {"A"}}});
  EXPECT_THAT(findings(chart), ElementsAre("W0701 X"));
  EXPECT_THAT(findings(chart, 2), ElementsAre("W0701 X", "W0706"));
}

// SFC-U-1. Where a token is doubled more can happen than transitions that fire one by one: A -> B and B -> A
// in one scan keep both active.
TEST(SfcHazards, WhenTokensChangePlacesInOneScan_ThenWhatFollowsCanFire) {
  const SfcChart chart = chart_of({{"SPLIT", {"S0"}, {"S2"}},
                                   {"JOIN", {"S1", "S2"}, {"S5"}},
                                   {"BACK", {"S1"}, {"S0"}},
                                   {"FORK", {"S2"}, {"S1", "S0"}},
                                   {"goal", {"S2", "S5"}, {"S1"}}});
  EXPECT_THAT(findings(chart), ::testing::Not(::testing::Contains(HasSubstr("W0702"))));
  EXPECT_THAT(findings(chart), ::testing::Contains(HasSubstr("W0703")));
}

// Everything that the tokens can come to, all sets of transitions that may fire in one scan tried: the
// meaning of the chart, not a search that could be short of it.
struct Truth {
  std::set<std::size_t> fires;    // transitions of the chart
  std::set<std::size_t> reached;  // steps
  bool deadlock = false;
};

using Bits = std::uint32_t;  // of steps

struct BitTransition {
  Bits sources = 0;
  Bits targets = 0;
  std::size_t origin = 0;
};

std::vector<BitTransition> bit_transitions(const TokenNet& net) {
  std::vector<BitTransition> result;
  for (const NetTransition& each : net.transitions) {
    BitTransition& bits = result.emplace_back();
    for (const std::uint32_t place : each.sources) bits.sources |= Bits{1} << place;
    for (const std::uint32_t place : each.targets) bits.targets |= Bits{1} << place;
    bits.origin = each.origin;
  }
  return result;
}

Truth truth_of(const TokenNet& net) {
  const std::vector<BitTransition> transitions = bit_transitions(net);
  Bits exits = 0;
  for (const BitTransition& each : transitions) exits |= each.sources;
  Bits initial = 0;
  for (const std::uint32_t place : net.marked) initial |= Bits{1} << place;
  Truth truth;
  std::set<Bits> seen{initial};
  std::vector<Bits> open{initial};
  while (!open.empty()) {
    const Bits at = open.back();
    open.pop_back();
    for (std::size_t i = 0; i < net.places; ++i)
      if ((at >> i & 1U) != 0) truth.reached.insert(i);
    std::vector<const BitTransition*> enabled;
    for (const BitTransition& each : transitions)
      if ((at & each.sources) == each.sources) enabled.push_back(&each);
    if (enabled.empty() && (at & exits) == at) truth.deadlock = true;
    for (std::uint32_t set = 1; set < 1U << enabled.size(); ++set) {
      Bits taken = 0;
      Bits given = 0;
      bool conflict = false;
      for (std::size_t i = 0; i < enabled.size(); ++i) {
        if ((set >> i & 1U) == 0) continue;
        conflict = conflict || (taken & enabled[i]->sources) != 0;
        taken |= enabled[i]->sources;
        given |= enabled[i]->targets;
        truth.fires.insert(enabled[i]->origin);
      }
      const Bits next = (at & ~taken) | given;
      if (!conflict && seen.insert(next).second) open.push_back(next);
    }
  }
  return truth;
}

// SFC-U-1, SFC-U-3. What a warning says is true, and nothing is left unsaid: what is no consequence of a
// warning has one.
TEST(SfcHazards, WhenChartsAreRandom_ThenWarningsAreWhatTheTokensCanDo) {
  std::size_t unsafe_deadlocks = 0;
  std::size_t never = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    SfcChart chart = std::get<SfcChart>(lowering::random_pou(random).body);
    for (std::uint32_t i = 0; i < chart.steps.size(); ++i) chart.steps[i].where = {"steps", i, 1};
    for (std::uint32_t i = 0; i < chart.transitions.size(); ++i) chart.transitions[i].where = {"arcs", i, 1};
    const Truth truth = truth_of(token_net(chart));
    bool deadlock = false;
    bool doubled = false;
    std::set<std::size_t> reported;
    std::size_t unreachable = 0;
    for (const result::Diagnostic& each : find_hazards(chart)) {
      deadlock = deadlock || each.code == "W0705";
      doubled = doubled || each.code == "W0703";
      if (each.code == "W0701") {
        ASSERT_EQ(truth.reached.count(each.where.line), 0U) << result::to_string(each);
        ++unreachable;
      }
      if (each.code != "W0702") continue;
      ASSERT_EQ(truth.fires.count(each.where.line), 0U) << result::to_string(each);
      reported.insert(each.where.line);
    }
    ASSERT_EQ(deadlock, truth.deadlock);
    unsafe_deadlocks += deadlock && doubled ? 1 : 0;
    for (std::size_t t = 0; t < chart.transitions.size(); ++t) {
      const auto& sources = chart.transitions[t].sources;
      const bool all = std::all_of(sources.begin(), sources.end(),
                                   [&](StepId step) { return truth.reached.count(step.value) != 0; });
      if (all && truth.fires.count(t) == 0) {
        ASSERT_EQ(reported.count(t), 1U) << "transition " << t;
        ++never;
      }
    }
    if (truth.reached.size() < chart.steps.size()) {
      ASSERT_GT(unreachable + reported.size(), 0U);
    }
  }
  EXPECT_GT(unsafe_deadlocks, 20U);
  EXPECT_GT(never, 100U);
}

// Whether a step can be active that has a way out but can never be left.
bool can_wait_for_ever(const TokenNet& net, const MarkingGraph& graph) {
  std::set<std::uint32_t> exits;
  for (const NetTransition& each : net.transitions) exits.insert(each.sources.begin(), each.sources.end());
  const std::vector<PlaceSet> leave = places_to_leave(net, graph);
  for (std::size_t m = 0; m < graph.markings.size(); ++m) {
    for (const std::uint32_t place : exits) {
      if (contains(graph.markings[m], place) && !contains(leave[m], place)) return true;
    }
  }
  return false;
}

// The melted net gives the answers of the whole net.
TEST(SfcHazards, WhenChartsAreRandom_ThenTheReducedNetAgrees) {
  int unsafe = 0;
  int waiting = 0;
  for (unsigned seed = 1; seed <= 5000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const Pou pou = lowering::random_pou(random);
    const TokenNet net = token_net(std::get<SfcChart>(pou.body));
    const TokenNet small = reduced(net);
    const MarkingGraph whole = explore(net, 100'000);
    const MarkingGraph part = explore(small, 100'000);
    ASSERT_LE(part.markings.size(), whole.markings.size());
    ASSERT_EQ(part.overruns.empty(), whole.overruns.empty());
    unsafe += whole.overruns.empty() ? 0 : 1;
    if (!whole.overruns.empty()) continue;
    const bool waits = can_wait_for_ever(net, whole);
    ASSERT_EQ(can_wait_for_ever(small, part), waits);
    waiting += waits ? 1 : 0;
  }
  EXPECT_GT(unsafe, 100);
  EXPECT_LT(unsafe, 4900);
  EXPECT_GT(waiting, 50);
}

}  // namespace
}  // namespace stepwright::graphic
