#pragma once

// A formula as it was written: operators with their places. Children have smaller numbers than their parents.

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::ltl {

enum class Operator : std::uint8_t {
  False,
  True,
  Name,
  Not,
  And,
  Or,
  Xor,
  Iff,
  Implies,
  Next,
  Eventually,
  Always,
  Until,
  Release,
  WeakUntil,
  StrongRelease,
};

struct Place {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

using SyntaxId = std::uint32_t;

struct SyntaxNode {
  Operator op = Operator::False;
  std::vector<SyntaxId> children;
  std::uint32_t proposition = 0;  // of a Name
  Place at;
};

// A proposition that a timer makes of others, scan by scan; `of` and `answer` speak of one letter each.
enum class TimedKind : std::uint8_t {
  Held,     // `of` has held without a break for so long
  Overdue,  // `of` held so long ago, and since then `answer` has not (nor with it)
  Elapsed,  // so long ago was the first letter
};

struct Timed {
  std::uint32_t proposition = 0;
  TimedKind kind = TimedKind::Held;
  SyntaxId of = 0;
  SyntaxId answer = 0;  // of Overdue
  std::int64_t duration_ns = 0;
  std::string duration = {};  // as it was written: "T#5s"
  Place at = {};
};

struct SyntaxTree {
  std::vector<SyntaxNode> nodes;
  std::vector<std::string> propositions;
  std::vector<Timed> timed;  // one may be made of those before it
  SyntaxId root = 0;

  SyntaxId add(Operator op, std::vector<SyntaxId> children, Place at);
};

// What a timer makes of the proposition; null if it is none of a timer.
const Timed* timed_of(const SyntaxTree& tree, std::uint32_t proposition);

// The operands of the conjunction that the text is, however it is nested; of other formulas the root. In the
// order in which they are written.
std::vector<SyntaxId> conjuncts(const SyntaxTree& tree);

// The formula in Spot's syntax, with as many parentheses as are needed; names in quotes where they are no
// words. What is longer than `most` characters ends in "...".
std::string to_text(const SyntaxTree& tree, SyntaxId from, std::size_t most = 1u << 20);

}  // namespace stepwright::ltl
