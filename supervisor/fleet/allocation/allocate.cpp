#include "supervisor/fleet/allocation/allocate.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "supervisor/fleet/allocation/internal/assignment_bound.h"
#include "supervisor/fleet/allocation/internal/conflict.h"
#include "supervisor/fleet/allocation/internal/divisions.h"
#include "supervisor/fleet/allocation/internal/neighbourhood_search.h"
#include "supervisor/fleet/allocation/internal/trip_search.h"

namespace stepwright::fleet {

namespace internal {

namespace {

constexpr std::size_t kMostSearched = 6;  // divisions for large neighbourhood search
constexpr std::uint64_t kWarmUp = 200;    // its iterations before branch and bound
constexpr std::uint64_t kUsualIterations = 2000;

class Allocator {
 public:
  Allocator(const AllocationProblem& problem, const AllocationOptions& options)
      : problem_(problem),
        options_(options),
        limits_(options.time, options.cancel),
        everything_(problem),
        exact_trips_(std::min(options.exact_trips, kMostTableTrips)),
        divisions_(joint_divisions(problem, everything_, exact_trips_)) {}

  AllocationAnswer run() {
    std::uint64_t iterations = options_.iterations;
    if (iterations == 0 && options_.time.count() == 0) iterations = kUsualIterations;
    make_models();
    if (models_.empty() && divisions_.complete) return infeasible(everything_);
    const bool exact = !models_.empty() && provable(models_.front());
    improve(exact && (iterations == 0 || iterations > kWarmUp) ? kWarmUp : iterations);
    if (exact && search_exactly()) {
      if (!answer_) return infeasible(everything_);
      answer_->verdict = AllocationVerdict::Optimal;
      answer_->lower_bound = answer_->objective;
      return finished(*std::move(answer_));
    }
    if (exact) improve(iterations);
    if (answer_) {
      answer_->verdict = AllocationVerdict::Feasible;
      answer_->lower_bound = std::min(std::max(lower_bound_, least()), answer_->objective);
      return finished(*std::move(answer_));
    }
    return without_answer();
  }

 private:
  // Those that are searched; the ones that contradict themselves are left out.
  void make_models() {
    const Division& fewest = divisions_.all.front();
    std::size_t trips = 0;
    for (const Amounts& amounts : fewest) trips += amounts.size();
    if (trips > exact_trips_) divisions_ = usual_divisions(problem_, everything_);
    for (const Division& division : divisions_.all) {
      TripModel model = make_model(problem_, everything_, division, Ways::AsGiven);
      if (!model.contradiction()) models_.push_back(std::move(model));
    }
    for (const TripModel& model : models_) {
      if (searches_.size() < kMostSearched) searches_.emplace_back(model, options_.seed);
    }
  }

  bool provable(const TripModel& model) const { return model.trips() <= exact_trips_ && tables_fit(model); }

  // Half of the iterations for all divisions, the other half for the best one.
  void improve(std::uint64_t iterations) {
    const auto begin = limits_.elapsed_ms();
    std::size_t best = 0;
    const std::uint64_t each = iterations / (2 * std::max<std::size_t>(1, searches_.size()));
    for (std::size_t i = 0; i < searches_.size(); ++i) {
      if (searches_.size() > 1) run_search(i, std::max<std::uint64_t>(each, 1));
      const auto &found = searches_[i].found(), &least = searches_[best].found();
      if (found && (!least || found->value < least->value)) best = i;
    }
    if (!searches_.empty()) {
      run_search(best, searches_.size() > 1 && iterations > 0 ? iterations - iterations / 2 : iterations);
    }
    improve_ms_ += limits_.elapsed_ms() - begin;
  }

  void run_search(std::size_t i, std::uint64_t iterations) {
    NeighbourhoodSearch& search = searches_[i];
    const std::uint64_t before = search.iterations();
    search.run(iterations, limits_);
    iterations_ += search.iterations() - before;
    if (search.found()) keep(models_[i], search.found()->routes, search.found()->evaluation);
  }

  void keep(const TripModel& model, const Routes& routes, const Evaluation& evaluation) {
    const std::int64_t value = evaluation.score.value(problem_.objective);
    if (answer_ && answer_->objective <= value) return;
    if (!answer_) first_ms_ = limits_.elapsed_ms();
    answer_ = answer_of(model, routes, evaluation);
    trips_ = model.trips();
  }

  // Whether the best is known: that there is none better than `answer_`, or none at all.
  bool search_exactly() {
    const double begin_ms = limits_.elapsed_ms();
    // Large neighbourhoods get a share of what time there is.
    const auto left = options_.time - std::chrono::milliseconds(static_cast<std::int64_t>(begin_ms));
    const std::chrono::milliseconds share = std::max(left * 6 / 10, std::chrono::milliseconds(1));
    const Limits limits(options_.time.count() > 0 ? share : options_.time, options_.cancel);
    bool proved = divisions_.complete;
    lower_bound_ = divisions_.complete ? kNoValue : 0;
    for (const TripModel& model : models_) {
      if (!provable(model)) {
        proved = false;
        lower_bound_ = 0;
        continue;
      }
      TripSearch search(model, problem_.objective, limits, options_.nodes);
      const bool done = search.run(answer_ ? answer_->objective : kNoValue);
      nodes_ += search.nodes();
      if (search.found()) keep(model, search.found()->routes, search.found()->evaluation);
      if (done) continue;
      proved = false;
      lower_bound_ = std::min(lower_bound_, search.root_bound());
    }
    exact_ms_ = limits_.elapsed_ms() - begin_ms;
    return proved;
  }

  // A bound that needs no search.
  std::int64_t least() const {
    if (divisions_.complete) {
      std::int64_t least = kNoValue;
      for (const TripModel& model : models_) least = std::min(least, least_value(model));
      return least;
    }
    // Whatever the division is, at least one unit of each transport makes a trip.
    AllocationProblem units = problem_;
    for (Transport& transport : units.transports) transport.amount = 1;
    units.routes.clear();
    const Selection all(units);
    const Division division(units.transports.size(), Amounts{1});
    const TripModel model = make_model(units, all, division, Ways::Closed);
    return model.contradiction() ? 0 : least_value(model);
  }

  AllocationAnswer without_answer() {
    if (!limits_.cancelled()) {
      std::vector<std::uint32_t> missing;
      for (std::size_t i = 0; i < searches_.size(); ++i) {
        for (const std::uint32_t trip : searches_[i].missing()) {
          missing.push_back(models_[i].trip(trip).transport);
        }
      }
      std::ranges::sort(missing);
      const auto repeated = std::ranges::unique(missing);
      missing.erase(repeated.begin(), repeated.end());
      if (auto part = impossible_part(problem_, missing, limits_)) return infeasible(*std::move(part));
    }
    AllocationAnswer answer;
    answer.verdict = limits_.cancelled() ? AllocationVerdict::Cancelled : AllocationVerdict::Exhausted;
    return finished(std::move(answer));
  }

  AllocationAnswer infeasible(Selection part) {
    AllocationAnswer answer;
    answer.verdict = AllocationVerdict::Infeasible;
    const double begin_ms = limits_.elapsed_ms();
    if (options_.explain) answer.conflict = conflict_within(problem_, std::move(part), limits_);
    answer.figures.explain_ms = limits_.elapsed_ms() - begin_ms;
    return finished(std::move(answer));
  }

  AllocationAnswer finished(AllocationAnswer answer) const {
    answer.figures.trips = trips_;
    answer.figures.nodes = nodes_;
    answer.figures.iterations = iterations_;
    answer.figures.first_ms = first_ms_;
    answer.figures.exact_ms = exact_ms_;
    answer.figures.improve_ms = improve_ms_;
    return answer;
  }

  const AllocationProblem& problem_;
  const AllocationOptions& options_;
  Limits limits_;
  Selection everything_;
  std::uint32_t exact_trips_;
  JointDivisions divisions_;
  std::vector<TripModel> models_;
  std::vector<NeighbourhoodSearch> searches_;
  std::optional<AllocationAnswer> answer_;
  std::int64_t lower_bound_ = 0;
  std::size_t trips_ = 0;
  std::uint64_t nodes_ = 0;
  std::uint64_t iterations_ = 0;
  double first_ms_ = 0.0;
  double exact_ms_ = 0.0;
  double improve_ms_ = 0.0;
};

}  // namespace

}  // namespace internal

AllocationAnswer allocate(const AllocationProblem& problem, const AllocationOptions& options) {
  // Amounts are numbers: a single one may stand for more trips than there is memory for.
  if (internal::fewest_trips(problem, internal::Selection(problem)) > kMostTrips) return {};
  return internal::Allocator(problem, options).run();
}

}  // namespace stepwright::fleet
