#pragma once

// An expression of a plant's file, by muParser: numbers, names, + - * / ^, comparisons, a ? b : c, and sin
// cos tan exp ln sqrt abs min max and the like.
//
// Thread rule: one thread at a time; after create() value() allocates nothing. The variables must outlive it.

#include <memory>
#include <string>
#include <vector>

#include "plant_models/components/unit.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

struct Variable {
  std::string name;
  Dimension dimension{};
  double* place = nullptr;
};

class Expression {
 public:
  // Fails with C0349 at `where`: it cannot be read, or names what is not there.
  [[nodiscard]] static result::Result<Expression> create(const std::string& text,
                                                         const std::vector<Variable>& variables,
                                                         const result::Location& where);
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  // Of the variables as they are. NaN where it has none.
  double value() const;

  // Names of the variables that it reads.
  std::vector<std::string> reads() const;

 private:
  struct State;
  explicit Expression(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// Whether the expression has the dimension. An equation of physics holds in any units (Buckingham, 1914):
// when all variables are said in others, its value must change as the dimension says. Tries that for each
// base unit at several values, which it leaves in the variables. A literal number has no dimension. Fails
// with C0341 at `where`.
[[nodiscard]] result::Result<void> check_dimension(const Expression& expression,
                                                   const std::vector<Variable>& variables,
                                                   const Dimension& wanted, const std::string& what,
                                                   const result::Location& where);

}  // namespace stepwright::components
