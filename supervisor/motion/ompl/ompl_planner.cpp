#include "supervisor/motion/ompl/ompl_planner.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/cforest/CForest.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/prm/SPARS.h>
#include <ompl/geometric/planners/prm/SPARStwo.h>
#include <ompl/geometric/planners/rlrt/BiRLRT.h>
#include <ompl/geometric/planners/rlrt/RLRT.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/rrt/pRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/sbl/pSBL.h>
#include <ompl/geometric/planners/sst/SST.h>
#include <ompl/geometric/planners/stride/STRIDE.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <mutex>
#include <utility>

namespace stepwright::motion {

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using SpaceInformationPtr = std::shared_ptr<ob::SpaceInformation>;

template <typename Planner>
ob::PlannerPtr make(const SpaceInformationPtr& information) {
  return std::make_shared<Planner>(information);
}

using Maker = ob::PlannerPtr (*)(const SpaceInformationPtr&);

const std::vector<std::pair<std::string_view, Maker>>& makers() {
  static const std::vector<std::pair<std::string_view, Maker>> all{
      {"RRTConnect", make<og::RRTConnect>},
      {"RRT", make<og::RRT>},
      {"RRTstar", make<og::RRTstar>},
      {"InformedRRTstar", make<og::InformedRRTstar>},
      {"SORRTstar", make<og::SORRTstar>},
      {"RRTsharp", make<og::RRTsharp>},
      {"RRTXstatic", make<og::RRTXstatic>},
      {"LBTRRT", make<og::LBTRRT>},
      {"LazyRRT", make<og::LazyRRT>},
      {"TRRT", make<og::TRRT>},
      {"BiTRRT", make<og::BiTRRT>},
      {"pRRT", make<og::pRRT>},
      {"EST", make<og::EST>},
      {"BiEST", make<og::BiEST>},
      {"ProjEST", make<og::ProjEST>},
      {"KPIECE1", make<og::KPIECE1>},
      {"BKPIECE1", make<og::BKPIECE1>},
      {"LBKPIECE1", make<og::LBKPIECE1>},
      {"SBL", make<og::SBL>},
      {"pSBL", make<og::pSBL>},
      {"PDST", make<og::PDST>},
      {"STRIDE", make<og::STRIDE>},
      {"SST", make<og::SST>},
      {"RLRT", make<og::RLRT>},
      {"BiRLRT", make<og::BiRLRT>},
      {"PRM", make<og::PRM>},
      {"PRMstar", make<og::PRMstar>},
      {"LazyPRM", make<og::LazyPRM>},
      {"LazyPRMstar", make<og::LazyPRMstar>},
      {"SPARS", make<og::SPARS>},
      {"SPARStwo", make<og::SPARStwo>},
      {"FMT", make<og::FMT>},
      {"BFMT", make<og::BFMT>},
      {"BITstar", make<og::BITstar>},
      {"ABITstar", make<og::ABITstar>},
      {"AITstar", make<og::AITstar>},
      {"CForest", make<og::CForest>},
      {"AnytimePathShortening", make<og::AnytimePathShortening>}};
  return all;
}

class Motions : public ob::MotionValidator {
 public:
  Motions(const SpaceInformationPtr& information, const FreeSpace& free, const OmplOptions& options,
          std::atomic<std::size_t>& checks, std::atomic<std::size_t>& motions)
      : ob::MotionValidator(information),
        free_(free),
        options_(options),
        columns_(information->getStateDimension()),
        checks_(checks),
        motions_(motions) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    count();
    if (options_.whole_motions) return free_.motion_is_free(numbers(from), numbers(to), options_.step);
    return places_free(numbers(from), numbers(to), nullptr);
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last) const override {
    count();
    double share = 1.0;
    if (places_free(numbers(from), numbers(to), &share)) return true;
    last.second = share;
    if (last.first != nullptr) si_->getStateSpace()->interpolate(from, to, share, last.first);
    return false;
  }

 private:
  void count() const {
    ++checks_;
    ++motions_;
  }

  std::span<const double> numbers(const ob::State* state) const {
    return {state->as<ob::RealVectorStateSpace::StateType>()->values, columns_};
  }

  // One place after the other; without `last_free` from the middle to both sides, as OMPL does.
  bool places_free(std::span<const double> from, std::span<const double> to, double* last_free) const {
    double farthest = 0.0;
    for (std::size_t k = 0; k < columns_; ++k) farthest = std::max(farthest, std::abs(to[k] - from[k]));
    const auto steps = static_cast<std::size_t>(std::ceil(farthest / options_.step));
    Configuration q(columns_);
    const auto place_is_free = [&](std::size_t step) {
      const double share = static_cast<double>(step) / static_cast<double>(steps);
      for (std::size_t k = 0; k < columns_; ++k)
        q[k] = step == steps ? to[k] : from[k] + share * (to[k] - from[k]);
      return free_.is_free(q);
    };
    if (last_free != nullptr) {
      for (std::size_t step = 1; step <= steps; ++step)
        if (!place_is_free(step)) {
          *last_free = static_cast<double>(step - 1) / static_cast<double>(steps);
          return false;
        }
      return true;
    }
    if (steps == 0) return true;  // its beginning is free
    if (!place_is_free(steps)) return false;
    std::vector<std::pair<std::size_t, std::size_t>> open{{1, steps}};  // places from, up to and without
    for (std::size_t k = 0; k < open.size(); ++k) {
      const auto [first, end] = open[k];
      if (first >= end) continue;
      const std::size_t middle = (first + end) / 2;
      if (!place_is_free(middle)) return false;
      open.emplace_back(first, middle);
      open.emplace_back(middle + 1, end);
    }
    return true;
  }

  const FreeSpace& free_;
  const OmplOptions& options_;
  std::size_t columns_;
  std::atomic<std::size_t>& checks_;
  std::atomic<std::size_t>& motions_;
};

// Of spaces of one or two joints themselves: OMPL's own evaluator for them ends the process by an assertion.
class AllCoordinates : public ob::ProjectionEvaluator {
 public:
  explicit AllCoordinates(const ob::RealVectorStateSpace* space)
      : ob::ProjectionEvaluator(space), numbers_(space) {}

  unsigned getDimension() const override { return numbers_->getDimension(); }
  void defaultCellSizes() override {
    constexpr double kCells = 20.0;
    cellSizes_.resize(getDimension());
    bounds_ = numbers_->getBounds();
    for (unsigned k = 0; k < getDimension(); ++k)
      cellSizes_[k] = std::max(1e-9, (bounds_.high[k] - bounds_.low[k]) / kCells);
  }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    for (unsigned k = 0; k < getDimension(); ++k)
      projection(k) = state->as<ob::RealVectorStateSpace::StateType>()->values[k];
  }

 private:
  const ob::RealVectorStateSpace* numbers_;
};

class OmplProblem {
 public:
  OmplProblem(const FreeSpace& free, const JointSpace& space, const OmplOptions& options)
      : columns_(space.lower.size()) {
    auto numbers = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(columns_));
    ob::RealVectorBounds bounds(static_cast<unsigned>(columns_));
    bounds.low = space.lower;
    bounds.high = space.upper;
    numbers->setBounds(bounds);
    information_ = std::make_shared<ob::SpaceInformation>(std::move(numbers));
    information_->setStateValidityChecker([this, &free](const ob::State* state) {
      ++checks;
      return free.is_free({state->as<ob::RealVectorStateSpace::StateType>()->values, columns_});
    });
    information_->setMotionValidator(std::make_shared<Motions>(information_, free, options, checks, motions));
    information_->setup();  // registers OMPL's projections
    constexpr std::size_t kFew = 2;
    if (columns_ <= kFew)
      information_->getStateSpace()->registerDefaultProjection(
          std::make_shared<AllCoordinates>(information_->getStateSpace()->as<ob::RealVectorStateSpace>()));
    definition_ = std::make_shared<ob::ProblemDefinition>(information_);
  }

  void set_ends(const JointSpace& space, const Configuration& from, const std::vector<Configuration>& goals) {
    const auto state_of = [&](const Configuration& q) {
      ob::ScopedState<> state(information_);
      for (std::size_t k = 0; k < columns_; ++k)
        state->as<ob::RealVectorStateSpace::StateType>()->values[k] =
            std::clamp(q[k], space.lower[k], space.upper[k]);
      return state;
    };
    definition_->addStartState(state_of(from));
    auto all = std::make_shared<ob::GoalStates>(information_);
    for (const Configuration& each : goals) all->addState(state_of(each));
    definition_->setGoal(all);
  }

  JointPath solve(const Maker& maker, const OmplOptions& options) {
    const ob::PlannerPtr planner = maker(information_);
    if (options.range > 0.0 && planner->params().hasParam("range")) {
      char text[32];
      std::snprintf(text, sizeof text, "%.9g", options.range);
      planner->params().setParam("range", text);
    }
    planner->setProblemDefinition(definition_);
    planner->setup();
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
    const ob::PlannerTerminationCondition over([this, end, most = options.most_checks] {
      return checks >= most || std::chrono::steady_clock::now() >= end;
    });
    const std::clock_t begin = std::clock();
    const ob::PlannerStatus status = planner->solve(over);
    if (options.solve_ms != nullptr)
      *options.solve_ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (status != ob::PlannerStatus::EXACT_SOLUTION) return {};
    const auto found = std::dynamic_pointer_cast<og::PathGeometric>(definition_->getSolutionPath());
    JointPath path;
    if (found == nullptr) return path;
    for (const ob::State* each : found->getStates()) {
      const double* const values = each->as<ob::RealVectorStateSpace::StateType>()->values;
      path.emplace_back(values, values + columns_);
    }
    return path;
  }

  std::atomic<std::size_t> checks{0};   // of places and motions
  std::atomic<std::size_t> motions{0};  // of motions

 private:
  std::size_t columns_;
  SpaceInformationPtr information_;
  ob::ProblemDefinitionPtr definition_;
};

}  // namespace

result::Result<PathAnswer> plan_by_ompl(std::string_view planner, const FreeSpace& free,
                                        const JointSpace& space, const Configuration& from,
                                        const std::vector<Configuration>& goals, const OmplOptions& options) {
  const auto maker =
      std::find_if(makers().begin(), makers().end(), [&](const auto& each) { return each.first == planner; });
  if (maker == makers().end()) return tl::unexpected(no_such_planner(planner));
  PathAnswer answer;
  if (!inside(space, from) || !free.is_free(from)) {
    answer.ending = PathAnswer::Ending::StartCollides;
    return answer;
  }
  std::vector<Configuration> ends;
  for (const Configuration& each : goals)
    if (inside(space, each) && free.is_free(each)) ends.push_back(each);
  if (ends.empty()) {
    answer.ending = PathAnswer::Ending::GoalsCollide;
    return answer;
  }
  // One source of random numbers for the process, and one place where its messages go.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  try {
    ompl::msg::noOutputHandler();
    ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(options.seed % 0xFFFFFFFFU + 1));
    OmplProblem problem(free, space, options);
    problem.set_ends(space, from, ends);
    answer.path = problem.solve(maker->second, options);
    answer.motions = problem.motions;
  } catch (const std::exception& refused) {
    return result::fail(code::kPlannerFailed, {},
                        "OMPL's " + std::string(planner) + " refuses: " + refused.what());
  }
  if (!answer.path.empty()) {
    answer.ending = PathAnswer::Ending::Found;
    // Ends were brought within the limits, by rounding.
    answer.path.front() = from;
    const auto nearest = std::min_element(ends.begin(), ends.end(), [&](const auto& a, const auto& b) {
      return joint_distance(a, answer.path.back()) < joint_distance(b, answer.path.back());
    });
    answer.path.back() = *nearest;
  }
  return answer;
}

}  // namespace stepwright::motion
