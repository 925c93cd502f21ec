#pragma once

// The conditions of a drawn chart as a reader sees them: without the wires that their evaluation needs.
//
// Each wire is replaced by the expression of its value, a function by a call of ST. Every condition is
// complete, so that a shared expression is written out in each. A wire that cannot be written so (feedback, a
// function under an EN, too long a text) is a connector, >1>. Not to be compiled.
//
//   ShownConditions shown(networks);
//   transition.condition = shown.drawn(transition.condition);  // __W1_  ->  GT(DIV(10, d), 2) AND ready

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "ladder/graphic/ladder_program.h"

namespace stepwright::lowering {

class ShownConditions {
 public:
  // `networks`: all that the conditions read, in the order in which it runs. Texts must not bear marks.
  explicit ShownConditions(const graphic::LadderProgram& networks);

  graphic::Condition drawn(graphic::Condition condition);

 private:
  void define(const graphic::Rung& rung);
  void define(const std::string& wire, graphic::Condition value);
  // Null if the word is no wire whose value is known.
  const graphic::Condition* value_of(const std::string& word) const;
  std::string text(const std::string& st);
  std::string call(const graphic::Block& block);

  std::set<std::string> wires_;
  std::set<std::string> keeping_;
  std::map<std::string, graphic::Condition> values_;
  std::map<std::string, std::size_t> connectors_;
};

}  // namespace stepwright::lowering
