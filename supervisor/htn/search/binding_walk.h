#pragma once

// The ways to use a method for a task in a state, one after the other: choices of objects for its variables,
// in the order of the objects, the first variable first.
//
// Thread rule: as the state, which must be the same in every call of `next`. An object may be used again.
//
//   walk.start(method, tests, objects, in);
//   while (walk.next(in)) use(walk.binding());

#include <span>
#include <vector>

#include "supervisor/htn/search/evaluate.h"
#include "supervisor/htn/search/method_tests.h"

namespace stepwright::htn {

class BindingWalk {
 public:
  // `objects` are the task's. False if the method cannot be used.
  bool start(const Method& method, const MethodTests& tests, std::span<const int> objects, State& state,
             const Evaluation& in);

  // The next choice; false if there is none, or the search was interrupted.
  bool next(State& state, const Evaluation& in);

  // The object of each slot.
  const std::vector<int>& binding() const { return binding_; }

 private:
  // A variable's objects, and which of them is next.
  struct Level {
    std::vector<int> own;
    bool of_type = false;  // the type's objects, and not `own`
    std::size_t next = 0;
  };

  bool bind_task(const Method& method, std::span<const int> objects, const Evaluation& in);
  void fill(std::size_t level, State& state, const Evaluation& in);
  bool matches(const OpenVariable& variable, std::span<const int> row) const;

  const MethodTests* tests_ = nullptr;
  std::vector<int> binding_;
  std::vector<Level> levels_;
  std::vector<int> key_;
  std::size_t depth_ = 0;  // of the variable that is chosen next
  bool over_ = true;
};

}  // namespace stepwright::htn
