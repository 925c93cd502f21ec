#pragma once

// Random expressions of a wanted type. Most are kept from trapping (a divisor that is not zero, an index
// within its bounds), some are not. What the compiler refuses in constants (1 / 0, a[99]) is never made.

#include "tests/fuzz/st/random.h"
#include "tests/fuzz/st/scope.h"

namespace stepwright::st_fuzz {

class ExpressionGenerator {
 public:
  ExpressionGenerator(Random& random, const Program& program, const Scope& scope)
      : random_(random), program_(program), scope_(scope) {}

  // A value to assign to such a variable; a subrange mostly within its bounds.
  ExpressionPtr assignable(const Type& type, int depth);
  // Of exactly this type.
  ExpressionPtr exact(Scalar type, int depth);
  // Of this type or of one that is converted implicitly.
  ExpressionPtr value(Scalar type, int depth);
  // Never outside of the bounds of a subrange (the limits and steps of loops).
  ExpressionPtr bounded(const Type& type, int depth);
  ExpressionPtr literal(Scalar type);
  ExpressionPtr small_literal(Scalar type, std::int64_t low, std::int64_t high);
  ExpressionPtr of_enumeration(const Type& type, int depth);
  // Of exactly this type, and never constant: a loop's variable is there at least.
  ExpressionPtr unknown(Scalar type, int depth);

  Place place(const Way& way, int depth);
  // Of a bit string one of its bits, now and then.
  Place maybe_bit(Place place);
  // Requires a bit string.
  Place bit(Place place);

  const Type* elementary(Scalar type) const { return &program_.types[static_cast<unsigned>(type)]; }

 private:
  ExpressionPtr make(Operation operation, Scalar type);
  ExpressionPtr node(Operation operation, Scalar type, std::vector<ExpressionPtr> operands);
  ExpressionPtr load(Place place);
  ExpressionPtr leaf(Scalar type, int depth);
  ExpressionPtr varying(Scalar type, int depth);  // not constant
  ExpressionPtr divisor(Scalar type, int depth);
  ExpressionPtr index(const Bounds& bounds, int depth);
  ExpressionPtr clamped(ExpressionPtr value, std::int64_t low, std::int64_t high);
  ExpressionPtr convert(ExpressionPtr value, Scalar to);
  ExpressionPtr from_real(Scalar to, int depth);
  ExpressionPtr boolean(int depth);
  ExpressionPtr comparison(int depth);
  ExpressionPtr integer(Scalar type, int depth);
  ExpressionPtr chain(Scalar type);
  ExpressionPtr bit_string(Scalar type, int depth);
  ExpressionPtr real(Scalar type, int depth);
  ExpressionPtr time(int depth);
  ExpressionPtr selection(Scalar type, int depth);
  ExpressionPtr call(Scalar type, int depth);
  ExpressionPtr conversion(Scalar type, int depth);
  ExpressionPtr arithmetic(Operation operation, Scalar type, int depth);

  Random& random_;
  const Program& program_;
  const Scope& scope_;
};

}  // namespace stepwright::st_fuzz
