#include "tests/bench/grounding/generators.h"

#include <cmath>

namespace stepwright::bench::grounding {
namespace {

std::string numbered(const std::string& prefix, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += " " + prefix + std::to_string(i);
  return text;
}

std::string name(const std::string& prefix, int number) {
  return prefix + std::to_string(number);
}

std::string problem(const std::string& domain, const std::string& objects, const std::string& init,
                    const std::string& goal, const std::string& metric = "") {
  return "(define (problem generated) (:domain " + domain + ")\n(:objects " + objects + ")\n(:init " + init +
         ")\n(:goal " + goal + ")" + metric + ")\n";
}

}  // namespace

Instance logistics(int objects) {
  const int places = std::max(3, objects / 20);
  const int trucks = std::max(1, objects / 50);
  const int packages = std::max(1, objects - places - trucks);
  // Every truck serves a district of ten places; districts do not meet.
  std::string init, goal = "(and";
  for (int i = 0; i + 1 < places; ++i) {
    if (i % 10 == 9) continue;
    init += "(road " + name("p", i) + " " + name("p", i + 1) + ")(road " + name("p", i + 1) + " " +
            name("p", i) + ")";
  }
  for (int t = 0; t < trucks; ++t) init += "(at " + name("t", t) + " " + name("p", t * 10 % places) + ")";
  for (int k = 0; k < packages; ++k) {
    const int from = k * 7 % places;
    init += "(at " + name("k", k) + " " + name("p", from) + ")";
    if (k % 5 == 0) goal += " (at " + name("k", k) + " " + name("p", from / 10 * 10) + ")";
  }
  return {"logistics", R"((define (domain logistics) (:requirements :strips :typing)
  (:types place thing - object truck package - thing)
  (:predicates (at ?x - thing ?p - place) (in ?k - package ?t - truck) (road ?a ?b - place))
  (:action drive :parameters (?t - truck ?a ?b - place) :precondition (and (at ?t ?a) (road ?a ?b))
    :effect (and (not (at ?t ?a)) (at ?t ?b)))
  (:action load :parameters (?k - package ?t - truck ?p - place) :precondition (and (at ?k ?p) (at ?t ?p))
    :effect (and (not (at ?k ?p)) (in ?k ?t)))
  (:action unload :parameters (?k - package ?t - truck ?p - place) :precondition (and (in ?k ?t) (at ?t ?p))
    :effect (and (not (in ?k ?t)) (at ?k ?p)))))",
          problem("logistics",
                  numbered("p", places) + " - place" + numbered("t", trucks) + " - truck" +
                      numbered("k", packages) + " - package",
                  init, goal + ")")};
}

Instance grid(int objects) {
  const int side = std::max(3, static_cast<int>(std::sqrt(objects)));
  const auto cell = [&](int x, int y) { return name("c", y * side + x); };
  std::string init = "(at r " + cell(0, 0) + ")";
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (x + 1 < side)
        init += "(next " + cell(x, y) + " " + cell(x + 1, y) + ")(next " + cell(x + 1, y) + " " + cell(x, y) +
                ")";
      if (y + 1 < side)
        init += "(next " + cell(x, y) + " " + cell(x, y + 1) + ")(next " + cell(x, y + 1) + " " + cell(x, y) +
                ")";
      if ((x * 3 + y * 5) % 7 == 1 && x + 1 < side && y > 0) init += "(blocked " + cell(x, y) + ")";
    }
  }
  return {"grid", R"((define (domain grid) (:requirements :adl) (:types robot cell)
  (:predicates (at ?r - robot ?c - cell) (next ?a ?b - cell) (blocked ?c - cell) (seen ?c - cell))
  (:action move :parameters (?r - robot ?a ?b - cell)
    :precondition (and (at ?r ?a) (next ?a ?b) (not (blocked ?b)))
    :effect (and (not (at ?r ?a)) (at ?r ?b) (seen ?b)))))",
          problem("grid", "r - robot" + numbered("c", side * side) + " - cell", init,
                  "(and (seen " + cell(side - 1, 1) + ") (at r " + cell(0, 0) + "))")};
}

Instance blocks(int objects) {
  std::string init = "(handempty)";
  for (int b = 0; b < objects; ++b) {
    init +=
        b % 4 == 0 ? "(ontable " + name("b", b) + ")" : "(on " + name("b", b) + " " + name("b", b - 1) + ")";
    if (b % 4 == 3 || b == objects - 1) init += "(clear " + name("b", b) + ")";
  }
  return {"blocks", R"((define (domain blocks) (:requirements :strips)
  (:predicates (on ?x ?y) (ontable ?x) (clear ?x) (handempty) (holding ?x))
  (:action pick-up :parameters (?x) :precondition (and (clear ?x) (ontable ?x) (handempty))
    :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))
  (:action put-down :parameters (?x) :precondition (holding ?x)
    :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x)))
  (:action stack :parameters (?x ?y) :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))
  (:action unstack :parameters (?x ?y) :precondition (and (on ?x ?y) (clear ?x) (handempty))
    :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y))))))",
          problem("blocks", numbered("b", objects), init, "(on b0 b1)")};
}

Instance tanks(int objects) {
  const int levels = 10;
  const int vehicles = std::max(1, objects / 20);
  const int tanks = std::max(2, objects - levels - vehicles);
  std::string init, goal = "(and";
  for (int l = 0; l < levels; ++l) init += "(= (amount " + name("l", l) + ") " + std::to_string(l + 1) + ")";
  for (int v = 0; v < vehicles; ++v) {
    init += "(at " + name("v", v) + " " + name("d", v % tanks) + ")(= (on-board " + name("v", v) + ") 4)";
  }
  for (int t = 0; t < tanks; ++t) {
    init += "(= (level " + name("d", t) + ") " + std::to_string(t % 7) + ")";
    for (const int to : {(t + 1) % tanks, (t + 3) % tanks}) {
      init += "(= (distance " + name("d", t) + " " + name("d", to) + ") 2)(road " + name("d", t) + " " +
              name("d", to) + ")";
    }
    if (t % 4 == 0) goal += " (>= (level " + name("d", t) + ") 5)";
  }
  return {"tanks",
          R"((define (domain tanks) (:requirements :typing :numeric-fluents) (:types vehicle tank amount)
  (:predicates (at ?v - vehicle ?t - tank) (road ?a ?b - tank))
  (:functions (on-board ?v - vehicle) (level ?t - tank) (amount ?l - amount) (distance ?a ?b - tank) (travelled))
  (:action move :parameters (?v - vehicle ?a ?b - tank) :precondition (and (at ?v ?a) (road ?a ?b))
    :effect (and (not (at ?v ?a)) (at ?v ?b) (increase (travelled) (distance ?a ?b))))
  (:action draw :parameters (?v - vehicle ?t - tank ?l - amount)
    :precondition (and (at ?v ?t) (>= (level ?t) (amount ?l)) (<= (+ (on-board ?v) (amount ?l)) 10))
    :effect (and (decrease (level ?t) (amount ?l)) (increase (on-board ?v) (amount ?l))))
  (:action pour :parameters (?v - vehicle ?t - tank ?l - amount)
    :precondition (and (at ?v ?t) (>= (on-board ?v) (amount ?l)) (<= (+ (level ?t) (amount ?l)) 10))
    :effect (and (increase (level ?t) (amount ?l)) (decrease (on-board ?v) (amount ?l))))))",
          problem("tanks",
                  numbered("v", vehicles) + " - vehicle" + numbered("d", tanks) + " - tank" +
                      numbered("l", levels) + " - amount",
                  init + "(= (travelled) 0)", goal + ")", "(:metric minimize (travelled))")};
}

Instance power(int objects) {
  std::string init = "(source s0)";
  for (int i = 0; i + 1 < objects; ++i) {
    init += "(wire " + name("s", i) + " " + name("s", i + 1) + ")";
    if (i % 9 == 0) init += "(wire " + name("s", i) + " " + name("s", i / 2) + ")";
  }
  return {
      "power", R"((define (domain power) (:requirements :adl :derived-predicates) (:types switch)
  (:predicates (source ?s - switch) (wire ?a ?b - switch) (closed ?s - switch) (live ?s - switch))
  (:derived (live ?s) (and (closed ?s) (or (source ?s) (exists (?b - switch) (and (wire ?b ?s) (live ?b))))))
  (:action close :parameters (?s - switch) :precondition (not (closed ?s)) :effect (closed ?s))
  (:action open :parameters (?s - switch) :precondition (and (closed ?s) (not (live ?s)))
    :effect (not (closed ?s)))))",
      problem("power", numbered("s", objects) + " - switch", init, "(live " + name("s", objects - 1) + ")")};
}

std::vector<Generator> generators() {
  return {logistics, grid, blocks, tanks, power};
}

}  // namespace stepwright::bench::grounding
