// Guests wait for sandwiches at tables; for some neither bread nor filling may have gluten.

#include <set>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; Sandwiches are made in the kitchen, brought on trays and given to guests. Most things are alike: which
; bread, which filling, which sandwich and which tray does not matter.
(define (domain canteen)
  (:requirements :typing)
  (:types guest bread filling sandwich tray place)
  (:constants kitchen - place)
  (:predicates
    (fresh-bread ?b - bread)
    (fresh-filling ?f - filling)
    (pure-bread ?b - bread)
    (pure-filling ?f - filling)
    (unmade ?s - sandwich)
    (prepared ?s - sandwich)
    (pure ?s - sandwich)
    (carries ?t - tray ?s - sandwich)
    (stands ?t - tray ?p - place)
    (sits ?g - guest ?p - place)
    (eats-all ?g - guest)
    (eats-pure ?g - guest)
    (fed ?g - guest))
  (:action make-pure
    :parameters (?s - sandwich ?b - bread ?f - filling)
    :precondition (and (unmade ?s) (fresh-bread ?b) (pure-bread ?b) (fresh-filling ?f) (pure-filling ?f))
    :effect (and (not (unmade ?s)) (not (fresh-bread ?b)) (not (fresh-filling ?f)) (prepared ?s) (pure ?s)))
  (:action make
    :parameters (?s - sandwich ?b - bread ?f - filling)
    :precondition (and (unmade ?s) (fresh-bread ?b) (fresh-filling ?f))
    :effect (and (not (unmade ?s)) (not (fresh-bread ?b)) (not (fresh-filling ?f)) (prepared ?s)))
  (:action load
    :parameters (?s - sandwich ?t - tray)
    :precondition (and (prepared ?s) (stands ?t kitchen))
    :effect (and (not (prepared ?s)) (carries ?t ?s)))
  (:action bring
    :parameters (?t - tray ?from ?to - place)
    :precondition (stands ?t ?from)
    :effect (and (not (stands ?t ?from)) (stands ?t ?to)))
  (:action give-pure
    :parameters (?g - guest ?s - sandwich ?t - tray ?p - place)
    :precondition (and (eats-pure ?g) (sits ?g ?p) (stands ?t ?p) (carries ?t ?s) (pure ?s))
    :effect (and (not (carries ?t ?s)) (fed ?g)))
  (:action give
    :parameters (?g - guest ?s - sandwich ?t - tray ?p - place)
    :precondition (and (eats-all ?g) (sits ?g ?p) (stands ?t ?p) (carries ?t ?s))
    :effect (and (not (carries ?t ?s)) (fed ?g))))
)";

// One sandwich at a time, those without gluten first.
std::vector<std::string> reference(const std::vector<int>& tables, int pure_guests) {
  std::vector<std::string> plan;
  for (int g = 1; g <= static_cast<int>(tables.size()); ++g) {
    const char* pure = g <= pure_guests ? "-pure" : "";
    const int table = tables[static_cast<std::size_t>(g) - 1];
    plan.push_back(fmt::format("make{0} sandwich{1} bread{1} filling{1}", pure, g));
    plan.push_back(fmt::format("load sandwich{} tray1", g));
    plan.push_back(fmt::format("bring tray1 kitchen table{}", table));
    plan.push_back(fmt::format("give{0} guest{1} sandwich{1} tray1 table{2}", pure, g, table));
    plan.push_back(fmt::format("bring tray1 table{} kitchen", table));
  }
  plan.pop_back();
  return plan;
}

// There is bread and filling for each guest, and as much without gluten as is needed.
Draft draft(int size, Random& random) {
  const int guests = 2 * size, pure_guests = (4 * guests + 9) / 10, places = 3;
  ProblemText problem(fmt::format("canteen-{}", size), "canteen");
  problem.objects("guest", numbered("guest", guests));
  problem.objects("bread", numbered("bread", guests));
  problem.objects("filling", numbered("filling", guests));
  problem.objects("sandwich", numbered("sandwich", guests + guests / 3));
  problem.objects("tray", numbered("tray", 2 + size / 4));
  problem.objects("place", numbered("table", places));
  for (int t = 1; t <= 2 + size / 4; ++t) problem.init("(stands tray{} kitchen)", t);
  for (int s = 1; s <= guests + guests / 3; ++s) problem.init("(unmade sandwich{})", s);
  std::vector<int> tables;
  for (int g = 1; g <= guests; ++g) {
    tables.push_back(1 + random.below(places));
    problem.init("(fresh-bread bread{0}) (fresh-filling filling{0})", g);
    if (g <= pure_guests) problem.init("(pure-bread bread{0}) (pure-filling filling{0})", g);
    problem.init("(sits guest{} table{}) ({} guest{})", g, tables.back(),
                 g <= pure_guests ? "eats-pure" : "eats-all", g);
    problem.goal("(fed guest{})", g);
  }
  // Three actions for each guest, and a tray has to come to each table where somebody sits.
  const std::set<int> visited(tables.begin(), tables.end());
  return {problem.text(), reference(tables, pure_guests), 3.0 * guests + static_cast<double>(visited.size())};
}

}  // namespace

Generator canteen() {
  return {"canteen", "sandwiches on trays, most things alike", kDomain, {1, 2, 3, 5, 6}, 60, true, draft};
}

}  // namespace stepwright::bench
