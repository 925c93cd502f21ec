// Crates in stacks on pallets, hoists at every site, trucks between the sites.

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain = R"(; Stacks of crates are rebuilt: hoists lift, trucks carry.
(define (domain depots)
  (:requirements :typing)
  (:types site thing truck hoist - object
          crate pallet - thing)
  (:predicates
    (parked ?t - truck ?s - site)
    (mounted ?h - hoist ?s - site)
    (located ?x - thing ?s - site)
    (on ?c - crate ?x - thing)
    (clear ?x - thing)
    (holds ?h - hoist ?c - crate)
    (idle ?h - hoist)
    (loaded ?c - crate ?t - truck))
  (:action drive
    :parameters (?t - truck ?from ?to - site)
    :precondition (parked ?t ?from)
    :effect (and (not (parked ?t ?from)) (parked ?t ?to)))
  (:action lift
    :parameters (?h - hoist ?c - crate ?x - thing ?s - site)
    :precondition (and (mounted ?h ?s) (idle ?h) (located ?c ?s) (on ?c ?x) (clear ?c))
    :effect (and (not (idle ?h)) (holds ?h ?c) (not (located ?c ?s)) (not (on ?c ?x))
                 (not (clear ?c)) (clear ?x)))
  (:action drop
    :parameters (?h - hoist ?c - crate ?x - thing ?s - site)
    :precondition (and (mounted ?h ?s) (holds ?h ?c) (located ?x ?s) (clear ?x))
    :effect (and (idle ?h) (not (holds ?h ?c)) (located ?c ?s) (on ?c ?x) (clear ?c)
                 (not (clear ?x))))
  (:action put-in
    :parameters (?h - hoist ?c - crate ?t - truck ?s - site)
    :precondition (and (mounted ?h ?s) (parked ?t ?s) (holds ?h ?c))
    :effect (and (not (holds ?h ?c)) (idle ?h) (loaded ?c ?t)))
  (:action take-out
    :parameters (?h - hoist ?c - crate ?t - truck ?s - site)
    :precondition (and (mounted ?h ?s) (parked ?t ?s) (idle ?h) (loaded ?c ?t))
    :effect (and (not (loaded ?c ?t)) (not (idle ?h)) (holds ?h ?c))))
)";

using Stacks = std::vector<std::vector<int>>;  // crates on each pallet, lowest first

Stacks random_stacks(int crates, int pallets, Random& random) {
  std::vector<int> order;
  for (int c = 1; c <= crates; ++c) order.push_back(c);
  random.shuffle(order);
  Stacks stacks(static_cast<std::size_t>(pallets));
  for (const int c : order) stacks[static_cast<std::size_t>(random.below(pallets))].push_back(c);
  return stacks;
}

std::string below(const Stacks& stacks, std::size_t pallet, std::size_t level) {
  return level == 0 ? fmt::format("pallet{}", pallet + 1) : fmt::format("crate{}", stacks[pallet][level - 1]);
}

// One truck picks up every crate, then builds the stacks wanted.
std::vector<std::string> reference(const Stacks& from, const Stacks& to, std::size_t sites, std::size_t at) {
  std::vector<std::string> plan;
  const auto drive = [&](std::size_t site) {
    if (site != at) plan.push_back(fmt::format("drive truck1 site{} site{}", at + 1, site + 1));
    at = site;
  };
  for (std::size_t p = 0; p < from.size(); ++p) {
    for (std::size_t level = from[p].size(); level-- > 0;) {
      drive(p % sites);
      const int c = from[p][level];
      plan.push_back(fmt::format("lift hoist{0} crate{1} {2} site{0}", at + 1, c, below(from, p, level)));
      plan.push_back(fmt::format("put-in hoist{0} crate{1} truck1 site{0}", at + 1, c));
    }
  }
  for (std::size_t p = 0; p < to.size(); ++p) {
    for (std::size_t level = 0; level < to[p].size(); ++level) {
      drive(p % sites);
      const int c = to[p][level];
      plan.push_back(fmt::format("take-out hoist{0} crate{1} truck1 site{0}", at + 1, c));
      plan.push_back(fmt::format("drop hoist{0} crate{1} {2} site{0}", at + 1, c, below(to, p, level)));
    }
  }
  return plan;
}

Draft draft(int size, Random& random) {
  const int sites = 3 + size / 3, pallets = sites + size / 2, crates = 2 + 2 * size, trucks = 2 + size / 8;
  ProblemText problem(fmt::format("depots-{}", size), "depots");
  problem.objects("site", numbered("site", sites));
  problem.objects("pallet", numbered("pallet", pallets));
  problem.objects("crate", numbered("crate", crates));
  problem.objects("hoist", numbered("hoist", sites));
  problem.objects("truck", numbered("truck", trucks));
  for (int s = 1; s <= sites; ++s) problem.init("(mounted hoist{0} site{0}) (idle hoist{0})", s);
  std::size_t first_truck = 0;
  for (int t = 1; t <= trucks; ++t) {
    const int site = random.below(sites);
    if (t == 1) first_truck = static_cast<std::size_t>(site);
    problem.init("(parked truck{} site{})", t, site + 1);
  }
  const Stacks from = random_stacks(crates, pallets, random), to = random_stacks(crates, pallets, random);
  const auto site_count = static_cast<std::size_t>(sites);
  for (std::size_t p = 0; p < from.size(); ++p) {
    problem.init("(located pallet{} site{})", p + 1, p % site_count + 1);
    for (std::size_t level = 0; level < from[p].size(); ++level) {
      problem.init("(located crate{0} site{1}) (on crate{0} {2})", from[p][level], p % site_count + 1,
                   below(from, p, level));
    }
    problem.init("(clear {})", below(from, p, from[p].size()));
    for (std::size_t level = 0; level < to[p].size(); ++level) {
      problem.goal("(on crate{} {})", to[p][level], below(to, p, level));
    }
  }
  return {problem.text(), reference(from, to, site_count, first_truck), 0.0};
}

}  // namespace

Generator depots() {
  return {"depots", "stacks of crates at several sites", kDomain, {1, 2, 3, 4, 5}, 60, true, draft};
}

}  // namespace stepwright::bench
