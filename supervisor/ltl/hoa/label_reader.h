#pragma once

// Labels of edges as decision diagrams of propositions. Private to this library. Thread rule: one thread at a
// time.

#include <map>

#include "supervisor/ltl/automaton/diagram.h"
#include "supervisor/ltl/hoa/hoa.h"
#include "supervisor/ltl/hoa/scanner.h"

namespace stepwright::ltl {

class LabelReader {
 public:
  LabelReader(HoaScanner& scanner, Diagram& diagram, const HoaLimits& limits)
      : scanner_(scanner), diagram_(diagram), limits_(limits) {}

  void set_propositions(std::size_t count) { propositions_ = count; }
  void add_alias(const std::string& name, Diagram::Node label) { aliases_[name] = label; }
  Diagram::Node read() { return several(0, false); }

 private:
  Diagram::Node several(std::size_t depth, bool all);
  Diagram::Node one(std::size_t depth);

  HoaScanner& scanner_;
  Diagram& diagram_;
  const HoaLimits& limits_;
  std::size_t propositions_ = 0;
  std::map<std::string, Diagram::Node> aliases_;
};

}  // namespace stepwright::ltl
