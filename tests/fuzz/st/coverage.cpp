#include "tests/fuzz/st/coverage.h"

#include "runtime/bytecode/trap.h"
#include "tests/fuzz/st/extras/extra.h"

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
    ":=",     "copy", "block call", "call with VAR_IN_OUT or =>",
    "IF",     "CASE", "FOR",        "WHILE",
    "REPEAT", "EXIT", "CONTINUE",   "RETURN",
    "text",
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

void Coverage::walk(const Pou& pou) {
  walk(pou.body);
  if (!pou.chart.empty()) has_construct_.insert("chart");
  for (const Action& each : pou.actions) walk(each.body);
}

void Coverage::walk(const Statements& statements) {
  for (const Statement& each : statements) {
    if (each.construct != nullptr) has_construct_.insert(each.construct);
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
  has_construct_.clear();
  for (const Pou& each : program.pous) walk(each);
  if (!program.configuration.empty()) has_construct_.insert("several tasks");
  for (const std::string& each : has_construct_) ++constructs_[each];
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
    if (statements_[i] == 0 && (whole_ || i != static_cast<std::size_t>(StatementKind::Text)))
      out += std::string(kStatementNames[i]) + " ";
  if (!whole_) return out;
  std::vector<std::string> wanted = {"chart", "several tasks"};
  for (const auto& each : all_extras()) wanted.emplace_back(each->name());
  for (const std::string& each : wanted)
    if (!constructs_.contains(each)) out += each + " ";
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
  for (const auto& [name, count] : constructs_) out += ", " + name + " " + share(count);
  out += "\n  trapped in the first scan " + share(first_traps_) + "; ended with";
  for (std::size_t i = 0; i < traps_.size(); ++i)
    if (traps_[i] != 0)
      out += std::string(" ") + (i == 0 ? "no trap" : bytecode::name_of(static_cast<bytecode::TrapCode>(i))) +
             ": " + std::to_string(traps_[i]) + ";";
  return out + "\n";
}

}  // namespace stepwright::st_fuzz
