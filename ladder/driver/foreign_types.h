#pragma once

// Types that a project takes from the system it was written in (HMI_INT, python_eval of Beremiz) and nobody
// declares here. Internal to this folder.

#include <set>
#include <span>
#include <string>
#include <vector>

#include "ladder/syntax/parser.h"

namespace stepwright::driver {

class ForeignTypes {
 public:
  // Both must outlive this; `unit` holds everything that is declared.
  ForeignTypes(const syntax::Unit& unit, syntax::SyntaxContext& context);

  // Reports all unknown types of these variables in one diagnostic (E0203) at the first of them. What is
  // computed from them is let pass then.
  void report(std::span<syntax::VariableDeclaration> variables) const;

 private:
  void collect(syntax::TypeSpec& spec, std::vector<syntax::Name>& missing) const;

  syntax::SyntaxContext& context_;
  std::set<source::NameId> known_;
};

}  // namespace stepwright::driver
