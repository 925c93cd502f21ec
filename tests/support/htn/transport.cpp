#include "tests/support/htn/transport.h"

namespace stepwright::htn::test {
namespace {

std::string place(int number) {
  return "l" + std::to_string(number);
}

std::string road(int from, int to) {
  return " (road " + place(from) + " " + place(to) + ")";
}

std::string problem(int places, int packages, const std::string& roads) {
  std::string objects = "t - truck", init, tasks;
  for (int i = 0; i < packages; ++i) {
    const std::string package = "k" + std::to_string(i);
    objects += " " + package + " - package";
    init += " (at-package " + package + " " + place((7 * i + 1) % places) + ")";
    tasks += " (deliver " + package + " " + place((3 * i + 5) % places) + ")";
  }
  for (int i = 0; i < places; ++i) objects += " " + place(i) + " - place";
  return "(define (problem bring-all) (:domain transport)\n  (:objects " + objects +
         ")\n  (:htn :ordered-subtasks (and" + tasks + "))\n  (:init (at t l0)" + init + roads + "))\n";
}

}  // namespace

std::string transport_domain() {
  return R"((define (domain transport)
  (:requirements :typing :hierarchy :negative-preconditions)
  (:types truck package place)
  (:predicates (at ?t - truck ?l - place) (at-package ?k - package ?l - place) (on ?k - package ?t - truck)
               (road ?a ?b - place))
  (:task deliver :parameters (?k - package ?l - place))
  (:task get-to :parameters (?t - truck ?l - place))
  (:method deliver :parameters (?k - package ?a ?b - place ?t - truck) :task (deliver ?k ?b)
    :precondition (at-package ?k ?a)
    :ordered-subtasks (and (get-to ?t ?a) (load ?t ?k ?a) (get-to ?t ?b) (unload ?t ?k ?b)))
  (:method there :parameters (?t - truck ?l - place) :task (get-to ?t ?l) :precondition (at ?t ?l)
    :ordered-subtasks ())
  (:method on :parameters (?t - truck ?a ?b ?l - place) :task (get-to ?t ?l)
    :precondition (and (at ?t ?a) (not (at ?t ?l)))
    :ordered-subtasks (and (drive ?t ?a ?b) (get-to ?t ?l)))
  (:action drive :parameters (?t - truck ?a ?b - place) :precondition (and (at ?t ?a) (road ?a ?b))
    :effect (and (not (at ?t ?a)) (at ?t ?b)))
  (:action load :parameters (?t - truck ?k - package ?l - place)
    :precondition (and (at ?t ?l) (at-package ?k ?l)) :effect (and (not (at-package ?k ?l)) (on ?k ?t)))
  (:action unload :parameters (?t - truck ?k - package ?l - place)
    :precondition (and (at ?t ?l) (on ?k ?t)) :effect (and (at-package ?k ?l) (not (on ?k ?t)))))
)";
}

std::string ring_problem(int places, int packages) {
  std::string roads;
  for (int i = 0; i < places; ++i) roads += road(i, (i + 1) % places);
  return problem(places, packages, roads);
}

std::string grid_problem(int side, int packages) {
  std::string roads;
  for (int i = 0; i < side * side; ++i) {
    if (i % side + 1 < side) roads += road(i, i + 1) + road(i + 1, i);
    if (i + side < side * side) roads += road(i, i + side) + road(i + side, i);
  }
  return problem(side * side, packages, roads);
}

}  // namespace stepwright::htn::test
