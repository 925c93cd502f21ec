// The lowered ladder, and the compiled program, do what the reference interpreter of the chart does, scan by
// scan.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/support/compiled_program.h"
#include "tests/support/ladder_evaluator.h"
#include "tests/support/sfc_reference.h"
#include "tests/unit/ladder/lowering/random_chart.h"

namespace stepwright::lowering {
namespace {

using graphic::ActionBlock;
using graphic::Qualifier;
using graphic::SfcChart;

std::vector<const ActionBlock*> blocks_of(const SfcChart& chart, const std::string& target) {
  std::vector<const ActionBlock*> blocks;
  for (const graphic::Step& step : chart.steps) {
    for (const ActionBlock& block : step.actions) {
      if (block.target == target) blocks.push_back(&block);
    }
  }
  return blocks;
}

// A variable that the chart resets only belongs to somebody else: the chart says nothing about its TRUE.
bool driven(const SfcChart& chart, const std::string& target) {
  const std::vector<const ActionBlock*> blocks = blocks_of(chart, target);
  return std::any_of(blocks.begin(), blocks.end(),
                     [](const ActionBlock* block) { return block->qualifier != Qualifier::R; });
}

// A chart lowered and run by the evaluator of rungs ...
class Rungs {
 public:
  explicit Rungs(const graphic::Pou& pou) : lowered_(*lower_sfc(pou)), ladder_(lowered_) {}
  void set(const std::string& name, std::int64_t value) { ladder_.set(name, value); }
  void scan(std::int64_t now_ns) { ladder_.scan(now_ns); }
  std::int64_t get(const std::string& name) const { return ladder_.get(name); }

 private:
  graphic::Pou lowered_;
  support::LadderEvaluator ladder_;
};

// ... and compiled and run by the VM, whose scans are 10 ms apart.
class Machine {
 public:
  explicit Machine(const graphic::Pou& pou) : project_(project_of(pou)), program_(input(project_)) {}
  void set(const std::string& name, std::int64_t value) { program_.set("main." + name, value); }
  void scan(std::int64_t) { program_.scan(); }
  std::int64_t get(const std::string& name) const { return program_.get("main." + name); }

 private:
  static graphic::Project project_of(const graphic::Pou& pou) {
    graphic::Project project;
    project.pous = {pou};
    return project;
  }
  static driver::CompileInput input(const graphic::Project& project) {
    driver::CompileInput input;
    input.projects = {&project};
    return input;
  }

  graphic::Project project_;
  support::CompiledProgram program_;
};

template <typename Runner>
class Comparison {
 public:
  Comparison(const graphic::Pou& pou, unsigned seed)
      : chart_(std::get<SfcChart>(pou.body)),
        random_(seed),
        reference_(chart_),
        steps_(lower_sfc(pou)->step_variables),
        runner_(pou) {}

  void run(int scans) {
    for (int scan = 0; scan < scans && !::testing::Test::HasFailure(); ++scan) {
      for (const char* name : {"i0", "i1", "i2", "i3"}) set(name, random_() % 2);
      for (const char* name : {"n0", "n1"}) set(name, random_() % 5);
      now_ns_ += 10'000'000;
      reference_.scan(now_ns_, [this](const std::string& name) { return inputs_.at(name); });
      runner_.scan(now_ns_);
      compare(scan);
    }
  }

 private:
  void set(const std::string& name, std::int64_t value) {
    inputs_[name] = value;
    runner_.set(name, value);
  }

  void compare(int scan) {
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      ASSERT_EQ(runner_.get(steps_[i]) != 0, reference_.active(i))
          << "step " << chart_.steps[i].name << " in scan " << scan;
    }
    for (const char* output : {"o0", "o1", "o2", "o3"}) {
      if (!driven(chart_, output)) continue;
      ASSERT_EQ(runner_.get(output) != 0, reference_.variable(output)) << output << " in scan " << scan;
    }
    for (std::size_t i = 0; i < chart_.actions.size(); ++i) {
      const graphic::Action& action = chart_.actions[i];
      const bool runs = !blocks_of(chart_, action.name).empty() && reference_.runs(action.name);
      counts_[i] += runs ? 1 : 0;
      ASSERT_EQ(runner_.get("c" + std::to_string(i)), counts_[i]) << action.name << " in scan " << scan;
      if (!runs || action.st_body.find(".Q") == std::string::npos) continue;
      ASSERT_EQ(runner_.get("q" + std::to_string(i)) != 0, reference_.action(action.name))
          << action.name << ".Q in scan " << scan;
    }
  }

  const SfcChart& chart_;
  std::mt19937 random_;
  support::SfcReference reference_;
  std::vector<std::string> steps_;
  Runner runner_;
  std::map<std::string, std::int64_t> inputs_;
  std::map<std::size_t, std::int64_t> counts_;
  std::int64_t now_ns_ = 1'000'000'000;
};

// So many transitions that some steps have a bit for those that leave them, and others have none.
graphic::Pou crowded_pou(std::mt19937& random) {
  graphic::Pou pou = random_pou(random);
  std::vector<graphic::Transition>& transitions = std::get<SfcChart>(pou.body).transitions;
  const std::vector<graphic::Transition> known = transitions;
  for (std::size_t more = random() % 40; more > 0; --more) {
    graphic::Transition each = known[random() % known.size()];
    each.name.clear();
    each.targets = known[random() % known.size()].targets;
    each.condition = known[random() % known.size()].condition;
    each.priority = static_cast<int>(random() % 3);
    transitions.push_back(std::move(each));
    // Two networks that it would join have an initial step each.
    if (!graphic::check(std::get<SfcChart>(pou.body)).empty()) transitions.pop_back();
  }
  return pou;
}

template <typename Runner>
void compare_random_charts(unsigned charts, graphic::Pou (*make)(std::mt19937&) = random_pou) {
  for (unsigned seed = 1; seed <= charts && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const graphic::Pou pou = make(random);
    ASSERT_TRUE(graphic::check(std::get<SfcChart>(pou.body)).empty());
    Comparison<Runner>(pou, seed).run(60);
  }
}

TEST(SfcLowering, WhenChartsAndInputsAreRandom_ThenLadderFollowsReference) {
  compare_random_charts<Rungs>(3000);
}

TEST(SfcLowering, WhenRandomChartsAreCompiled_ThenTheMachineFollowsReference) {
  compare_random_charts<Machine>(300);
}

// SFC-E-14
TEST(SfcLowering, WhenManyTransitionsLeaveAStep_ThenLadderAndMachineFollowReference) {
  compare_random_charts<Rungs>(1000, crowded_pou);
  compare_random_charts<Machine>(100, crowded_pou);
}

}  // namespace
}  // namespace stepwright::lowering
