#pragma once

// Bodies of actions and transitions, in any language, as ST. Internal to this folder.

#include <string>
#include <vector>

#include "ladder/graphic/diagram.h"
#include "ladder/graphic/ladder_program.h"
#include "ladder/lowering/diagram_scope.h"
#include "ladder/syntax/piece.h"

namespace stepwright::lowering {

class DrawnBodyText {
 public:
  explicit DrawnBodyText(DiagramScope& scope) : scope_(scope) {}

  // Statements of an action.
  std::string statements(const graphic::DiagramBody& body);
  // The condition of a transition: an expression, or what a network writes to the variable `name`.
  graphic::Condition condition(const graphic::DiagramBody& body, const std::string& name);

  // What runs in every scan for conditions that were drawn.
  graphic::LadderProgram take_networks() { return std::move(networks_); }
  // Variables that the texts need.
  std::vector<graphic::Wire> take_variables() { return std::move(variables_); }

 private:
  std::string ladder_statements(const graphic::DiagramBody& body);
  bool refuse(const graphic::DiagramBody& body);
  graphic::Condition written_condition(const graphic::DiagramBody& body, const std::string& name);
  // "name := a AND b;" and ":= a AND b;" as "a AND b".
  graphic::SourceText expression_of(const graphic::SourceText& text, const std::string& name);

  DiagramScope& scope_;
  syntax::PieceReader reader_;
  graphic::LadderProgram networks_;
  std::vector<graphic::Wire> variables_;
};

}  // namespace stepwright::lowering
