#include "tests/bench/ltl/paper_literal.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "supervisor/ltl/guide/guide.h"
#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/scene/places.h"
#include "supervisor/ltl/train/train_motion.h"
#include "supervisor/ltl/train/walls.h"

namespace stepwright::bench {

namespace {

using geometry::Point;
using ltl::kNoRegion;
using ltl::Stage;  // <z, r>
using Clock = std::chrono::steady_clock;

constexpr double kSwell_m = 0.05;       // as ours
constexpr std::size_t kLookEvery = 32;  // iterations, at the clock
constexpr std::uint32_t kNoVertex = 0xFFFF'FFFF;
constexpr std::size_t kMostBytes = std::size_t{1} << 30;  // of the tree

struct Vertex {
  std::uint32_t parent = kNoVertex;
  ltl::TrainControl control;  // from the parent, for so long
  double duration_s = 0.0;
  std::uint32_t z = 0;
  std::uint32_t region = 0;
  ltl::Label label = 0;
};

class Paper {
 public:
  Paper(const ltl::Problem& problem, const ltl::RegionMap& map, const ltl::Task& task,
        const PaperOptions& options)
      : problem_(problem),
        map_(map),
        task_(task),
        automaton_(task.automaton),
        options_(options),
        model_(problem.train),
        wide_(widened(problem.train)),
        walls_(problem.floor, wide_),
        places_(problem.floor.propositions),
        dice_(options.seed),
        of_state_(automaton_.size()),
        regions_of_state_(automaton_.size()),
        of_stage_(automaton_.size() * map.regions().size()),
        active_stamp_(of_stage_.size(), 0),
        cost_m_(of_stage_.size()),
        before_(of_stage_.size()),
        search_stamp_(of_stage_.size(), 0) {
    read_successors();
  }

  void run(Clock::time_point until, PaperAnswer& answer) {
    until_ = until;
    if (!plant(answer)) return;
    while (Clock::now() < until_ && !answer.plan && !full()) {
      ++answer.targets;
      if (!target()) continue;
      plan();
      activate();
      for (std::size_t n = 0; n < options_.iterations && !answer.plan && !full(); ++n) {
        if (n % kLookEvery == kLookEvery - 1 && Clock::now() >= until_) break;
        extend(answer);
      }
    }
    answer.vertices = vertices_.size();
  }

 private:
  static ltl::TrainModel widened(ltl::TrainModel model) {
    model.length_m += kSwell_m;
    model.width_m += kSwell_m;
    return model;
  }

  double chance() { return std::uniform_real_distribution<double>(0.0, 1.0)(dice_); }
  std::size_t draw(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(dice_);
  }
  std::size_t index(Stage at) const { return at.state * map_.regions().size() + at.region; }
  Stage stage(std::size_t index) const {
    const std::size_t regions = map_.regions().size();
    return {static_cast<std::uint32_t>(index % regions), static_cast<std::uint32_t>(index / regions)};
  }
  bool full() const { return vertices_.size() * (sizeof(Vertex) + 8 * model_.states() + 8) > kMostBytes; }

  // delta(z): by the labels that the floor has, without rejecting states and without z itself.
  void read_successors() {
    std::set<ltl::Label> labels;
    for (const ltl::Region& region : map_.regions()) labels.insert(region.label);
    successors_.resize(automaton_.size());
    for (std::uint32_t z = 0; z < automaton_.size(); ++z) {
      std::set<std::uint32_t> found;
      for (const ltl::Label label : labels) found.insert(automaton_.next(z, label));
      for (const std::uint32_t next : found)
        if (next != z && !automaton_.rejecting(next)) successors_[z].push_back(next);
    }
  }

  // The root.
  bool plant(PaperAnswer& answer) {
    const ltl::TrainState start = ltl::standing_at(model_, problem_.start);
    const Point at{start[ltl::kTrainX], start[ltl::kTrainY]};
    const std::uint32_t region = map_.locate(at);
    if (region == kNoRegion || !valid(start)) return false;
    const ltl::Label label = places_.label(at);
    const std::uint32_t z = automaton_.next(automaton_.initial, label);
    if (automaton_.rejecting(z)) return false;
    add({kNoVertex, {}, 0.0, z, region, label}, start);
    if (automaton_.accepting(z)) finish(answer);
    return true;
  }

  bool valid(const ltl::TrainState& state) const {
    const ltl::LinkBoxes boxes = ltl::link_boxes(wide_, state);
    return !walls_.meet(boxes, wide_.links()) && !ltl::meets_itself(wide_, boxes);
  }

  ltl::TrainState state_of(std::uint32_t vertex) const {
    ltl::TrainState state{};
    const std::size_t count = model_.states();
    std::copy_n(states_.begin() + static_cast<std::ptrdiff_t>(vertex * count), count, state.begin());
    return state;
  }

  std::uint32_t add(const Vertex& vertex, const ltl::TrainState& state) {
    const auto number = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(vertex);
    states_.insert(states_.end(), state.begin(),
                   state.begin() + static_cast<std::ptrdiff_t>(model_.states()));
    if (of_state_[vertex.z] == 0) gamma_.push_back(vertex.z);
    ++of_state_[vertex.z];
    auto& same = of_stage_[index({vertex.region, vertex.z})];
    if (same.empty()) regions_of_state_[vertex.z].push_back(vertex.region);
    same.push_back(number);
    return number;
  }

  // DISCRETETARGET (line 3). False where z_from leads nowhere.
  bool target() {
    double sum = 0.0;
    const auto weight = [&](std::uint32_t z) { return std::exp2(1.0 / automaton_.distance[z]); };
    for (const std::uint32_t z : gamma_) sum += weight(z);
    double left = sum * chance();
    from_.state = gamma_.back();
    for (const std::uint32_t z : gamma_) {
      left -= weight(z);
      if (left > 0.0) continue;
      from_.state = z;
      break;
    }
    const auto& regions = regions_of_state_[from_.state];
    from_.region = regions[draw(regions.size())];
    std::vector<std::uint32_t> wanted;
    for (const std::uint32_t z : successors_[from_.state])
      if (of_state_[z] == 0) wanted.push_back(z);
    if (wanted.empty()) wanted = successors_[from_.state];
    if (wanted.empty()) return false;
    to_ = wanted[draw(wanted.size())];
    return true;
  }

  // DISCRETEPLAN (line 4).
  void plan() {
    ++search_;
    plan_.clear();
    if (chance() < options_.shortest)
      shortest();
    else
      at_random();
    if (plan_.empty()) plan_.push_back(from_);
  }

  bool fresh(std::size_t at) const { return search_stamp_[at] != search_; }

  // From the goal back.
  void collect(std::size_t goal) {
    for (std::size_t at = goal;; at = before_[at]) {
      plan_.push_back(stage(at));
      if (before_[at] == at) break;
    }
    std::ranges::reverse(plan_);
  }

  template <typename Visit>
  void each_edge(Stage at, const Visit& visit) const {
    for (const std::uint32_t across : map_.region(at.region).across) {
      if (across == kNoRegion) continue;
      const std::uint32_t z = automaton_.next(at.state, map_.region(across).label);
      if (!automaton_.rejecting(z)) visit(Stage{across, z});
    }
  }

  // Dijkstra's algorithm.
  void shortest() {
    using Open = std::pair<double, std::size_t>;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    const auto reach = [&](std::size_t at, double cost_m, std::size_t before) {
      if (!fresh(at) && cost_m >= cost_m_[at]) return;
      search_stamp_[at] = search_;
      cost_m_[at] = cost_m;
      before_[at] = before;
      open.emplace(cost_m, at);
    };
    reach(index(from_), 0.0, index(from_));
    while (!open.empty()) {
      const auto [cost_m, at] = open.top();
      open.pop();
      if (cost_m > cost_m_[at]) continue;
      const Stage here = stage(at);
      if (here.state == to_) return collect(at);
      const Point middle = map_.centroid(here.region);
      each_edge(here, [&](Stage next) {
        reach(index(next), cost_m + geometry::distance(middle, map_.centroid(next.region)), at);
      });
    }
  }

  // Depth first, the neighbours in any order.
  void at_random() {
    struct Open {
      std::size_t at, before;
    };
    std::vector<Open> open = {{index(from_), index(from_)}};
    std::vector<Stage> next;
    while (!open.empty()) {
      const Open top = open.back();
      open.pop_back();
      if (!fresh(top.at)) continue;
      search_stamp_[top.at] = search_;
      before_[top.at] = top.before;
      const Stage here = stage(top.at);
      if (here.state == to_) return collect(top.at);
      next.clear();
      each_edge(here, [&](Stage each) { next.push_back(each); });
      std::ranges::shuffle(next, dice_);
      for (const Stage each : next)
        if (fresh(index(each))) open.push_back({index(each), top.at});
    }
  }

  // Lines 5 to 9.
  void activate() {
    active_.clear();
    ++activation_;
    for (std::size_t k = plan_.size(); k-- > 0;)
      if (!of_stage_[index(plan_[k])].empty()) make_active(index(plan_[k]));
  }
  void make_active(std::size_t at) {
    if (active_stamp_[at] == activation_) return;
    active_stamp_[at] = activation_;
    active_.push_back(at);
  }

  // Lines 11 to 27.
  void extend(PaperAnswer& answer) {
    const auto& vertices = of_stage_[active_[draw(active_.size())]];
    std::uint32_t v = vertices[draw(vertices.size())];
    const ltl::TrainControl u{(2.0 * chance() - 1.0) * model_.most_acceleration_m_s2,
                              (2.0 * chance() - 1.0) * model_.most_lock_rate_rad_s};
    const std::size_t steps = 1 + draw(options_.steps);
    ltl::TrainMotion motion(model_);
    ltl::TrainState state = state_of(v);
    for (std::size_t n = 0; n < steps; ++n) {
      const Point before{state[ltl::kTrainX], state[ltl::kTrainY]};
      Vertex next{.parent = v, .control = motion.within_limits(state, u)};
      next.duration_s = motion.step(state, next.control, options_.step_s);
      const Point at{state[ltl::kTrainX], state[ltl::kTrainY]};
      next.region = map_.locate(at);
      if (next.region == kNoRegion || !valid(state)) return;
      next.z = vertices_[v].z;
      letters_.clear();
      next.label = places_.read(before, at, vertices_[v].label, letters_);
      for (const ltl::Label letter : letters_) {
        next.z = automaton_.next(next.z, letter);
        if (automaton_.rejecting(next.z)) return;
        if (automaton_.accepting(next.z)) break;
      }
      if (automaton_.accepting(next.z)) {
        vertices_.push_back(next);
        states_.insert(states_.end(), state.begin(),
                       state.begin() + static_cast<std::ptrdiff_t>(model_.states()));
        finish(answer);
        if (answer.plan) return;
        ++answer.refused;
        vertices_.pop_back();
        states_.resize(states_.size() - model_.states());
        return;
      }
      v = add(next, state);
      make_active(index({next.region, next.z}));
    }
  }

  // traj(T, v) of the last vertex.
  void finish(PaperAnswer& answer) {
    ltl::TrainPlan plan;
    const auto last = static_cast<std::uint32_t>(vertices_.size() - 1);
    plan.start = state_of(0);
    plan.end = state_of(last);
    for (std::uint32_t v = last; vertices_[v].parent != kNoVertex; v = vertices_[v].parent) {
      plan.pieces.push_back({vertices_[v].control, vertices_[v].duration_s});
      const ltl::TrainState here = state_of(v), there = state_of(vertices_[v].parent);
      plan.length_m += std::hypot(here[0] - there[0], here[1] - there[1]);
    }
    std::ranges::reverse(plan.pieces);
    answer.judgement = ltl::judge_plan(problem_.floor, model_, plan.start, task_.formula, plan);
    if (answer.judgement.accepted()) answer.plan = std::move(plan);
  }

  const ltl::Problem& problem_;
  const ltl::RegionMap& map_;
  const ltl::Task& task_;
  const ltl::Automaton& automaton_;
  const PaperOptions& options_;
  ltl::TrainModel model_;
  ltl::TrainModel wide_;
  ltl::Walls walls_;
  ltl::Places places_;
  std::mt19937_64 dice_;
  Clock::time_point until_;
  std::vector<std::vector<std::uint32_t>> successors_;
  std::vector<Vertex> vertices_;
  std::vector<double> states_;                                // of each vertex
  std::vector<std::size_t> of_state_;                         // |vertices(T, z)|
  std::vector<std::uint32_t> gamma_;                          // those z that have some
  std::vector<std::vector<std::uint32_t>> regions_of_state_;  // of each z, those with vertices
  std::vector<std::vector<std::uint32_t>> of_stage_;          // vertices(T, z, r)
  std::vector<std::size_t> active_;
  std::vector<std::size_t> active_stamp_;
  std::size_t activation_ = 0;
  Stage from_;
  std::uint32_t to_ = 0;
  std::vector<Stage> plan_;
  std::vector<double> cost_m_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> search_stamp_;
  std::size_t search_ = 0;
  std::vector<ltl::Label> letters_;
};

}  // namespace

PaperAnswer plan_by_paper(const ltl::Problem& problem, const PaperOptions& options) {
  const auto began = Clock::now();
  PaperAnswer answer;
  const auto map = ltl::make_regions(problem.floor);
  const auto task =
      ltl::read_task(problem.task, problem.places(), "task", {.acceptance = ltl::Acceptance::Strong});
  if (map && task)
    Paper(problem, *map, *task, options)
        .run(began +
                 std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.most_s)),
             answer);
  answer.spent_s = std::chrono::duration<double>(Clock::now() - began).count();
  return answer;
}

}  // namespace stepwright::bench
