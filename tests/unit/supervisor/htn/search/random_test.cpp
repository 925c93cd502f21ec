// Thousands of small random problems against a brute force of the tests' own.

#include <gtest/gtest.h>

#include "supervisor/htn/plan/validate.h"
#include "supervisor/htn/search/search.h"
#include "supervisor/htn/task/read_task.h"
#include "tests/unit/supervisor/htn/search/random_htn.h"

namespace stepwright::htn::test {
namespace {

constexpr int kRounds = 10'000;
constexpr std::size_t kMostPending = 6;
constexpr std::size_t kMostSteps = 400;
constexpr std::size_t kMostPlans = 60;

struct Texts {
  lisp::Source domain;
  lisp::Source problem;
};

Texts texts_of(const RandomHtn& htn) {
  return {{"domain.hddl", domain_text(htn)}, {"problem.hddl", problem_text(htn)}};
}

Sequence sequence_of(const Plan& plan) {
  Sequence actions;
  for (const std::size_t step : plan.steps) {
    std::string text = to_string(plan.nodes[step]);
    actions.push_back(text.substr(1, text.size() - 2));
  }
  return actions;
}

SearchOptions bounded() {
  SearchOptions options;
  options.most_pending = static_cast<int>(kMostPending);
  return options;
}

TEST(RandomHtn, WhenSolved_ThenABruteForceFindsTheSame) {
  std::mt19937 random(20261128);
  int solvable = 0, infeasible = 0, bounds = 0, enumerated = 0;
  for (int round = 0; round < kRounds; ++round) {
    const RandomHtn htn = random_htn(random);
    const BruteForce truth = explore(htn, kMostPending);
    if (!truth.complete) continue;
    const Texts texts = texts_of(htn);
    const auto read = read_task(texts.domain, texts.problem);
    ASSERT_TRUE(read) << result::to_string(read.error()) << texts.domain.text;
    Search search(read->task, bounded());
    SearchOutcome outcome = search.next();
    const bool solved = outcome.kind == model::OutcomeKind::Solved;
    ASSERT_EQ(solved, truth.solvable) << round << texts.domain.text << texts.problem.text << outcome.reason;
    solvable += solved ? 1 : 0;
    bounds += outcome.kind == model::OutcomeKind::Exhausted ? 1 : 0;
    infeasible += outcome.kind == model::OutcomeKind::Infeasible ? 1 : 0;
    if (!solved && !truth.cut) {
      ASSERT_EQ(outcome.kind, model::OutcomeKind::Infeasible) << round;
    }
    if (!solved) continue;
    const Validation judged = validate(texts.domain, texts.problem, *outcome.plan);
    ASSERT_TRUE(judged.valid) << round << judged.reason << texts.domain.text << texts.problem.text;
    const Enumeration all = enumerate(htn, kMostPending, kMostSteps);
    if (!all.complete || all.plans.size() > kMostPlans) continue;
    std::set<Sequence> found;
    for (; outcome.kind == model::OutcomeKind::Solved; outcome = search.next())
      found.insert(sequence_of(*outcome.plan));
    ASSERT_EQ(found, all.plans) << round << texts.domain.text << texts.problem.text;
    ++enumerated;
  }
  std::cout << solvable << " solvable, " << infeasible << " proved infeasible, " << bounds
            << " at the bound, all plans of " << enumerated << "\n";
  EXPECT_GT(solvable, kRounds / 5);
  EXPECT_GT(infeasible, kRounds / 5);
  EXPECT_GT(bounds, kRounds / 100);
  EXPECT_GT(enumerated, kRounds / 10);
}

std::uint64_t hash_of(const Sequence& prefix) {
  std::uint64_t hash = 7;
  for (const std::string& action : prefix)
    for (const char c : action + ",") hash = scramble(hash ^ static_cast<unsigned char>(c));
  return hash;
}

// A quarter of all prefixes are bad, and so is what is longer than five.
bool is_good(const Sequence& prefix) {
  return prefix.size() < 6 && hash_of(prefix) % 4 != 0;
}

// Half of the bad ones only seem so for want of time.
bool is_good_in_time(const Sequence& prefix) {
  return is_good(prefix) || (prefix.size() < 6 && hash_of(prefix) % 8 == 0);
}

// Finds a bad prefix only when one more action is to follow it, or at the end.
class LateJudge : public SemanticAttachment {
 public:
  explicit LateJudge(const PlanningTask& task) : task_(task) {}

  void take_time() { hurried_ = false; }
  void push(const ExternalCall& action) override {
    std::string text = task_.actions[static_cast<std::size_t>(action.symbol)].name;
    for (const int object : action.objects)
      text += " " + task_.objects[static_cast<std::size_t>(object)].name;
    const Fingerprint before = prints_.empty() ? Fingerprint{} : prints_.back();
    std::uint64_t number = 1;
    for (const char c : text) number = scramble(number ^ static_cast<unsigned char>(c));
    prints_.push_back(followed_by(before, number));
    prefix_.push_back(std::move(text));
    acting_ = true;
  }
  void pop() override {
    prefix_.pop_back();
    prints_.pop_back();
    acting_ = false;
  }
  std::optional<Refusal> require(const ExternalCall&, bool) override {
    // An action asks before it counts; the goal asks of all.
    Sequence prefix = prefix_;
    if (acting_) prefix.pop_back();
    acting_ = false;
    if (prefix.empty() || (hurried_ ? is_good(prefix) : is_good_in_time(prefix))) return std::nullopt;
    return Refusal{prefix.size() - 1, !is_good_in_time(prefix), ""};
  }
  std::optional<Refusal> change(const ExternalCall&, bool) override { return std::nullopt; }
  std::optional<Fingerprint> fingerprint() const override {
    return prints_.empty() ? Fingerprint{} : prints_.back();
  }

 private:
  const PlanningTask& task_;
  Sequence prefix_;
  std::vector<Fingerprint> prints_;
  bool acting_ = false;  // an action was pushed and has not asked yet
  bool hurried_ = true;
};

std::set<Sequence> all_plans(Search& search, model::OutcomeKind& end) {
  std::set<Sequence> found;
  SearchOutcome outcome = search.next();
  for (; outcome.kind == model::OutcomeKind::Solved; outcome = search.next())
    found.insert(sequence_of(*outcome.plan));
  end = outcome.kind;
  return found;
}

TEST(RandomHtn, WhenPrefixesAreRefusedLate_ThenTheSearchGoesBackAndMissesNothing) {
  std::mt19937 random(20261129);
  int compared = 0, with_plans = 0;
  std::uint64_t backjumps = 0;
  for (int round = 0; round < kRounds / 2; ++round) {
    RandomHtn htn = random_htn(random);
    htn.external = true;
    const Enumeration all = enumerate(htn, kMostPending, kMostSteps, is_good);
    if (!all.complete || all.plans.size() > kMostPlans) continue;
    const Texts texts = texts_of(htn);
    const auto read = read_task(texts.domain, texts.problem, {"outside"});
    ASSERT_TRUE(read) << result::to_string(read.error()) << texts.domain.text;
    LateJudge judge(read->task);
    std::set<Sequence> found;
    Search search(read->task, bounded(), &judge);
    SearchOutcome outcome = search.next();
    for (; outcome.kind == model::OutcomeKind::Solved; outcome = search.next()) {
      const Validation judged = validate(texts.domain, texts.problem, *outcome.plan, {"outside"});
      ASSERT_TRUE(judged.valid) << round << judged.reason;
      found.insert(sequence_of(*outcome.plan));
    }
    ASSERT_EQ(found, all.plans) << round << texts.domain.text << texts.problem.text;
    ++compared;
    with_plans += found.empty() ? 0 : 1;
    backjumps += search.statistics().backjumps;
  }
  std::cout << compared << " compared, " << with_plans << " with plans, " << backjumps << " backjumps\n";
  EXPECT_GT(compared, kRounds / 5);
  EXPECT_GT(with_plans, kRounds / 50);
  EXPECT_GT(backjumps, 100u);
}

TEST(RandomHtn, WhenRefusalsWereNotProven_ThenTheSearchFindsTheRestWhenItBeginsAnew) {
  std::mt19937 random(20261201);
  int compared = 0, exhausted = 0, more = 0;
  for (int round = 0; round < kRounds / 4; ++round) {
    RandomHtn htn = random_htn(random);
    htn.external = true;
    const Enumeration hurried = enumerate(htn, kMostPending, kMostSteps, is_good);
    const Enumeration in_time = enumerate(htn, kMostPending, kMostSteps, is_good_in_time);
    if (!in_time.complete || in_time.plans.size() > kMostPlans) continue;
    const Texts texts = texts_of(htn);
    const auto read = read_task(texts.domain, texts.problem, {"outside"});
    ASSERT_TRUE(read) << result::to_string(read.error());
    LateJudge judge(read->task);
    Search search(read->task, bounded(), &judge);
    model::OutcomeKind end{};
    std::set<Sequence> found = all_plans(search, end);
    ASSERT_EQ(found, hurried.plans) << round;
    // Without a proof nobody may say that there is no further plan.
    if (in_time.plans != hurried.plans) {
      ASSERT_EQ(end, model::OutcomeKind::Exhausted) << round;
    }
    exhausted += end == model::OutcomeKind::Exhausted ? 1 : 0;
    judge.take_time();
    search.retry_unproven();
    const std::set<Sequence> later = all_plans(search, end);
    more += later.empty() ? 0 : 1;
    found.insert(later.begin(), later.end());
    ASSERT_EQ(found, in_time.plans) << round << texts.domain.text << texts.problem.text;
    ++compared;
  }
  EXPECT_GT(compared, kRounds / 10);
  EXPECT_GT(exhausted, kRounds / 100);
  EXPECT_GT(more, kRounds / 200);
}

// The caller refuses complete plans, without an attachment.
TEST(RandomHtn, WhenPlansAreRejectedFromOutside_ThenTheOthersAreFound) {
  std::mt19937 random(20261130);
  int compared = 0;
  for (int round = 0; round < kRounds / 4; ++round) {
    const RandomHtn htn = random_htn(random);
    const Enumeration every = enumerate(htn, kMostPending, kMostSteps);
    if (!every.complete || every.plans.empty() || every.plans.size() > kMostPlans) continue;
    const Texts texts = texts_of(htn);
    const auto read = read_task(texts.domain, texts.problem);
    ASSERT_TRUE(read) << result::to_string(read.error());
    Search search(read->task, bounded());
    std::set<Sequence> good, accepted;
    const auto first_bad = [](const Sequence& plan) {
      std::size_t count = 1;
      while (count <= plan.size() &&
             is_good({plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(count)}))
        ++count;
      return count - 1;  // actions that may stay
    };
    for (const Sequence& plan : every.plans)
      if (first_bad(plan) == plan.size()) good.insert(plan);
    for (SearchOutcome outcome = search.next(); outcome.kind == model::OutcomeKind::Solved;
         outcome = search.next()) {
      const Sequence plan = sequence_of(*outcome.plan);
      const std::size_t keep = first_bad(plan);
      if (keep < plan.size()) {
        search.reject(keep, true);
      } else {
        accepted.insert(plan);
      }
    }
    ASSERT_EQ(accepted, good) << round << texts.domain.text << texts.problem.text;
    ++compared;
  }
  EXPECT_GT(compared, kRounds / 40);
}

}  // namespace
}  // namespace stepwright::htn::test
