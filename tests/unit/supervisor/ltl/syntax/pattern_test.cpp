#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "supervisor/ltl/syntax/formula.h"
#include "tests/unit/supervisor/ltl/dwyer_patterns.h"

namespace stepwright::ltl {
namespace {

bool same(const std::string& words, const std::string& text) {
  const auto both = parse_formula("(" + words + ") -> (" + text + ")");
  if (!both) ADD_FAILURE() << words << "\n" << result::to_string(both.error());
  if (!both) return false;
  const SyntaxNode& root = both->tree.nodes[both->tree.root];
  return both->positive[root.children[0]] == both->positive[root.children[1]];
}

TEST(Pattern, Formula_WhenWrittenInWords_ThenItIsThatOfTheCatalogue) {
  const std::vector<std::string> scopes = {
      "globally: ", "before r: ", "after q: ", "between q and r: ", "after q until r: "};
  const std::vector<std::pair<std::string, std::size_t>> patterns = {
      {"absent p", 0}, {"exists p", 5}, {"holds p", 15}, {"s precedes p", 20}, {"s responds to p", 25}};
  for (const auto& [words, first] : patterns) {
    EXPECT_TRUE(same(words, test::kDwyerPatterns[first])) << words;
    for (std::size_t k = 0; k < scopes.size(); ++k)
      EXPECT_TRUE(same(scopes[k] + words, test::kDwyerPatterns[first + k])) << scopes[k] << words;
  }
}

TEST(Pattern, Catalogue_WhenClassified_ThenAsTheOperatorsSay) {
  std::vector<int> counts(4, 0);
  for (const char* text : test::kDwyerPatterns) {
    const auto formula = parse_formula(text);
    ASSERT_TRUE(formula) << text;
    ++counts[static_cast<std::size_t>(classify(formula->terms, formula->root))];
  }
  EXPECT_EQ(counts, (std::vector<int>{1, 11, 11, 32}));  // co-safe, safe, mix, neither
}

}  // namespace
}  // namespace stepwright::ltl
