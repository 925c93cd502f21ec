#include <random>

#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl::testing {
namespace {

class TransportGenerator {
 public:
  explicit TransportGenerator(std::uint32_t seed) : random_(seed) {
    trucks_ = 1 + pick(2);
    parcels_ = trucks_ == 2 ? 1 : 1 + pick(2);
  }

  std::string domain() {
    std::string text = R"((define (domain transport) (:requirements :adl :numeric-fluents)
  (:types truck parcel place)
  (:predicates (at ?t - truck ?p - place) (lies ?c - parcel ?p - place) (in ?c - parcel ?t - truck)
               (road ?a ?b - place) (pump ?p - place) (lit))
  (:functions (fuel ?t - truck) (tank ?t - truck) (need ?a ?b - place) (room ?t - truck) (cost))
  (:action drive :parameters (?t - truck ?a ?b - place)
    :precondition (and (at ?t ?a) (road ?a ?b) (>= (fuel ?t) (need ?a ?b)))
    :effect (and (not (at ?t ?a)) (at ?t ?b) (decrease (fuel ?t) (need ?a ?b)) (increase (cost) )";
    text += pick(3) == 0 ? "1" : pick(4) == 0 ? "(+ 1 (fuel ?t))" : "(need ?a ?b)";
    text += R"()))
  (:action load :parameters (?c - parcel ?t - truck ?p - place)
    :precondition (and (at ?t ?p) (lies ?c ?p) (>= (room ?t) 1))
    :effect (and (not (lies ?c ?p)) (in ?c ?t) (decrease (room ?t) 1)))
  (:action unload :parameters (?c - parcel ?t - truck ?p - place)
    :precondition (and (at ?t ?p) (in ?c ?t))
    :effect (and (not (in ?c ?t)) (lies ?c ?p) (increase (room ?t) 1)))
)";
    text += refill();
    text += extra();
    return text + ")";
  }

  std::string problem() {
    static const char* places[] = {"a", "b", "c"};
    std::string init, goal, trucks, parcels;
    for (int t = 1; t <= trucks_; ++t) {
      const std::string truck = "t" + std::to_string(t);
      trucks += " " + truck;
      const int tank = 2 + pick(3);
      init += " (at " + truck + " " + places[pick(3)] + ") (= (fuel " + truck + ") " +
              std::to_string(pick(tank + 1)) + ") (= (tank " + truck + ") " + std::to_string(tank) +
              ") (= (room " + truck + ") " + std::to_string(1 + pick(2)) + ")";
    }
    for (int c = 1; c <= parcels_; ++c) {
      const std::string parcel = "p" + std::to_string(c);
      parcels += " " + parcel;
      init += " (lies " + parcel + " " + places[pick(3)] + ")";
      goal += " (lies " + parcel + " " + places[pick(3)] + ")";
    }
    for (const std::string from : places) {
      for (const std::string to : places) {
        if (from == to || pick(4) == 0) continue;
        init += " (road " + from + " " + to + ") (= (need " + from + " " + to + ") " +
                std::to_string(1 + pick(2)) + ")";
      }
    }
    if (pick(4) == 0)
      goal += std::string(pick(2) == 0 ? " (<=" : " (=") + " (fuel t1) " + std::to_string(pick(3)) + ")";
    if (pick(4) == 0) goal += " (>= (fuel t1) 2)";
    if (pick(3) == 0) goal += " (lit)";
    return "(define (problem r) (:domain transport) (:objects" + trucks + " - truck" + parcels +
           " - parcel a b c - place) (:init (= (cost) 0) (pump " + places[pick(3)] + ")" + init +
           ") (:goal (and" + goal + ")) (:metric minimize (cost)))";
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }

  // To the brim, with or without asking whether it is full; or by one.
  std::string refill() {
    const int kind = pick(4);
    const std::string asks = kind == 0 ? "" : " (< (fuel ?t) (tank ?t))";
    const std::string fills = kind == 1 ? "(increase (fuel ?t) 1)" : "(assign (fuel ?t) (tank ?t))";
    return "  (:action refill :parameters (?t - truck ?p - place) :precondition (and (at ?t ?p) (pump ?p)" +
           asks + ") :effect (and " + fills + (pick(4) == 0 ? " (lit)" : "") + " (increase (cost) 1)))\n";
  }

  // Something that uses the fluents in another way, or the facts that several trucks share.
  std::string extra() {
    static const char* actions[] = {
        "",
        "(:action burn :parameters (?t - truck) :precondition (= (fuel ?t) 1) :effect (and (lit) (assign "
        "(fuel ?t) 0)))",
        "(:action sell :parameters (?t - truck) :precondition (>= (fuel ?t) 2) :effect (and (decrease (fuel "
        "?t) 2) "
        "(lit) (increase (cost) (room ?t))))",
        "(:action signal :parameters (?t - truck) :precondition (or (at ?t a) (<= (fuel ?t) 1)) :effect (and "
        "(lit) "
        "(increase (cost) 1)))",
        "(:action darken :parameters (?t - truck) :effect (and (when (lit) (and (not (lit)) (assign (fuel "
        "?t) (tank "
        "?t)))) (when (not (lit)) (lit)) (increase (cost) 2)))",
    };
    return actions[pick(5)];
  }

  std::mt19937 random_;
  int trucks_ = 1, parcels_ = 1;
};

}  // namespace

RandomTask random_transport_task(std::uint32_t seed) {
  TransportGenerator generator(seed);
  std::string domain = generator.domain();
  std::string problem = generator.problem();
  Task task = make_task(domain, problem);
  return {std::move(domain), std::move(problem), std::move(task)};
}

}  // namespace stepwright::pddl::testing
