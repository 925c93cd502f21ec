#include "tests/fuzz/st/coverage.h"

#include "runtime/bytecode/trap.h"

namespace stepwright::st_fuzz {

namespace {

constexpr const char* kOperationNames[kOperations] = {
    "literal",    "load",  "implicit conversion",
    "conversion", "TRUNC", "call",
    "negation",   "NOT",   "+",
    "-",          "*",     "/",
    "MOD",        "**",    "=",
    "<>",         "<",     ">",
    "<=",         ">=",    "AND",
    "OR",         "XOR",   "AND_THEN",
    "OR_ELSE",    "SHL",   "SHR",
    "ROL",        "ROR",   "ABS",
    "SQRT",       "EXP",   "LN",
    "SIN",        "ATAN",  "MIN",
    "MAX",        "LIMIT", "SEL",
    "MUX",
};

constexpr const char* kStatementNames[kStatementKinds] = {
    ":=",   "copy",     "block call", "call with VAR_IN_OUT or =>", "IF", "CASE", "FOR", "WHILE", "REPEAT",
    "EXIT", "CONTINUE", "RETURN",
};

}  // namespace

void Coverage::walk(const Place& place) {
  for (const Step& step : place.steps)
    for (const auto& index : step.indexes) walk(*index);
}

void Coverage::walk(const Expression& expression) {
  has_operation_[static_cast<unsigned>(expression.operation)] = true;
  if (expression.operation == Operation::Load) walk(expression.place);
  for (const auto& each : expression.operands) walk(*each);
}

void Coverage::walk(const Statements& statements) {
  for (const Statement& each : statements) {
    has_statement_[static_cast<unsigned>(each.kind)] = true;
    if (each.target.variable != nullptr) walk(each.target);
    for (const auto* value : {&each.value, &each.limit, &each.step})
      if (*value) walk(**value);
    for (const Argument& argument : each.arguments)
      if (argument.value) walk(*argument.value);
    for (const Branch& branch : each.branches) {
      if (branch.condition) walk(*branch.condition);
      walk(branch.body);
    }
    walk(each.body);
  }
}

void Coverage::add(const Program& program, const Outcome& outcome) {
  has_operation_ = {};
  has_statement_ = {};
  for (const Pou& each : program.pous) walk(each.body);
  for (std::size_t i = 0; i < kOperations; ++i) operations_[i] += has_operation_[i] ? 1 : 0;
  for (std::size_t i = 0; i < kStatementKinds; ++i) statements_[i] += has_statement_[i] ? 1 : 0;
  ++traps_[outcome.trap];
  if (outcome.trap != 0 && outcome.scans == 1) ++first_traps_;
  ++programs_;
}

std::string Coverage::missing() const {
  std::string out;
  for (std::size_t i = 0; i < kOperations; ++i)
    if (operations_[i] == 0) out += std::string(kOperationNames[i]) + " ";
  for (std::size_t i = 0; i < kStatementKinds; ++i)
    if (statements_[i] == 0) out += std::string(kStatementNames[i]) + " ";
  return out;
}

std::string Coverage::table() const {
  const auto share = [&](unsigned count) { return std::to_string(count * 100 / programs_) + "%"; };
  std::string out = std::to_string(programs_) + " programs, of which have";
  for (std::size_t i = 0; i < kStatementKinds; ++i)
    out += std::string(i == 0 ? " " : ", ") + kStatementNames[i] + " " + share(statements_[i]);
  out += "\n ";
  for (std::size_t i = 0; i < kOperations; ++i)
    out += std::string(i == 0 ? " " : ", ") + kOperationNames[i] + " " + share(operations_[i]);
  out += "\n  trapped in the first scan " + share(first_traps_) + "; ended with";
  for (std::size_t i = 0; i < traps_.size(); ++i)
    if (traps_[i] != 0)
      out += std::string(" ") + (i == 0 ? "no trap" : bytecode::name_of(static_cast<bytecode::TrapCode>(i))) +
             ": " + std::to_string(traps_[i]) + ";";
  return out + "\n";
}

}  // namespace stepwright::st_fuzz
