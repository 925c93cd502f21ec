#pragma once

// Calls of the standard functions (IEC 61131-3, 6.6.2.5). Each family has a table of its functions; a call is
// matched with the parameters of the table's row, then typed by its arguments.

#include <span>
#include <string_view>

#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

class StandardAnalyzer {
 public:
  using Values = std::vector<ValuePtr>;

  // A function. Its parameters as "MN IN MX"; "IN1+" stands for IN1, IN2 and so on, at least `least` in all.
  struct Entry {
    std::string_view name;
    std::string_view formals;
    std::size_t least = 0;
    ValuePtr (StandardAnalyzer::*analyse)(const syntax::Expression& call, Values values, int which) = nullptr;
    int which = 0;
    // "ADD_INT": the first parameter that has the type of the name, and how many have; 0 = no such names.
    std::size_t typed_first = 0;
    std::size_t typed_count = 0;
  };

  StandardAnalyzer(Analysis& analysis, ExpressionAnalyzer& expressions) : a_(analysis), e_(expressions) {}

  // The call of a standard function; `known` says whether the name, in upper case, is that of one.
  ValuePtr call(const syntax::Expression& call, const std::string& folded, bool& known);
  // The arguments of a call in the order of the parameters; nothing after a report.
  std::optional<Values> arguments(const syntax::Expression& call, std::string_view formals,
                                  std::size_t least);
  // An integer, cut to the bounds.
  ValuePtr bounded(ValuePtr value, __int128 low, __int128 high);
  // The names of all functions, for hints.
  static void add_names(std::vector<std::string_view>& names);

 private:
  static const Entry* find(std::string_view folded);
  static std::span<const Entry> numeric_entries();
  static std::span<const Entry> operator_entries();
  static std::span<const Entry> selection_entries();
  static std::span<const Entry> bit_entries();
  static std::span<const Entry> time_entries();
  static std::span<const Entry> text_entries();

  // standard_call.cpp
  std::size_t parameter_index(const syntax::Name& formal, std::string_view formals, std::size_t count);
  void wrong_count(const syntax::Expression& call, std::string_view formals, std::size_t least);
  ValuePtr typed_call(const syntax::Expression& call, const Entry& entry, const Type* type);
  // All values from `first` on in one type, which may be that of literals; null after a report.
  const Type* unify(Values& values, std::size_t first, Position where);
  // An ANY_INT argument as DINT, which the machine has; one that does not fit is cut to the bounds, where it
  // has the same effect. Null after a report.
  ValuePtr as_dint(ValuePtr value, __int128 low, __int128 high);
  ValuePtr wrong_operand(const syntax::Expression& call, const Type& type, std::string hint = {});

  // Numbers as values of one real type; false after a report.
  bool as_reals(const syntax::Expression& call, Values& values);
  ValuePtr numeric(const syntax::Expression& call, Values values, int which);
  ValuePtr real_function(const syntax::Expression& call, Values values, int which);
  ValuePtr power(const syntax::Expression& call, Values values, int which);
  ValuePtr truncate(const syntax::Expression& call, Values values, int which);
  ValuePtr is_valid(const syntax::Expression& call, Values values, int which);

  ValuePtr operate(const syntax::Expression& call, Values values, int which);
  ValuePtr compare(const syntax::Expression& call, Values values, int which);
  ValuePtr invert(const syntax::Expression& call, Values values, int which);
  ValuePtr move(const syntax::Expression& call, Values values, int which);

  ValuePtr extremum(const syntax::Expression& call, Values values, int which);
  ValuePtr limit(const syntax::Expression& call, Values values, int which);
  ValuePtr select(const syntax::Expression& call, Values values, int which);
  ValuePtr multiplex(const syntax::Expression& call, Values values, int which);

  ValuePtr shift(const syntax::Expression& call, Values values, int which);
  ValuePtr is_valid_bcd(const syntax::Expression& call, Values values, int which);
  ValuePtr swap_bytes(const syntax::Expression& call, Values values, int which);

  ValuePtr time_operation(const syntax::Expression& call, Values values, int which);
  std::optional<std::uint32_t> text_operands(const syntax::Expression& call, Values& values,
                                             std::size_t texts);
  ValuePtr measure(const syntax::Expression& call, Values values, int which);
  ValuePtr join(const syntax::Expression& call, Values values, int which);
  ValuePtr cut(const syntax::Expression& call, Values values, int which);

  ValuePtr now(const syntax::Expression& call, Values values, int which);
  ValuePtr fail(const syntax::Expression& call, Values values, int which);
  ValuePtr stop(const syntax::Expression& call, Values values, int which);

  Analysis& a_;
  ExpressionAnalyzer& e_;
};

}  // namespace stepwright::semantics::internal
