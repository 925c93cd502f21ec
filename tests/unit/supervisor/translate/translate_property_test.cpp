// Random partial orders, played as a token game: whatever the order and however long actions take, every
// action runs exactly once, none before what it depends on is done, and the chart ends in DONE alone.

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "supervisor/translate/plan_graph.h"
#include "supervisor/translate/progress.h"
#include "tests/support/sfc_reference.h"

namespace stepwright::translate {
namespace {

std::string number(std::size_t i) {
  return std::to_string(i);
}

// Tasks t0.. with a start output and a switch that tells that it is done. `shared` tasks use one output.
Binding task_binding(std::size_t size, std::size_t shared) {
  std::string tags = "[times]\nstart_s = 0.02\nsettle_s = 0.02\n[tags]\n";
  std::string rest;
  for (std::size_t i = 0; i < size; ++i) {
    const std::string bit = number(i / 8) + "." + number(i % 8);
    tags += "in" + number(i) + " = { address = \"%IX" + bit + "\" }\n";
    tags += "out" + number(i) + " = { address = \"%QX" + bit + "\" }\n";
    rest += "[[facts]]\nfact = \"(finished t" + number(i) + ")\"\ntag = \"in" + number(i) + "\"\n";
    rest += "[[actions]]\naction = \"(work t" + number(i) + ")\"\ntimeout_s = 1000\n";
    rest += "outputs = [\"out" + number(i < shared ? 0 : i) + "\"]\n";
    rest += "until = { fact = \"(finished t" + number(i) + ")\" }\n";
    if (i % 3 == 0) rest += "rest_s = 0.03\n";
  }
  auto binding = read_binding(tags + rest, "tasks.toml");
  EXPECT_TRUE(binding) << to_string(binding.error());
  return std::move(*binding);
}

model::PlannedRun random_run(std::size_t size, double density, std::mt19937& random) {
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  model::PlannedRun run;
  run.orderings.emplace();
  model::NamedState state;
  for (std::size_t j = 0; j < size; ++j) {
    model::PlannedAction planned;
    planned.action = {"work", {"t" + number(j)}};
    planned.before = state;
    for (std::size_t i = 0; i < j; ++i) {
      if (chance(random) >= density) continue;
      run.orderings->push_back({i, j});
      planned.precondition.children.push_back(model::fact("(finished t" + number(i) + ")"));
    }
    state.facts.insert("(finished t" + number(j) + ")");
    planned.after = state;
    run.actions.push_back(std::move(planned));
  }
  return run;
}

struct Span {
  int begins = 0;
  long first = -1;  // scan in which the step became active
  long last = -1;   // last scan in which it was
};

// Plays the chart; every active task ends after a random number of scans.
class TokenGame {
 public:
  TokenGame(const Translation& translation, std::size_t size, std::mt19937& random)
      : translation_(translation),
        spans_(size),
        finish_(size, 0),
        finished_(size, false),
        random_(random),
        chart_(translation.chart()) {}

  // False if DONE is not reached in time.
  bool play() {
    for (long scan = 0; scan < 20'000; ++scan) {
      chart_.scan(scan * 10'000'000L, [this](const std::string& name) {
        return static_cast<std::int64_t>(finished_[std::stoul(name.substr(2))]);
      });
      std::vector<bool> active;
      for (std::size_t i = 0; i < translation_.steps.size(); ++i) active.push_back(chart_.active(i));
      note(scan, active);
      check_progress(active);
      if (::testing::Test::HasFailure()) return false;
      if (!progress(translation_, active).finished) continue;
      EXPECT_EQ(std::count(active.begin(), active.end(), true), 1) << "tokens are left beside DONE";
      return true;
    }
    return false;
  }

  const std::vector<Span>& spans() const { return spans_; }

 private:
  void note(long scan, const std::vector<bool>& active) {
    for (std::size_t i = 0; i < active.size(); ++i) {
      const StepInfo& step = translation_.steps[i];
      EXPECT_FALSE(active[i] && step.kind == StepKind::Failed) << step.name;
      if (!active[i] || step.kind != StepKind::Action) continue;
      Span& span = spans_[*step.action];
      if (span.last != scan - 1 || span.begins == 0) {
        ++span.begins;
        span.first = scan;
        finish_[*step.action] = scan + std::uniform_int_distribution<long>(0, 40)(random_);
      }
      span.last = scan;
      if (scan >= finish_[*step.action]) finished_[*step.action] = true;
    }
  }

  // What progress() infers from one snapshot is what has happened.
  void check_progress(const std::vector<bool>& active) {
    const Progress now = progress(translation_, active);
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const bool begun = spans_[i].begins > 0;
      EXPECT_EQ(now.actions[i] != ActionState::Pending, begun) << "action " << i;
      EXPECT_TRUE(finished_[i] || now.actions[i] != ActionState::Done) << "action " << i;
    }
  }

  const Translation& translation_;
  std::vector<Span> spans_;
  std::vector<long> finish_;
  std::vector<bool> finished_;
  std::mt19937& random_;
  support::SfcReference chart_;
};

class RandomOrder : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomOrder, WhenPlayed_ThenEveryActionRunsOnceInOrderAndDoneIsReached) {
  std::mt19937 random(GetParam());
  const std::size_t size = 1 + random() % 14;
  const std::size_t shared = random() % 4;
  const double density = std::uniform_real_distribution<double>(0.0, 0.6)(random);
  const Binding binding = task_binding(size, shared);
  const model::PlannedRun run = random_run(size, density, random);
  const bool sequential = random() % 5 == 0;
  const auto made = translate(run, binding, {.sequential = sequential});
  ASSERT_TRUE(made) << to_string(made.error());
  EXPECT_TRUE(graphic::check(made->chart()).empty());
  TokenGame game(*made, size, random);
  ASSERT_TRUE(game.play());
  const auto& spans = game.spans();
  for (const Span& span : spans) EXPECT_EQ(span.begins, 1);
  for (const model::Ordering& edge : *run.orderings) {
    EXPECT_LT(spans[edge.before].last, spans[edge.after].first) << edge.before << " before " << edge.after;
  }
  for (std::size_t j = 1; j < size; ++j) {
    const bool after_each_other = sequential || j < shared;
    EXPECT_TRUE(!after_each_other || spans[j - 1].last < spans[j].first);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomOrder, ::testing::Range(1U, 201U));

TEST(PlanGraph, WhenNothingIsOrdered_ThenActionsAreParallelUnlessNoOrderIsKnown) {
  const Binding binding = task_binding(3, 0);
  std::mt19937 random(1);
  model::PlannedRun run = random_run(3, 0.0, random);
  ASSERT_TRUE(run.orderings && run.orderings->empty());
  EXPECT_TRUE(plan_graph(run, binding, false)->orderings().empty());
  run.orderings.reset();
  EXPECT_EQ(plan_graph(run, binding, false)->orderings(), (std::vector<model::Ordering>{{0, 1}, {1, 2}}));
}

TEST(ReducedGraph, WhenAnEdgeIsImplied_ThenItIsLeftOut) {
  const PlanGraph graph = reduced_graph(4, {{0, 1}, {1, 2}, {0, 2}, {2, 3}, {0, 3}, {0, 1}});
  EXPECT_EQ(graph.orderings(), (std::vector<model::Ordering>{{0, 1}, {1, 2}, {2, 3}}));
  EXPECT_EQ(graph.predecessors[3], (std::vector<std::size_t>{2}));
}

TEST(ReducedGraph, WhenPlanIsLong_ThenReductionStaysExact) {
  std::mt19937 random(7);
  std::vector<model::Ordering> edges;
  constexpr std::size_t kSize = 150;  // more than two words of the bit set
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = i + 1; j < kSize; ++j) {
      if (random() % 20 == 0) edges.push_back({i, j});
    }
  }
  const auto reachable = [](const std::vector<model::Ordering>& from) {
    std::vector<std::set<std::size_t>> sets(kSize);
    for (std::size_t i = kSize; i-- > 0;) {
      for (const model::Ordering& edge : from) {
        if (edge.before != i) continue;
        sets[i].insert(edge.after);
        sets[i].insert(sets[edge.after].begin(), sets[edge.after].end());
      }
    }
    return sets;
  };
  const auto reduced = reduced_graph(kSize, edges).orderings();
  EXPECT_LT(reduced.size(), edges.size());
  EXPECT_EQ(reachable(reduced), reachable(edges));
  for (std::size_t k = 0; k < reduced.size(); ++k) {
    auto fewer = reduced;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    const auto sets = reachable(fewer);
    EXPECT_FALSE(sets[reduced[k].before].contains(reduced[k].after)) << "an edge too many";
  }
}

}  // namespace
}  // namespace stepwright::translate
