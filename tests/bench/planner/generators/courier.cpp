// Couriers with bags: conditional effects move what is in a bag, quantifiers guard secret papers.

#include <cstdlib>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; Papers travel in bags. A secret paper enters a public room only under seal, and papers are
; handed over only where a clerk is on duty. Quantifiers and conditional effects throughout.
(define (domain courier)
  (:requirements :adl :action-costs)
  (:types paper bag room clerk)
  (:predicates
    (stands ?b - bag ?r - room)
    (lies ?p - paper ?r - room)
    (inside ?p - paper ?b - bag)
    (secret ?p - paper)
    (sealed ?p - paper)
    (public ?r - room)
    (seal-kept ?r - room)
    (on-duty ?k - clerk ?r - room)
    (signed-for ?p - paper))
  (:functions
    (total-cost) - number
    (distance ?a ?b - room) - number)
  (:action carry
    :parameters (?b - bag ?from ?to - room)
    :precondition (and (stands ?b ?from) (not (= ?from ?to))
                       (or (not (public ?to))
                           (forall (?p - paper)
                             (imply (and (inside ?p ?b) (secret ?p)) (sealed ?p)))))
    :effect (and (not (stands ?b ?from)) (stands ?b ?to)
                 (forall (?p - paper)
                   (when (inside ?p ?b) (and (not (lies ?p ?from)) (lies ?p ?to))))
                 (increase (total-cost) (distance ?from ?to))))
  (:action put-in
    :parameters (?p - paper ?b - bag ?r - room)
    :precondition (and (stands ?b ?r) (lies ?p ?r)
                       (not (exists (?other - bag) (inside ?p ?other))))
    :effect (and (inside ?p ?b) (increase (total-cost) 1)))
  (:action take-out
    :parameters (?p - paper ?b - bag ?r - room)
    :precondition (and (stands ?b ?r) (inside ?p ?b))
    :effect (and (not (inside ?p ?b))
                 (when (exists (?k - clerk) (on-duty ?k ?r)) (signed-for ?p))
                 (increase (total-cost) 1)))
  ; One wax, one fire: everything secret in the bag is sealed at once.
  (:action seal
    :parameters (?b - bag ?r - room)
    :precondition (and (stands ?b ?r) (seal-kept ?r))
    :effect (and (forall (?p - paper)
                   (when (and (inside ?p ?b) (secret ?p)) (sealed ?p)))
                 (increase (total-cost) 2)))
  (:action walk
    :parameters (?k - clerk ?from ?to - room)
    :precondition (and (on-duty ?k ?from) (not (on-duty ?k ?to)))
    :effect (and (not (on-duty ?k ?from)) (on-duty ?k ?to)
                 (increase (total-cost) 4))))
)";

struct Courier {
  int bag_at = 0;
  std::vector<std::string> plan;

  void carry(int to) {
    if (bag_at != to) plan.push_back(fmt::format("carry bag1 room{} room{}", bag_at, to));
    bag_at = to;
  }
};

// Rooms on a line; room 1 keeps the seal and is not public, every third room is public.
Draft draft(int size, Random& random) {
  const int rooms = 3 + size, papers = 1 + 2 * size, bags = 1 + size / 3, clerks = 1 + size / 4;
  ProblemText problem(fmt::format("courier-{}", size), "courier");
  problem.objects("room", numbered("room", rooms));
  problem.objects("paper", numbered("paper", papers));
  problem.objects("bag", numbered("bag", bags));
  problem.objects("clerk", numbered("clerk", clerks));
  problem.init("(= (total-cost) 0)");
  problem.init("(seal-kept room1)");
  for (int a = 1; a <= rooms; ++a) {
    if (a % 3 == 0) problem.init("(public room{})", a);
    for (int b = 1; b <= rooms; ++b) {
      if (a != b) problem.init("(= (distance room{} room{}) {})", a, b, std::abs(a - b));
    }
  }
  Courier courier;
  int clerk_at = 0;
  for (int b = 1; b <= bags; ++b) {
    const int room = random.between(1, rooms);
    if (b == 1) courier.bag_at = room;
    problem.init("(stands bag{} room{})", b, room);
  }
  for (int k = 1; k <= clerks; ++k) {
    const int room = random.between(1, rooms);
    if (k == 1) clerk_at = room;
    problem.init("(on-duty clerk{} room{})", k, room);
  }
  for (int p = 1; p <= papers; ++p) {
    const int from = random.between(1, rooms), to = random.between(1, rooms);
    const bool secret = random.below(3) == 0, signed_for = random.below(2) == 0;
    problem.init("(lies paper{} room{})", p, from);
    if (secret) problem.init("(secret paper{})", p);
    problem.goal("(lies paper{0} room{1}) (forall (?b - bag) (not (inside paper{0} ?b)))", p, to);
    if (signed_for) problem.goal("(signed-for paper{})", p);
    courier.carry(from);
    courier.plan.push_back(fmt::format("put-in paper{} bag1 room{}", p, from));
    if (secret) {
      courier.carry(1);
      courier.plan.push_back("seal bag1 room1");
    }
    courier.carry(to);
    if (signed_for && clerk_at != to) {
      courier.plan.push_back(fmt::format("walk clerk1 room{} room{}", clerk_at, to));
      clerk_at = to;
    }
    courier.plan.push_back(fmt::format("take-out paper{} bag1 room{}", p, to));
  }
  problem.metric("minimize (total-cost)");
  return {problem.text(), courier.plan, 0.0};
}

}  // namespace

Generator courier() {
  return {"courier", "ADL: bags that move their papers, seals, clerks", kDomain, {1, 2, 3, 5, 7}, 60, true,
          draft};
}

}  // namespace stepwright::bench
