#pragma once

// The values on the wires of drawn function blocks from the values of one scan: outputs of instances are
// known, functions are computed, what leads back to itself is open.
//
//   DiagramFlow flow(diagram, evaluator, lookup);
//   Value wire = flow.of(3, "OUT");
//
// For one scan; it keeps what it has computed. One thread.

#include <map>
#include <set>
#include <string>
#include <utility>

#include "hmi_web/monitor/evaluator.h"
#include "hmi_web/monitor/sheet.h"

namespace stepwright::monitor {

class DiagramFlow {
 public:
  // All outlive it.
  DiagramFlow(const Diagram& diagram, const Evaluator& evaluator, const Lookup& lookup)
      : diagram_(diagram), evaluator_(evaluator), lookup_(lookup) {}

  // What leaves an element by an output.
  Value of(std::size_t element, const std::string& output);

 private:
  using Place = std::pair<std::size_t, std::string>;

  Value at(const Pin& pin);
  Value first(const Element& element);
  Value compute(const Element& element, const std::string& output);
  Value block(const Element& element, const std::string& output);
  Value variable(const Element& element) const;

  // Of wires one behind another: a longer way is left open.
  static constexpr std::size_t kDeepest = 1'000;

  const Diagram& diagram_;
  const Evaluator& evaluator_;
  const Lookup& lookup_;
  std::map<Place, Value> known_;
  std::set<Place> running_;
};

}  // namespace stepwright::monitor
