#pragma once

// Bodies of actions and transitions, in any language, as ST: to be compiled, or as a reader sees them.
// Internal to this folder.

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/diagram.h"
#include "ladder/graphic/ladder_program.h"
#include "ladder/lowering/diagram_scope.h"
#include "ladder/syntax/piece.h"

namespace stepwright::lowering {

// The condition of a transition.
struct DrawnCondition {
  graphic::Condition value;
  std::string statements;  // a network that runs before `value` is read, only while the transition is enabled
};

enum class Purpose : std::uint8_t { Compile, Show };

class DrawnBodyText {
 public:
  DrawnBodyText(DiagramScope& scope, Purpose purpose) : scope_(scope), purpose_(purpose) {}

  // Statements of an action.
  std::string statements(const graphic::DiagramBody& body);
  // The condition of a transition: an expression, or what a network writes to the variable `name`.
  DrawnCondition condition(const graphic::DiagramBody& body, const std::string& name);
  // A network that is a condition as statements; empty if it may run in every scan, where it goes then. To be
  // shown, all of them go there: where they run is no business of a reader.
  std::string guarded(graphic::LadderProgram network, std::uint32_t where);

  // Networks that run in every scan for drawn conditions: contacts and their edges.
  graphic::LadderProgram take_networks() { return std::move(networks_); }
  // Variables that the texts need.
  std::vector<graphic::Wire> take_variables() { return std::move(variables_); }

 private:
  std::string ladder_statements(const graphic::DiagramBody& body);
  void sense_edges(graphic::Condition& condition, const graphic::LadderProgram& network);
  bool refuse_jumps(const graphic::LadderProgram& ladder, const graphic::DiagramBody& body, const char* what);
  bool refuse(const graphic::DiagramBody& body);
  graphic::Condition written_condition(const graphic::DiagramBody& body, const std::string& name);
  // "name := a AND b;" and ":= a AND b;" as "a AND b".
  graphic::SourceText expression_of(const graphic::SourceText& text, const std::string& name);

  DiagramScope& scope_;
  Purpose purpose_;
  syntax::PieceReader reader_;
  graphic::LadderProgram networks_;
  std::vector<graphic::Wire> variables_;
};

}  // namespace stepwright::lowering
