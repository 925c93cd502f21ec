#include "supervisor/motion/problem/plan_arm.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "supervisor/motion/ompl/ompl_planner.h"
#include "supervisor/motion/problem/arm_checkers.h"
#include "supervisor/motion/robot/codes.h"

namespace stepwright::motion {

namespace {

using Clock = std::chrono::steady_clock;

double since_ms(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

class ArmPlanner {
 public:
  ArmPlanner(const FreeSpace& fast, const FreeSpace& careful, const ExactChecker& exact,
             const JointSpace& space, std::vector<Configuration> goals, const ArmProblem& problem,
             const ArmOptions& options)
      : fast_(fast),
        careful_(careful),
        exact_(exact),
        space_(space),
        goals_(std::move(goals)),
        problem_(problem),
        options_(options),
        until_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(std::min(options.seconds, 1e6)))) {}

  result::Result<ArmAnswer> plan(ArmAnswer answer) {
    const auto begin = Clock::now();
    const bool own = options_.planner == kOwnPlanner;
    // A round of ours that gave up has tried much; others may be luckier.
    for (std::uint64_t round = 0; answer.path.empty() && (round == 0 || time_is_left()); ++round) {
      if (own) {
        by_ours(answer, round);
      } else if (auto done = by_ompl(answer, round); !done) {
        return result::forward(done);
      }
    }
    answer.planning_ms = since_ms(begin) - answer.recheck_ms;
    if (answer.path.empty()) {
      answer.cause = refused_ ? "paths were refused by the bodies: '" + refused_->contact.link + "' meets '" +
                                    refused_->contact.other + "'"
                              : "no path was found in its time";
      return answer;
    }
    answer.ending = ArmAnswer::Ending::Found;
    answer.length = joint_length(answer.path);
    return answer;
  }

 private:
  bool time_is_left() const {
    return Clock::now() < until_ && !(options_.cancel != nullptr && options_.cancel->load());
  }

  void by_ours(ArmAnswer& answer, std::uint64_t round) {
    const CertainPath found = plan_certain_path(fast_, exact_, space_, problem_.from, goals_,
                                                {.seed = options_.seed + 1000 * round, .step = options_.step},
                                                {.careful = &careful_});
    answer.rounds += found.rounds;
    answer.refused += found.thrown_away;
    answer.means = found.means;
    if (found.refused) refused_ = found.refused;
    answer.path = found.path;
    const auto begin = Clock::now();
    // Once more, as somebody would who does not trust the planner.
    if (!answer.path.empty() && first_refused(exact_, answer.path)) answer.path.clear();
    answer.recheck_ms += since_ms(begin);
  }

  result::Result<void> by_ompl(ArmAnswer& answer, std::uint64_t round) {
    const bool spheres = fast_.is_free(problem_.from) && fast_.is_free(problem_.to);
    answer.means = spheres ? CertainPath::Means::BySpheres : CertainPath::Means::ByBodies;
    const FreeSpace free = !spheres ? by_spheres_or_bodies(fast_, exact_) : refused_ ? careful_ : fast_;
    const double left_s = std::chrono::duration<double>(until_ - Clock::now()).count();
    const double step = options_.step / static_cast<double>(1ULL << std::min<std::uint64_t>(round, 6));
    auto found =
        plan_by_ompl(options_.planner, free, space_, problem_.from, goals_,
                     {.seed = options_.seed + round, .seconds = std::max(left_s, 1e-3), .step = step});
    if (!found) return result::forward(found);
    ++answer.rounds;
    if (found->path.empty()) return {};
    JointPath path = shorten(free, std::move(found->path), {.seed = options_.seed, .step = step});
    const auto begin = Clock::now();
    if (auto refused = first_refused(exact_, path)) {
      ++answer.refused;
      refused_ = std::move(refused);
      path.clear();
    }
    answer.recheck_ms += since_ms(begin);
    answer.path = std::move(path);
    return {};
  }

  const FreeSpace& fast_;
  const FreeSpace& careful_;
  const ExactChecker& exact_;
  const JointSpace& space_;
  std::vector<Configuration> goals_;
  const ArmProblem& problem_;
  const ArmOptions& options_;
  Clock::time_point until_;
  std::optional<MotionVerdict> refused_;
};

struct Ways {
  JointSpace space;
  std::vector<Configuration> goals;  // the nearest first
};

// A joint without ends may go either way round, from wherever it is.
Ways ways_of(const Robot& robot, const ArmProblem& problem) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr std::size_t kMostGoals = 8;
  Ways ways{joint_space(robot, problem.coordinates), {problem.to}};
  for (std::size_t k = 0; k < problem.coordinates.size(); ++k) {
    if (!std::isinf(robot.coordinates[static_cast<std::size_t>(problem.coordinates[k])].upper)) continue;
    ways.space.lower[k] = problem.from[k] - kTurn;
    ways.space.upper[k] = problem.from[k] + kTurn;
    for (std::size_t g = 0, count = ways.goals.size(); g < count && ways.goals.size() < kMostGoals; ++g) {
      ways.goals.push_back(ways.goals[g]);
      ways.goals.back()[k] -= std::copysign(kTurn, problem.to[k] - problem.from[k]);
    }
  }
  return ways;
}

std::string name_pair(const Robot& robot, std::pair<int, int> pair) {
  return "'" + robot.links[static_cast<std::size_t>(pair.first)].name + "' and '" +
         robot.links[static_cast<std::size_t>(pair.second)].name + "'";
}

void tell_pairs(const Robot& robot, const FalsePairs& found, result::Diagnostics& notes) {
  const auto note = [&](std::string message, std::string hint) {
    notes.push_back({code::kNoSpheres, result::Severity::Warning, {}, std::move(message), std::move(hint)});
  };
  for (const auto& each : found.pairs)
    note("spheres of the links " + name_pair(robot, each) + " often overlap; their bodies do not",
         "their bodies are asked; less --protrusion, or a disabled pair of SRDF");
  for (const auto& each : found.always)
    note("the links " + name_pair(robot, each) + " meet wherever they are", "SRDF disables such pairs");
}

}  // namespace

result::Result<ArmAnswer> plan_arm(const ArmModel& model, const ArmProblem& problem,
                                   const ArmOptions& options) {
  if (options.planner != kOwnPlanner && !ompl_planner(options.planner))
    return tl::unexpected(no_such_planner(options.planner, {kOwnPlanner}));
  const FalsePairs pairs = pairs_of(model, problem);
  ArmAnswer answer;
  tell_pairs(model.robot, pairs, answer.notes);
  const auto checkers = ArmCheckers::make(model, problem, pairs);
  if (!checkers) return tl::unexpected(checkers.error());
  auto exact = ExactChecker::make(model.robot, model.bodies, problem.known_pairs(), problem.world,
                                  problem.coordinates, problem.rest, &model.spheres, problem.attached);
  if (!exact) return result::forward(exact);
  for (const auto& [name, end] : {std::pair("start", &problem.from), std::pair("goal", &problem.to)}) {
    const std::string beyond = beyond_limits(model, problem, *end);
    const auto contact = beyond.empty() ? exact->contact(*end) : std::nullopt;
    if (beyond.empty() && !contact) continue;
    answer.ending = ArmAnswer::Ending::Impossible;
    answer.cause = "the " + std::string(name) +
                   (contact ? " collides: '" + contact->link + "' meets '" + contact->other + "'"
                            : " is beyond a limit: " + beyond);
    return answer;
  }
  const Ways ways = ways_of(model.robot, problem);
  const FreeSpace fast = checkers->fast(), careful = checkers->careful();
  return ArmPlanner(fast, careful, *exact, ways.space, ways.goals, problem, options).plan(std::move(answer));
}

}  // namespace stepwright::motion
