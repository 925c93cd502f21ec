#pragma once

// The order in which the variables of one scope are declared: a constant may stand behind what names it in a
// bound, a length or a first value.

#include <cstddef>
#include <span>
#include <vector>

#include "ladder/semantics/analysis/analysis.h"
#include "ladder/syntax/declaration.h"

namespace stepwright::semantics::internal {

using Lines = std::span<const syntax::VariableDeclaration* const>;

struct ConstantOrder {
  // Indexes of the lines: each behind the constants that it names, else as they were written.
  std::vector<std::size_t> order;
  // By index: the line names itself through others, which was reported; it comes before them.
  std::vector<bool> broken;
};

// `types`: what the lines may use and where constants of this scope may be named, too; empty for a POU, whose
// constants no TYPE sees.
ConstantOrder constant_order(Analysis& analysis, Lines lines, std::span<const syntax::TypeDeclaration> types);

}  // namespace stepwright::semantics::internal
