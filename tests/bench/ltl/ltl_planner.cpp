#include "tests/bench/ltl/ltl_planner.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/planners/ltl/LTLPlanner.h>
#include <ompl/control/planners/ltl/LTLProblemDefinition.h>
#include <ompl/control/planners/ltl/LTLSpaceInformation.h>
#include <ompl/control/planners/ltl/PropositionalDecomposition.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <vector>

#include "supervisor/geometry/box.h"
#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/train/train_motion.h"
#include "supervisor/ltl/train/walls.h"

namespace stepwright::bench {

namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
using geometry::Point;

constexpr double kStep_s = 0.1;  // of propagation, between two looks
constexpr unsigned kMostSteps = 20;
constexpr double kSwell_m = 0.05;  // as ours

const double* values(const ob::State* state) {
  return state->as<ob::RealVectorStateSpace::StateType>()->values;
}

double* values(ob::State* state) {
  return state->as<ob::RealVectorStateSpace::StateType>()->values;
}

ltl::TrainState train_state(const ltl::TrainModel& model, const ob::State* state) {
  ltl::TrainState at{};
  for (std::size_t k = 0; k < model.states(); ++k) at[k] = values(state)[k];
  return at;
}

ltl::TrainControl control_of(const oc::Control* control) {
  const double* const both = control->as<oc::RealVectorControlSpace::ControlType>()->values;
  return {both[0], both[1]};
}

ob::RealVectorBounds floor_bounds(const ltl::RegionMap& map) {
  const geometry::Box box = geometry::bounds_of(map.points());
  ob::RealVectorBounds bounds(2);
  bounds.low = {box.low.x_m, box.low.y_m};
  bounds.high = {box.high.x_m, box.high.y_m};
  return bounds;
}

class Triangles final : public oc::Decomposition {
 public:
  explicit Triangles(const ltl::RegionMap& map) : Decomposition(2, floor_bounds(map)), map_(map) {}

  int getNumRegions() const override { return static_cast<int>(map_.regions().size()); }
  double getRegionVolume(int region) override {
    const auto at = static_cast<std::uint32_t>(region);
    const Point a = map_.corner(at, 0);
    return 0.5 * cross(map_.corner(at, 1) - a, map_.corner(at, 2) - a);
  }
  // Of a state outside of the free floor, which is no valid one, any region.
  int locateRegion(const ob::State* state) const override {
    const std::uint32_t region = map_.locate({values(state)[0], values(state)[1]});
    return region == ltl::kNoRegion ? 0 : static_cast<int>(region);
  }
  void project(const ob::State* state, std::vector<double>& at) const override {
    at = {values(state)[0], values(state)[1]};
  }
  void getNeighbors(int region, std::vector<int>& neighbours) const override {
    for (const std::uint32_t each : map_.region(static_cast<std::uint32_t>(region)).across)
      if (each != ltl::kNoRegion) neighbours.push_back(static_cast<int>(each));
  }
  void sampleFromRegion(int region, ompl::RNG& dice, std::vector<double>& at) const override {
    const auto index = static_cast<std::uint32_t>(region);
    double u = dice.uniform01(), v = dice.uniform01();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Point a = map_.corner(index, 0);
    const Point there = a + u * (map_.corner(index, 1) - a) + v * (map_.corner(index, 2) - a);
    at = {there.x_m, there.y_m};
  }
  void sampleFullState(const ob::StateSamplerPtr& sampler, const std::vector<double>& at,
                       ob::State* state) const override {
    sampler->sampleUniform(state);
    values(state)[0] = at[0];
    values(state)[1] = at[1];
  }

 private:
  const ltl::RegionMap& map_;
};

oc::World world_of(ltl::Label label, std::size_t count) {
  oc::World world(static_cast<unsigned>(count));
  for (std::size_t k = 0; k < count; ++k) world[static_cast<unsigned>(k)] = (label >> k & 1) != 0;
  return world;
}

class LabelledTriangles final : public oc::PropositionalDecomposition {
 public:
  LabelledTriangles(const ltl::RegionMap& map, std::size_t places)
      : PropositionalDecomposition(std::make_shared<Triangles>(map)), map_(map), places_(places) {}

  oc::World worldAtRegion(int region) override {
    return world_of(map_.region(static_cast<std::uint32_t>(region)).label, places_);
  }
  int getNumProps() const override { return static_cast<int>(places_); }

 private:
  const ltl::RegionMap& map_;
  std::size_t places_;
};

// The same states; transitions by the labels that the floor has, none to where the task has failed.
oc::AutomatonPtr automaton_of(const ltl::Automaton& from, const ltl::RegionMap& map, std::size_t places) {
  std::set<ltl::Label> labels;
  for (const ltl::Region& region : map.regions()) labels.insert(region.label);
  auto made =
      std::make_shared<oc::Automaton>(static_cast<unsigned>(places), static_cast<unsigned>(from.size()));
  made->setStartState(from.initial);
  for (std::uint32_t state = 0; state < from.size(); ++state) {
    made->setAccepting(state, from.accepting(state));
    for (const ltl::Label label : labels) {
      const std::uint32_t next = from.next(state, label);
      if (!from.rejecting(next)) made->addTransition(state, world_of(label, places), next);
    }
  }
  return made;
}

oc::SpaceInformationPtr space_of(const ltl::Problem& problem, const ltl::RegionMap& map,
                                 const ltl::TrainModel& wide, const ltl::Walls& walls) {
  const ltl::TrainModel& model = problem.train;
  auto space = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(model.states()));
  ob::RealVectorBounds bounds(static_cast<unsigned>(model.states()));
  const ob::RealVectorBounds floor = floor_bounds(map);
  bounds.setLow(-std::numbers::pi);
  bounds.setHigh(std::numbers::pi);
  for (unsigned k = 0; k < 2; ++k) bounds.setLow(k, floor.low[k]), bounds.setHigh(k, floor.high[k]);
  bounds.setLow(3, -model.most_speed_m_s), bounds.setHigh(3, model.most_speed_m_s);
  bounds.setLow(4, -model.most_lock_rad), bounds.setHigh(4, model.most_lock_rad);
  space->setBounds(bounds);
  auto controls = std::make_shared<oc::RealVectorControlSpace>(space, 2);
  ob::RealVectorBounds limits(2);
  limits.low = {-model.most_acceleration_m_s2, -model.most_lock_rate_rad_s};
  limits.high = {model.most_acceleration_m_s2, model.most_lock_rate_rad_s};
  controls->setBounds(limits);
  auto information = std::make_shared<oc::SpaceInformation>(space, controls);
  information->setStateValidityChecker([&](const ob::State* state) {
    if (map.locate({values(state)[0], values(state)[1]}) == ltl::kNoRegion) return false;
    const ltl::LinkBoxes boxes = ltl::link_boxes(wide, train_state(wide, state));
    return !walls.meet(boxes, wide.links()) && !ltl::meets_itself(wide, boxes);
  });
  information->setStatePropagator(
      [&model](const ob::State* from, const oc::Control* control, double duration_s, ob::State* to) {
        ltl::TrainMotion motion(model);
        ltl::TrainState at = train_state(model, from);
        for (double left_s = duration_s; left_s > 1e-9;)
          left_s -= motion.step(at, control_of(control), left_s);
        for (std::size_t k = 0; k < model.states(); ++k) values(to)[k] = at[k];
      });
  information->setPropagationStepSize(kStep_s);
  information->setMinMaxControlDuration(1, kMostSteps);
  information->setup();
  return information;
}

// A piece ends where a limit is met, too.
ltl::TrainPlan plan_of(const ltl::TrainModel& model, oc::PathControl& path) {
  ltl::TrainPlan plan;
  plan.start = train_state(model, path.getState(0));
  ltl::TrainMotion motion(model);
  ltl::TrainState at = plan.start;
  for (std::size_t k = 0; k < path.getControlCount(); ++k) {
    const ltl::TrainControl wanted = control_of(path.getControl(static_cast<unsigned>(k)));
    ltl::TrainControl used = motion.within_limits(at, wanted);
    double piece_s = 0.0;
    for (double left_s = path.getControlDuration(static_cast<unsigned>(k)); left_s > 1e-9;) {
      const Point before{at[0], at[1]};
      const double step_s = motion.step(at, used, left_s);
      plan.length_m += geometry::distance(before, {at[0], at[1]});
      left_s -= step_s;
      piece_s += step_s;
      const ltl::TrainControl held = motion.within_limits(at, wanted);
      if (held == used) continue;
      plan.pieces.push_back({used, piece_s});
      piece_s = 0.0;
      used = held;
    }
    if (piece_s > 0.0) plan.pieces.push_back({used, piece_s});
  }
  plan.end = at;
  return plan;
}

}  // namespace

void seed_ompl(std::uint32_t seed) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(seed);
}

OmplAnswer plan_by_ltlplanner(const ltl::Problem& problem, double explore_s, double most_s) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  const auto spent_s = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
  OmplAnswer answer;
  const auto map = ltl::make_regions(problem.floor);
  const auto task =
      ltl::read_task(problem.task, problem.places(), "task", {.acceptance = ltl::Acceptance::Strong});
  if (!map || !task) return answer;
  const std::size_t places = problem.floor.propositions.size();
  ltl::TrainModel wide = problem.train;
  wide.length_m += kSwell_m;
  wide.width_m += kSwell_m;
  const ltl::Walls walls(problem.floor, wide);
  const auto space = space_of(problem, *map, wide, walls);
  const auto product = std::make_shared<oc::ProductGraph>(std::make_shared<LabelledTriangles>(*map, places),
                                                          automaton_of(task->automaton, *map, places));
  const auto information = std::make_shared<oc::LTLSpaceInformation>(space, product);
  const auto definition = std::make_shared<oc::LTLProblemDefinition>(information);
  const ltl::TrainState start = ltl::standing_at(problem.train, problem.start);
  ob::ScopedState<> first(space);
  for (std::size_t k = 0; k < problem.train.states(); ++k) values(first.get())[k] = start[k];
  definition->addLowerStartState(first.get());
  oc::LTLPlanner planner(information, product, explore_s);
  planner.setProblemDefinition(definition);
  planner.setup();
  const ob::PlannerStatus status = planner.ob::Planner::solve(most_s - spent_s());
  if (status == ob::PlannerStatus::EXACT_SOLUTION) {
    const ob::PathPtr path = definition->getLowerSolutionPath();
    answer.plan = plan_of(problem.train, *path->as<oc::PathControl>());
    answer.judgement = ltl::judge_plan(problem.floor, problem.train, start, task->formula, *answer.plan);
  }
  answer.spent_s = spent_s();
  return answer;
}

}  // namespace stepwright::bench
