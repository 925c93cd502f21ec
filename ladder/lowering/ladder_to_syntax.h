#pragma once

// A ladder diagram as statements: the compiler has one tree for every language.
//
// Each rung becomes one line of ST in a generated source named after the POU, so that line 3 of a diagnostic
// or of a trap is rung 3 (a rung that copies a piece of a written source names the places of that source).
// Power flows without branches: a set coil is `v := v OR power`, a reset coil `v := v AND NOT power`. Blocks
// run before the coils of their rung. ENO of a function is that of its call, FALSE if it had no value; that
// of a function block is the power at its EN.
//
// Every text of the diagram is read alone before it goes into a line (syntax/piece.h): a name, a variable, an
// expression or statements, and nothing else. An expression on a contact or in a comparison keeps together as
// if it stood in parentheses. What is not whole is reported and goes nowhere.
//
// Contacts and coils that sense an edge keep the last state in a generated variable `__EDGE<n>`, FALSE at the
// start (as R_TRIG and F_TRIG). Jumps and labels become statements of their own.

#include "ladder/graphic/ladder_program.h"
#include "ladder/syntax/parser.h"

namespace stepwright::lowering {

struct LadderStatements {
  syntax::Statements body;
  std::vector<syntax::VariableDeclaration> variables;  // that the body needs beside those of the POU
};

// The same as text, for a place where statements stand as text (the action of a chart). `prefix` begins the
// names of the variables that it needs.
struct LadderText {
  std::string statements;
  std::vector<graphic::Wire> variables;
  std::vector<std::string> faults;  // texts that are not whole; `statements` is of no use then
};
LadderText ladder_text(const graphic::LadderProgram& ladder, const std::string& prefix);

// "VAR_TEMP __W1 : INT; END_VAR"; what keeps its value is VAR where the POU can.
std::string declaration_of(const graphic::Wire& wire, bool keeps_state);

// `file_name` is what diagnostics call the diagram. `keeps_state` is false for functions: an edge is reported
// there (E0702). Everything else that is wrong is reported when it is parsed and analysed.
LadderStatements ladder_to_syntax(const graphic::LadderProgram& ladder, const std::string& file_name,
                                  bool keeps_state, syntax::SyntaxContext& context);

}  // namespace stepwright::lowering
