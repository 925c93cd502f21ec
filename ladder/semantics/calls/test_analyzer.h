#pragma once

// The statements that only a TEST has. Waits are lowered here: what must outlive one (the place to go on, the
// limits of FOR loops) lies in the instance of the test, see test_case.h.

#include <map>
#include <utility>

#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

// ADVANCE_TIME, RUN_SCANS, ASSERT_...; upper case.
bool is_test_statement(const std::string& folded);

class TestAnalyzer {
 public:
  // Requires the POU of a test. All must outlive this.
  TestAnalyzer(Analysis& analysis, Pou& pou, ExpressionAnalyzer& expressions)
      : a_(analysis), pou_(pou), expressions_(expressions) {}

  // A call whose name is_test_statement; nothing after a report.
  std::optional<Statement> statement(const syntax::Expression& call);

  // A FOR loop that a wait leaves and enters again.
  Statement across_waits(Statement loop);
  std::uint32_t waits() const { return waits_; }
  // Goes to where the last wait left off. Stands before the body.
  Statement dispatch() const;

 private:
  struct Form;
  struct Operands;
  static const Form* find(const std::string& folded);
  friend bool is_test_statement(const std::string& folded);

  // test_analyzer.cpp
  bool match(const syntax::Expression& call, const Form& form, std::vector<const syntax::Argument*>& out);
  std::optional<Statement> wait(const Form& form, const syntax::Expression& call,
                                const std::vector<const syntax::Argument*>& arguments);
  TestEvent& add_event(const Form& form, const syntax::Expression& call);
  Place header(std::uint32_t offset, const Type* type) const;
  Place hidden(const Type* type, std::size_t role);
  Place fresh(const Type* type);
  Statement leave_with_event(Position where) const;

  // assertion.cpp
  std::optional<Statement> assertion(const Form& form, const syntax::Expression& call,
                                     const std::vector<const syntax::Argument*>& arguments);
  bool read_operands(const Form& form, const syntax::Expression& call,
                     const std::vector<const syntax::Argument*>& arguments, Operands& out);
  bool compare(const Form& form, Operands& operands);
  bool compare_near(const syntax::Expression& call, Operands& operands);
  ValuePtr keep(ValuePtr value, const Type* type, std::size_t role, Operands& operands);

  Analysis& a_;
  Pou& pou_;
  ExpressionAnalyzer& expressions_;
  std::uint32_t waits_ = 0;
  std::map<std::pair<const Type*, std::size_t>, std::uint32_t> hidden_;  // type and role -> offset
};

// How a test statement is written.
struct TestAnalyzer::Form {
  enum class Kind : std::uint8_t { Advance, Scans, Truth, Relation, Near };
  const char* name;
  Kind kind;
  std::vector<const char*> formals;  // the last one of an assertion may be left out
  const char* relation;
  syntax::Operator op;
};

}  // namespace stepwright::semantics::internal
