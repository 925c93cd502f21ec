#pragma once

// Small random hierarchical problems, as text and as what a brute force reads, which shares nothing with the
// planner.

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace stepwright::htn::test {

struct Literal {
  int predicate = 0;
  int argument = -1;  // of a predicate with one: a variable, or 10 + object
  bool positive = true;
};

struct RandomSubtask {
  bool action = false;
  int symbol = 0;
  int argument = -1;  // as of a literal
};

struct RandomAction {
  int parameters = 0;
  std::vector<Literal> condition;
  std::vector<Literal> effect;
};

struct RandomMethod {
  int task = 0;
  int parameters = 0;  // the task's is the first one
  std::vector<Literal> condition;
  std::vector<RandomSubtask> subtasks;
};

struct RandomHtn {
  int objects = 1;
  std::vector<int> arities;  // of predicates: 0 or 1
  std::vector<int> task_arities;
  std::vector<RandomAction> actions;
  std::vector<RandomMethod> methods;
  std::vector<RandomSubtask> root;
  std::vector<Literal> initial;
  std::vector<Literal> goal;
  bool external = false;  // every action and the goal ask (outside)
};

RandomHtn random_htn(std::mt19937& random);
std::string domain_text(const RandomHtn& htn);
std::string problem_text(const RandomHtn& htn);

// Names as in the texts: "a0 o1".
using Sequence = std::vector<std::string>;

struct BruteForce {
  bool solvable = false;
  bool cut = false;      // a network was longer than the bound
  bool complete = true;  // else there were too many nodes
};

// All nodes that can be reached over networks of up to `most` tasks, if they are not too many.
BruteForce explore(const RandomHtn& htn, std::size_t most);

// The actions of all decompositions on which no node comes twice; `complete` is false if there are more steps
// than `most_steps`. With `history`, a node has the actions before it too, and `allowed` says which prefixes
// may be.
struct Enumeration {
  std::set<Sequence> plans;
  bool complete = true;
};
Enumeration enumerate(const RandomHtn& htn, std::size_t most, std::size_t most_steps,
                      bool (*allowed)(const Sequence&) = nullptr);

}  // namespace stepwright::htn::test
