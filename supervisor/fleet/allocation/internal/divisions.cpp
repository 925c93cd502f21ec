#include "supervisor/fleet/allocation/internal/divisions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace stepwright::fleet::internal {

namespace {

constexpr std::size_t kMostDivisions = 64;

// Different capacities of vehicles that may take a part of the transport, the largest first.
std::vector<std::uint32_t> capacities(const AllocationProblem& problem, const Selection& selection,
                                      std::uint32_t transport) {
  std::set<std::uint32_t, std::greater<>> found;
  const std::optional<VehicleId>& fixed = problem.transports[transport].vehicle;
  for (std::uint32_t v = 0; v < problem.vehicles.size(); ++v) {
    if (fixed && selection.vehicles[transport] != 0 && fixed->value != v) continue;
    bool whole = false;
    for (std::size_t r = 0; r < problem.routes.size(); ++r) {
      whole |= selection.routes[r] != 0 && problem.routes[r].whole && problem.routes[r].vehicle.value == v;
    }
    if (!whole) found.insert(problem.vehicles[v].capacity);
  }
  return {found.begin(), found.end()};
}

// Full loads of capacity `at` and smaller ones are added to `taken`, then the rest.
void divide(const std::vector<std::uint32_t>& sizes, std::size_t at, std::uint32_t left, Amounts& taken,
            Divisions& out) {
  if (out.all.size() >= kMostDivisions) {
    out.complete = false;
    return;
  }
  if (at == sizes.size()) {
    if (left > sizes.front() || std::ranges::find(sizes, left) != sizes.end()) return;
    Amounts amounts = taken;
    if (left > 0) amounts.push_back(left);
    std::ranges::sort(amounts, std::greater<>());
    out.all.push_back(std::move(amounts));
    return;
  }
  const std::size_t before = taken.size();
  const std::uint32_t most = left / sizes[at];
  taken.insert(taken.end(), most, sizes[at]);
  for (std::uint32_t loads = most;; --loads) {
    divide(sizes, at + 1, left - loads * sizes[at], taken, out);
    if (loads == 0) break;
    taken.pop_back();
  }
  taken.resize(before);
}

}  // namespace

Amounts undivided(const AllocationProblem& problem, const Selection& selection) {
  Amounts left;
  for (const Transport& transport : problem.transports) left.push_back(transport.amount);
  for (std::size_t r = 0; r < problem.routes.size(); ++r) {
    if (selection.routes[r] == 0) continue;
    for (const FixedStop& stop : problem.routes[r].stops) {
      if (stop.action != LoadAction::PickUp) continue;
      std::uint32_t& of = left[stop.transport.value];
      of -= std::min(of, stop.amount);
    }
  }
  return left;
}

std::uint64_t fewest_trips(const AllocationProblem& problem, const Selection& selection) {
  const Amounts left = undivided(problem, selection);
  std::uint64_t trips = 0;
  for (std::uint32_t t = 0; t < problem.transports.size(); ++t) {
    if (selection.transports[t] == 0 || left[t] == 0) continue;
    const std::vector<std::uint32_t> sizes = capacities(problem, selection, t);
    const bool one = !problem.transports[t].divisible || sizes.empty();
    trips += one ? 1 : (left[t] + std::uint64_t(sizes.front()) - 1) / sizes.front();
  }
  return trips;
}

Divisions divisions(const AllocationProblem& problem, const Selection& selection, std::uint32_t transport,
                    std::uint32_t amount) {
  Divisions out;
  if (amount == 0) {
    out.all.emplace_back();
    return out;
  }
  const std::vector<std::uint32_t> sizes = capacities(problem, selection, transport);
  if (!problem.transports[transport].divisible || sizes.empty()) {
    out.all.push_back({amount});
    return out;
  }
  Amounts taken;
  divide(sizes, 0, amount, taken, out);
  std::ranges::stable_sort(out.all, {}, &Amounts::size);
  return out;
}

JointDivisions joint_divisions(const AllocationProblem& problem, const Selection& selection,
                               std::size_t most_trips) {
  const Amounts left = undivided(problem, selection);
  JointDivisions joint;
  joint.all.emplace_back();
  for (std::uint32_t t = 0; t < problem.transports.size(); ++t) {
    Divisions of_this = divisions(problem, selection, t, selection.transports[t] != 0 ? left[t] : 0);
    joint.complete &= of_this.complete;
    std::vector<Division> longer;
    for (const Division& division : joint.all) {
      std::size_t trips = 0;
      for (const Amounts& amounts : division) trips += amounts.size();
      for (const Amounts& amounts : of_this.all) {
        const bool first = longer.empty();
        if (!first && (longer.size() >= kMostDivisions || trips + amounts.size() > most_trips)) {
          joint.complete = false;
          continue;
        }
        longer.push_back(division);
        longer.back().push_back(amounts);
      }
    }
    joint.all = std::move(longer);
  }
  std::ranges::stable_sort(joint.all, {}, [](const Division& division) {
    std::size_t trips = 0;
    for (const Amounts& amounts : division) trips += amounts.size();
    return trips;
  });
  return joint;
}

JointDivisions usual_divisions(const AllocationProblem& problem, const Selection& selection) {
  const Amounts left = undivided(problem, selection);
  std::set<std::uint32_t, std::greater<>> found;
  for (const TransportVehicle& vehicle : problem.vehicles) found.insert(vehicle.capacity);
  const std::vector<std::uint32_t> classes(found.begin(), found.end());
  // Full loads of the largest vehicle that may take it and is no larger than `most`, and the rest.
  const auto divided = [&](std::uint32_t t, std::uint32_t most) {
    const std::vector<std::uint32_t> sizes = capacities(problem, selection, t);
    if (!problem.transports[t].divisible || sizes.empty()) return Amounts{left[t]};
    const auto size = std::ranges::find_if(sizes, [most](std::uint32_t c) { return c <= most; });
    const std::uint32_t load = size == sizes.end() ? sizes.back() : *size;
    Amounts amounts(left[t] / load, load);
    if (left[t] % load > 0) amounts.push_back(left[t] % load);
    return amounts;
  };
  JointDivisions joint;
  joint.complete = classes.size() <= 1;
  for (std::size_t i = 0; i < (classes.size() > 1 ? 2 * classes.size() : 1); ++i) {
    Division division(problem.transports.size());
    for (std::uint32_t t = 0; t < division.size(); ++t) {
      if (selection.transports[t] == 0 || left[t] == 0) continue;
      const std::size_t turn = i < classes.size() ? i : (i + t) % classes.size();
      division[t] = divided(t, classes.empty() ? 1 : classes[turn]);
    }
    joint.all.push_back(std::move(division));
  }
  return joint;
}

}  // namespace stepwright::fleet::internal
