#pragma once

// Syntax statements -> checked statements. A statement that is wrong is left out of the result; its reports
// keep the model from reaching codegen.

#include <map>
#include <unordered_map>

#include "ladder/semantics/calls/test_analyzer.h"

namespace stepwright::semantics::internal {

class StatementAnalyzer {
 public:
  StatementAnalyzer(Analysis& analysis, Pou& pou) : a_(analysis), pou_(pou), expressions_(analysis, &pou) {
    if (pou.test != nullptr) test_.emplace(analysis, pou, expressions_);
  }
  StatementAnalyzer(const StatementAnalyzer&) = delete;
  StatementAnalyzer& operator=(const StatementAnalyzer&) = delete;

  // Fills `body` and `label_count` of the POU.
  void body(const syntax::Statements& statements);

 private:
  void collect_labels(const syntax::Statements& statements);
  Block block(const syntax::Statements& statements);
  std::optional<Statement> statement(const syntax::Statement& statement);
  std::optional<Statement> assign(const syntax::Statement& statement);
  // The variable without a type yet that is assigned to; null for any other target.
  Variable* undeduced(const syntax::Expression& target);
  void deduce(Variable& variable, const Type* type, Position where);
  std::optional<Statement> attempt(const syntax::Statement& statement);
  std::optional<Statement> branch(const syntax::Statement& statement);
  std::optional<Statement> select(const syntax::Statement& statement);
  std::optional<Statement> count(const syntax::Statement& statement);
  std::optional<Statement> loop(const syntax::Statement& statement, StatementKind kind, const char* what);
  std::optional<Statement> leave(const syntax::Statement& statement, StatementKind kind);
  std::optional<Statement> jump(const syntax::Statement& statement, StatementKind kind);
  // Values that labels of a CASE name: low -> high of ranges that do not touch each other.
  using Labelled = std::map<__int128, __int128>;
  void case_ranges(const syntax::Branch& branch, const Type* selector, Labelled& seen, Branch& out);

  Analysis& a_;
  Pou& pou_;
  ExpressionAnalyzer expressions_;
  std::unordered_map<std::uint32_t, std::uint32_t> labels_;  // NameId -> label number
  int loops_ = 0;
  std::optional<TestAnalyzer> test_;  // of a TEST
};

}  // namespace stepwright::semantics::internal
