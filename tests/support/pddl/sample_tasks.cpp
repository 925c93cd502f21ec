#include "tests/support/pddl/sample_tasks.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace stepwright::pddl::testing {

Task make_task(const std::string& domain, const std::string& problem) {
  auto task = parse_task({"domain.pddl", domain}, {"problem.pddl", problem});
  if (!task) throw std::runtime_error(result::to_string(task.error()));
  return *task;
}

std::string bench_file(const std::string& name) {
  return std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/bench/" + name;
}

Task bench_task(const std::string& suffix) {
  auto task = load_task(bench_file("domain" + suffix + ".pddl"), bench_file("problem" + suffix + ".pddl"));
  if (!task) throw std::runtime_error(result::to_string(task.error()));
  return *task;
}

Task counter_task(const std::string& goal, const std::string& metric) {
  return make_task(
      R"((define (domain counting) (:requirements :strips :numeric-fluents)
  (:functions (n) (effort))
  (:action one :parameters () :precondition (<= (n) 99) :effect (and (increase (n) 1) (increase (effort) 1)))
  (:action three :parameters () :precondition (<= (n) 97) :effect (and (increase (n) 3) (increase (effort) 2))))
)",
      "(define (problem count) (:domain counting) (:init (= (n) 0) (= (effort) 0)) (:goal " + goal + ") " +
          metric + ")");
}

Task logistics_task(int places) {
  std::string objects = "t - truck k1 k2 - package";
  std::string init = "(at t p1) (at k1 p1) (at k2 p" + std::to_string(places) + ")";
  for (int i = 1; i <= places; ++i) objects += " p" + std::to_string(i) + " - place";
  for (int i = 1; i < places; ++i) {
    const std::string a = "p" + std::to_string(i), b = "p" + std::to_string(i + 1);
    init += " (road " + a + " " + b + ") (road " + b + " " + a + ")";
  }
  return make_task(
      R"((define (domain logistics) (:requirements :strips :typing)
  (:types place thing - object truck package - thing)
  (:predicates (at ?x - thing ?p - place) (in ?k - package ?t - truck) (road ?a ?b - place))
  (:action drive :parameters (?t - truck ?a ?b - place) :precondition (and (at ?t ?a) (road ?a ?b))
    :effect (and (not (at ?t ?a)) (at ?t ?b)))
  (:action load :parameters (?k - package ?t - truck ?p - place) :precondition (and (at ?k ?p) (at ?t ?p))
    :effect (and (not (at ?k ?p)) (in ?k ?t)))
  (:action unload :parameters (?k - package ?t - truck ?p - place) :precondition (and (in ?k ?t) (at ?t ?p))
    :effect (and (not (in ?k ?t)) (at ?k ?p))))
)",
      "(define (problem swap) (:domain logistics) (:objects " + objects + ") (:init " + init +
          ") (:goal (and (at k1 p" + std::to_string(places) + ") (at k2 p1))))");
}

Task lamps_task(const std::string& goal) {
  return make_task(
      R"((define (domain lamps) (:requirements :adl :numeric-fluents)
  (:types lamp room)
  (:predicates (on ?l - lamp) (in ?l - lamp ?r - room) (powered))
  (:functions (toggles))
  (:action power :parameters () :precondition (not (powered)) :effect (powered))
  (:action toggle :parameters (?r - room) :precondition (powered)
    :effect (and (increase (toggles) 1)
      (forall (?l - lamp) (and
        (when (and (in ?l ?r) (on ?l)) (not (on ?l)))
        (when (and (in ?l ?r) (not (on ?l))) (on ?l)))))))
)",
      R"((define (problem house) (:domain lamps) (:objects a b c - lamp kitchen hall - room)
  (:init (in a kitchen) (in b hall) (in c hall) (on a) (= (toggles) 0)) (:goal )" +
          goal + "))");
}

}  // namespace stepwright::pddl::testing
