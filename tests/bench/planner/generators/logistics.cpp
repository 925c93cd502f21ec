// Parcels go by truck within cities and by plane between them.

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain = R"(; Parcels go by truck inside a city and by plane between airports.
(define (domain logistics)
  (:requirements :typing)
  (:types parcel vehicle place city - object
          truck plane - vehicle
          airport - place)
  (:predicates
    (stands ?v - vehicle ?p - place)
    (lies ?x - parcel ?p - place)
    (aboard ?x - parcel ?v - vehicle)
    (within ?p - place ?c - city))
  (:action load
    :parameters (?x - parcel ?v - vehicle ?p - place)
    :precondition (and (stands ?v ?p) (lies ?x ?p))
    :effect (and (not (lies ?x ?p)) (aboard ?x ?v)))
  (:action unload
    :parameters (?x - parcel ?v - vehicle ?p - place)
    :precondition (and (stands ?v ?p) (aboard ?x ?v))
    :effect (and (not (aboard ?x ?v)) (lies ?x ?p)))
  (:action drive
    :parameters (?t - truck ?from ?to - place ?c - city)
    :precondition (and (stands ?t ?from) (within ?from ?c) (within ?to ?c))
    :effect (and (not (stands ?t ?from)) (stands ?t ?to)))
  (:action fly
    :parameters (?a - plane ?from ?to - airport)
    :precondition (stands ?a ?from)
    :effect (and (not (stands ?a ?from)) (stands ?a ?to))))
)";

struct Place {
  int city = 0, number = 0;  // number 0 is the airport
  bool operator==(const Place&) const = default;
};

std::string name(Place p) {
  return p.number == 0 ? fmt::format("airport{}", p.city + 1)
                       : fmt::format("place{}x{}", p.city + 1, p.number);
}

struct World {
  std::vector<Place> trucks;  // one per city
  int plane = 0;              // the city of the plane that the reference plan uses
  std::vector<std::string> plan;

  void truck_to(Place to) {
    Place& at = trucks[static_cast<std::size_t>(to.city)];
    if (at == to) return;
    plan.push_back(fmt::format("drive truck{0} {1} {2} city{0}", to.city + 1, name(at), name(to)));
    at = to;
  }

  void plane_to(int city) {
    if (plane == city) return;
    plan.push_back(fmt::format("fly plane1 airport{} airport{}", plane + 1, city + 1));
    plane = city;
  }

  void by_truck(int parcel, Place from, Place to) {
    if (from == to) return;
    truck_to(from);
    plan.push_back(fmt::format("load parcel{} truck{} {}", parcel, from.city + 1, name(from)));
    truck_to(to);
    plan.push_back(fmt::format("unload parcel{} truck{} {}", parcel, from.city + 1, name(to)));
  }

  void carry(int parcel, Place from, Place to) {
    if (from.city == to.city) return by_truck(parcel, from, to);
    by_truck(parcel, from, {from.city, 0});
    plane_to(from.city);
    plan.push_back(fmt::format("load parcel{} plane1 airport{}", parcel, from.city + 1));
    plane_to(to.city);
    plan.push_back(fmt::format("unload parcel{} plane1 airport{}", parcel, to.city + 1));
    by_truck(parcel, {to.city, 0}, to);
  }
};

Draft draft(int size, Random& random) {
  const int cities = 2 + size / 2, places = 2 + size / 3, parcels = 2 * size, planes = 1 + size / 6;
  const auto any_place = [&] {
    const int city = random.below(cities);
    return Place{city, random.below(places)};
  };
  ProblemText problem(fmt::format("logistics-{}", size), "logistics");
  problem.objects("parcel", numbered("parcel", parcels));
  problem.objects("truck", numbered("truck", cities));
  problem.objects("plane", numbered("plane", planes));
  problem.objects("city", numbered("city", cities));
  World world;
  for (int c = 0; c < cities; ++c) {
    for (int p = 0; p < places; ++p) {
      problem.objects(p == 0 ? "airport" : "place", {name({c, p})});
      problem.init("(within {} city{})", name({c, p}), c + 1);
    }
    world.trucks.push_back({c, random.below(places)});
    problem.init("(stands truck{} {})", c + 1, name(world.trucks.back()));
  }
  for (int i = 0; i < planes; ++i) {
    const int city = random.below(cities);
    if (i == 0) world.plane = city;
    problem.init("(stands plane{} airport{})", i + 1, city + 1);
  }
  for (int i = 1; i <= parcels; ++i) {
    const Place from = any_place(), to = any_place();
    problem.init("(lies parcel{} {})", i, name(from));
    problem.goal("(lies parcel{} {})", i, name(to));
    world.carry(i, from, to);
  }
  return {problem.text(), world.plan, 0.0};
}

}  // namespace

Generator logistics() {
  return {"logistics", "parcels by truck and plane", kDomain, {1, 2, 4, 7, 10}, 5000, true, draft};
}

}  // namespace stepwright::bench
