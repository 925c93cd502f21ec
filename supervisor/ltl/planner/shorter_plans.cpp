#include "supervisor/ltl/planner/shorter_plans.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "supervisor/ltl/lanes/lanes.h"

namespace stepwright::ltl {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kOtherRoutesFirst = 2;  // rounds

std::uint64_t mixed(std::uint64_t seed, std::uint64_t round, std::uint64_t lane) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15u + round * 0xC2B2AE3D27D4EB4Fu + lane * 0x165667B19E3779F9u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

class Rounds {
 public:
  Rounds(const SearchGround& ground, const std::function<TaskStates()>& states, const ShorterOptions& options)
      : ground_(ground), states_(states), options_(options) {
    constexpr double kLongest_s = 1e6;  // more would overflow some clocks
    const std::chrono::duration<double> most(std::clamp(options.most_s, 0.0, kLongest_s));
    if (options.first != nullptr && ground.has_automaton()) best_[0] = *options.first;
    stop_ = {Clock::now() + std::chrono::duration_cast<Clock::duration>(most), options.cancel, nullptr};
  }

  std::vector<TrainPlan> run() {
    std::vector<TrainPlan> plans;
    double least_m = options_.than_m;
    for (std::size_t round = 0; round < options_.most_rounds && !stop_.over(); ++round) {
      std::array<std::optional<DrivenRoute>, kLanes> found;
      std::array<bool, kLanes> cut{};
      on_lanes(options_.threads, [&](std::size_t lane) {
        if (shorteners_[lane] == nullptr) shorteners_[lane] = std::make_unique<Shortener>(ground_, states_());
        found[lane] = shorteners_[lane]->round(round_of(round, lane));
        cut[lane] = shorteners_[lane]->was_cut();
      });
      if (cut[0] || cut[1]) break;
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        if (found[lane]) best_[lane] = std::move(found[lane]);
      const DrivenRoute* const best = shortest();
      if (best == nullptr || best->length_m() >= least_m) continue;
      least_m = best->length_m();
      plans.push_back(best->plan());
    }
    return plans;
  }

 private:
  const DrivenRoute* shortest() const {
    const DrivenRoute* best = nullptr;
    for (const std::optional<DrivenRoute>& each : best_)
      if (each && (best == nullptr || each->length_m() < best->length_m())) best = &*each;
    return best;
  }

  // States of a progression mean something to their own lane only.
  const DrivenRoute* best_of(std::size_t lane) const {
    if (ground_.has_automaton()) return shortest();
    return best_[lane] ? &*best_[lane] : nullptr;
  }

  ShortenRound round_of(std::size_t round, std::size_t lane) const {
    const std::uint64_t seed = mixed(options_.seed, round, lane);
    const bool is_other = round < kOtherRoutesFirst || (round + lane) % 2 == 1;
    const bool is_wanted = round == 0 ? lane == 0 : (seed >> 40 & 1) != 0;
    return {.start = options_.start,
            .seed = seed,
            .best = best_of(lane),
            .other_routes = is_other,
            .clearance = is_wanted ? Clearance::Wanted : Clearance::Least,
            .plain = round == 0,
            .stop = stop_};
  }

  const SearchGround& ground_;
  const std::function<TaskStates()>& states_;
  const ShorterOptions& options_;
  Stop stop_;
  std::array<std::unique_ptr<Shortener>, kLanes> shorteners_;
  std::array<std::optional<DrivenRoute>, kLanes> best_;
};

}  // namespace

std::vector<TrainPlan> shorter_plans(const SearchGround& ground, const std::function<TaskStates()>& states,
                                     const ShorterOptions& options) {
  return Rounds(ground, states, options).run();
}

}  // namespace stepwright::ltl
