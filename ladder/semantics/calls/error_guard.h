#pragma once

// Calls of standard functions whose ENO is connected: where one would be an error, it is not run.
//
// Thread rule: one analysis, one thread.

#include <vector>

#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

class ErrorGuard {
 public:
  ErrorGuard(Analysis& analysis, ExpressionAnalyzer& expressions, Pou& pou)
      : a_(analysis), e_(expressions), pou_(pou) {}

  // The call, whose value is the first of its type where it would be an error; `enabled` says which.
  ValuePtr unless_error(ValuePtr called, const Place& enabled);
  // Adds to `enabled` what is computed if it is enabled, and the first value of its type, which stands for it
  // if it is not.
  void add_or_first(Value& enabled, ValuePtr called);

 private:
  ValuePtr kept_aside(ValuePtr value, std::vector<CopyBefore>& before);

  Analysis& a_;
  ExpressionAnalyzer& e_;
  Pou& pou_;
};

}  // namespace stepwright::semantics::internal
