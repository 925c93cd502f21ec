// The lowered ladder does what the reference interpreter of the chart does, scan by scan.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "ladder/lowering/sfc_to_ladder.h"
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

class Comparison {
 public:
  Comparison(const graphic::Pou& pou, unsigned seed)
      : chart_(std::get<SfcChart>(pou.body)),
        random_(seed),
        reference_(chart_),
        lowered_(*lower_sfc(pou)),
        ladder_(lowered_) {}

  void run(int scans) {
    for (int scan = 0; scan < scans && !::testing::Test::HasFailure(); ++scan) {
      for (const char* name : {"i0", "i1", "i2", "i3"}) set(name, random_() % 2);
      for (const char* name : {"n0", "n1"}) set(name, random_() % 5);
      now_ns_ += 10'000'000;
      reference_.scan(now_ns_, [this](const std::string& name) { return inputs_.at(name); });
      ladder_.scan(now_ns_);
      compare(scan);
    }
  }

 private:
  void set(const std::string& name, std::int64_t value) {
    inputs_[name] = value;
    ladder_.set(name, value);
  }

  void compare(int scan) {
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      ASSERT_EQ(ladder_.get(lowered_.step_variables[i]) != 0, reference_.active(i))
          << "step " << chart_.steps[i].name << " in scan " << scan;
    }
    for (const char* output : {"o0", "o1", "o2", "o3"}) {
      if (!driven(chart_, output)) continue;
      ASSERT_EQ(ladder_.get(output) != 0, reference_.variable(output)) << output << " in scan " << scan;
    }
    for (const auto& [action, counter] : {std::pair("COUNT0", "c0"), std::pair("COUNT1", "c1")}) {
      if (!blocks_of(chart_, action).empty() && reference_.action(action)) ++counts_[counter];
      ASSERT_EQ(ladder_.get(counter), counts_[counter]) << action << " in scan " << scan;
    }
  }

  const SfcChart& chart_;
  std::mt19937 random_;
  support::SfcReference reference_;
  graphic::Pou lowered_;
  support::LadderEvaluator ladder_;
  std::map<std::string, std::int64_t> inputs_;
  std::map<std::string, std::int64_t> counts_;
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST(SfcLowering, WhenChartsAndInputsAreRandom_ThenLadderFollowsReference) {
  for (unsigned seed = 1; seed <= 3000 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const graphic::Pou pou = random_pou(random);
    ASSERT_FALSE(result::has_errors(graphic::check(std::get<SfcChart>(pou.body))));
    Comparison(pou, seed).run(60);
  }
}

}  // namespace
}  // namespace stepwright::lowering
