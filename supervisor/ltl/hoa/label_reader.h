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
      : _scanner(scanner), _diagram(diagram), _limits(limits) {}

  void set_propositions(std::size_t count) { _propositions = count; }
  void add_alias(const std::string& name, Diagram::Node label) { _aliases[name] = label; }
  Diagram::Node read() { return several(0, false); }

 private:
  Diagram::Node several(std::size_t depth, bool all);
  Diagram::Node one(std::size_t depth);

  HoaScanner& _scanner;
  Diagram& _diagram;
  const HoaLimits& _limits;
  std::size_t _propositions = 0;
  std::map<std::string, Diagram::Node> _aliases;
};

}  // namespace stepwright::ltl
