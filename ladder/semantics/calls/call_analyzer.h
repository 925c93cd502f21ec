#pragma once

// Calls: of functions as values, of functions and blocks as statements, with their arguments, EN and ENO.
//
// Thread rule: one analysis, one thread. As in ExpressionAnalyzer, null or nothing means that the reason was
// reported.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

class CallAnalyzer {
 public:
  // `pou` is the one of `expressions`; null outside of POUs, where only standard functions can be called.
  CallAnalyzer(Analysis& analysis, ExpressionAnalyzer& expressions, Pou* pou)
      : a_(analysis), e_(expressions), pou_(pou) {}

  // The value of a call; its type is Nothing for a function without a result.
  ValuePtr call(const syntax::Expression& expression);
  // A call as a statement; of a function or of a block.
  std::optional<Statement> call_statement(const syntax::Expression& call);
  // The arguments of a call of the block at out.target, into its copies before and after; false after a
  // report at `where` or in an argument.
  bool pass_arguments(const std::vector<syntax::Argument>& given, const Pou& block, Position where,
                      Statement& out);

 private:
  // call.cpp
  ValuePtr callee(const syntax::Expression& expression);
  ValuePtr function_call(const syntax::Expression& expression, Pou& function);
  std::optional<Statement> block_call(const syntax::Expression& call, const syntax::Expression* path);
  Place part_of_target(const Place& instance, std::uint32_t offset, const Type* type);
  bool block_argument(const Variable& parameter, const syntax::Argument& argument, Statement& out);
  bool pass(const std::vector<const syntax::Argument*>& arguments, const Pou& block, Position where,
            Statement& out);
  void note_callee(const Pou& callee);

  // enabled_call.cpp
  std::optional<Place> enable_slot(const syntax::Expression& call, std::vector<CopyBefore>& before,
                                   std::vector<CopyAfter>& after);
  ValuePtr enabled(ValuePtr called, const syntax::Expression& call);
  Statement enabled_block(Statement called, const syntax::Expression& call);

  // call_arguments.cpp
  // Which parameter each argument means; false after a report.
  bool match_arguments(const syntax::Expression& call, const Pou& pou,
                       std::vector<const syntax::Argument*>& out);
  bool match_given(const std::vector<syntax::Argument>& given, const Pou& pou,
                   std::vector<const syntax::Argument*>& out);
  bool pass_output(const syntax::Argument& argument, Place source, std::vector<CopyAfter>& after,
                   bool any_integer = false);
  ValuePtr input_value(const Variable& parameter, const syntax::Expression& given);
  ValuePtr within_type(ValuePtr integer, const Type& target);
  ValuePtr reference_argument(const syntax::Argument& argument, const Variable& parameter,
                              std::vector<CopyBefore>& before, std::vector<CopyAfter>& after);
  ValuePtr address_of(Place place, Position where);
  static bool is_too_long(const Type& argument, const Type& parameter);
  bool matches_parameter(const Type& argument, const Type& parameter) const;
  std::vector<ValuePtr> bounds_of(const Place& array, Position where);
  bool in_out_argument(const Variable& parameter, const syntax::Argument* argument,
                       const syntax::Expression& call, Value& out);
  bool input_argument(const Variable& parameter, const syntax::Argument* argument,
                      const syntax::Expression& call, Value& out);
  bool output_argument(const Variable& parameter, const syntax::Argument* argument,
                       const syntax::Expression& call, Value& out);

  Analysis& a_;
  ExpressionAnalyzer& e_;
  Pou* pou_;
};

// What Analysis asks for.
ValuePtr value_of_call(Analysis& analysis, ExpressionAnalyzer& expressions, Pou* pou,
                       const syntax::Expression& call);

}  // namespace stepwright::semantics::internal
