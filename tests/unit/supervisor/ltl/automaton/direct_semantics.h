#pragma once

// The semantics of LTL as its definition says, for tests: random formulas, words that end and words that
// repeat. Shares nothing with the library but the text of formulas.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace stepwright::ltl::test {

// Operators are the letters of the text: 'p' a proposition, '!' '&' '|' '^' (xor) '>' '=' 'X' 'F' 'G' 'U' 'R'
// 'W' 'M'.
struct Direct {
  struct Node {
    char op = 'p';
    std::uint32_t left = 0, right = 0, proposition = 0;
  };
  std::vector<Node> nodes;  // operands first; the last is the formula
  int propositions = 2;     // a, b, c ...

  std::uint32_t add(char op, std::uint32_t left, std::uint32_t right, std::uint32_t proposition = 0) {
    nodes.push_back({op, left, right, proposition});
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }

  std::string text(std::uint32_t at) const {
    const Node& n = nodes[at];
    const std::string a = n.op == 'p' ? "" : "(" + text(n.left) + ")";
    switch (n.op) {
      case 'p':
        return std::string(1, static_cast<char>('a' + n.proposition));
      case '!':
      case 'X':
      case 'F':
      case 'G':
        return std::string(1, n.op) + a;
      case '>':
        return a + " -> (" + text(n.right) + ")";
      case '=':
        return a + " <-> (" + text(n.right) + ")";
      case '^':
        return a + " xor (" + text(n.right) + ")";
      default:
        return a + " " + n.op + " (" + text(n.right) + ")";
    }
  }
  std::string text() const { return text(static_cast<std::uint32_t>(nodes.size() - 1)); }

  // Of a word that ends: what its letters satisfy by themselves. Only for negations of propositions.
  bool strongly(const std::vector<std::uint64_t>& word, std::size_t at, std::uint32_t node) const {
    const Node& n = nodes[node];
    if (at >= word.size()) return false;
    const auto left = [&](std::size_t k) { return strongly(word, k, n.left); };
    const auto right = [&](std::size_t k) { return strongly(word, k, n.right); };
    switch (n.op) {
      case 'p':
        return (word[at] >> n.proposition & 1) != 0;
      case '!':
        return !left(at);
      case '&':
        return left(at) && right(at);
      case '|':
        return left(at) || right(at);
      case 'X':
        return left(at + 1);
      case 'F':
        for (std::size_t k = at; k < word.size(); ++k)
          if (left(k)) return true;
        return false;
      case 'U':
        for (std::size_t k = at; k < word.size(); ++k) {
          if (right(k)) return true;
          if (!left(k)) return false;
        }
        return false;
      case 'M':  // left and right together, right until then
        for (std::size_t k = at; k < word.size() && right(k); ++k)
          if (left(k)) return true;
        return false;
      default:
        return false;
    }
  }
  bool strongly(const std::vector<std::uint64_t>& word) const {
    return strongly(word, 0, static_cast<std::uint32_t>(nodes.size() - 1));
  }

  // Of the word whose last `loop` letters repeat for ever: bit k of a set says that a formula holds from
  // position k on.
  bool holds_for_ever(const std::vector<std::uint64_t>& word, std::size_t loop) const {
    const std::size_t size = word.size();
    std::vector<std::uint32_t> sets(nodes.size());
    const std::uint32_t all = (1u << size) - 1;
    const auto after = [&](std::uint32_t set) {
      return (set >> 1) | ((set >> (size - loop) & 1u) << (size - 1));
    };
    // The smallest and the largest solution of S = base | (keep & next S).
    const auto solve = [&](std::uint32_t base, std::uint32_t keep, std::uint32_t from) {
      for (std::uint32_t set = from;;) {
        const std::uint32_t better = base | (keep & after(set));
        if (better == set) return set;
        set = better;
      }
    };
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Node& n = nodes[k];
      const std::uint32_t a = sets[n.left], b = sets[n.right];
      std::uint32_t set = 0;
      switch (n.op) {
        case 'p':
          for (std::size_t i = 0; i < size; ++i)
            set |= static_cast<std::uint32_t>(word[i] >> n.proposition & 1) << i;
          break;
        case '!':
          set = all & ~a;
          break;
        case '&':
          set = a & b;
          break;
        case '|':
          set = a | b;
          break;
        case '^':
          set = a ^ b;
          break;
        case '=':
          set = all & ~(a ^ b);
          break;
        case '>':
          set = (all & ~a) | b;
          break;
        case 'X':
          set = after(a);
          break;
        case 'F':
          set = solve(a, all, 0);
          break;
        case 'G':
          set = solve(0, a, all);
          break;
        case 'U':
          set = solve(b, a, 0);
          break;
        case 'W':
          set = solve(b, a, all);
          break;
        case 'R':
          set = solve(a & b, b, all);
          break;
        case 'M':
          set = solve(a & b, b, 0);
          break;
        default:
          break;
      }
      sets[k] = set;
    }
    return (sets.back() & 1u) != 0;
  }
};

// A random formula of `operators` operators. Co-safe ones negate propositions only and have no
// G, R, W.
inline std::uint32_t add_random(Direct& direct, std::mt19937& random, int operators, bool cosafe) {
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  if (operators <= 0) {
    const std::uint32_t p = direct.add('p', 0, 0, static_cast<std::uint32_t>(pick(direct.propositions)));
    return pick(2) == 0 ? p : direct.add('!', p, 0);
  }
  const std::string choices = cosafe ? "&|&|XFFUUM" : "&|^=>!XFGUURWM";
  const char op = choices[static_cast<std::size_t>(pick(static_cast<int>(choices.size())))];
  if (op == '!' || op == 'X' || op == 'F' || op == 'G') {
    const std::uint32_t inner = add_random(direct, random, operators - 1, cosafe);
    return direct.add(op, inner, 0);
  }
  const int share = pick(operators);
  const std::uint32_t left = add_random(direct, random, share, cosafe);
  const std::uint32_t right = add_random(direct, random, operators - 1 - share, cosafe);
  return direct.add(op, left, right);
}

}  // namespace stepwright::ltl::test
