#pragma once

// A formula that was read: its text as a tree, its normal form, and for each part of the text the term that
// it means.
//
// Thread rule: pure functions; a Formula belongs to one thread at a time. Example:
//   auto formula = parse_formula("visit press then visit rack, never wash before unload");

#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/formula/terms.h"
#include "supervisor/ltl/syntax/syntax_tree.h"

namespace stepwright::ltl {

struct Formula {
  SyntaxTree tree;
  Terms terms;
  Term root = kTrueTerm;
  std::vector<Term> positive;  // of each node of the tree: what it means
  std::vector<Term> negative;  // its negation

  std::size_t proposition_count() const { return tree.propositions.size(); }
};

struct TextLimits {
  std::size_t nesting = 1'000;     // parentheses and operators within each other
  std::size_t operators = 20'000;  // of the whole text
  std::size_t propositions = 64;   // a letter is a 64-bit word
};

// Spot's syntax, words and patterns: see supervisor/doc/ltl.md. `propositions` come first in the numbering,
// in their order; others of the text follow as they appear. Errors: L0001 to L0007.
[[nodiscard]] result::Result<Formula> parse_formula(std::string_view text, const std::string& file = {},
                                                    std::vector<std::string> propositions = {},
                                                    const TextLimits& limits = {});

// The first part of the text whose operator keeps the formula from being co-safe: in its place it stands for
// a promise that no finite word can keep. Requires terms.has_release(root).
SyntaxId not_cosafe_part(const Formula& formula);

}  // namespace stepwright::ltl
