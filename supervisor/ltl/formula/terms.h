#pragma once

// Formulas of linear temporal logic in negation normal form, each distinct one stored once. A term's operands
// have smaller numbers than the term, so a loop over the numbers visits operands first, however deep a
// formula is.
//
// F, G, W and M are written with the two temporal operators that are left: F a = true U a, G a = false R a,
// a W b = b R (a | b), a M b = b U (a & b).
//
// Thread rule: one thread at a time. Example:
//   Terms terms;
//   const Term reach = terms.until(kTrueTerm, terms.literal(0, false));  // F p0

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace stepwright::ltl {

using Term = std::uint32_t;
inline constexpr Term kFalseTerm = 0;
inline constexpr Term kTrueTerm = 1;

enum class TermKind : std::uint8_t { False, True, Literal, And, Or, Next, Until, Release };

class Terms {
 public:
  Terms();

  Term literal(std::uint32_t proposition, bool negated);
  Term conjunction(std::vector<Term> operands);
  Term disjunction(std::vector<Term> operands);
  Term next(Term operand);
  Term until(Term left, Term right);
  Term release(Term left, Term right);

  // The negation, in the same normal form. May add terms.
  Term dual(Term term);

  std::size_t size() const { return nodes_.size(); }
  TermKind kind(Term term) const { return nodes_[term].kind; }
  std::span<const Term> operands(Term term) const;  // until the next term is added
  std::uint32_t proposition(Term term) const { return nodes_[term].proposition; }
  bool negated(Term term) const { return nodes_[term].negated; }

  // Whether a term has an Until, a Release or a Next anywhere: what its class is read from.
  bool has_until(Term term) const { return nodes_[term].has_until; }
  bool has_release(Term term) const { return nodes_[term].has_release; }
  bool has_next(Term term) const { return nodes_[term].has_next; }

 private:
  struct Node {
    TermKind kind = TermKind::False;
    bool negated = false, has_until = false, has_release = false, has_next = false;
    std::uint32_t proposition = 0;
    std::uint32_t first = 0, count = 0;  // operands in operands_
  };

  Term add(Node node, const std::vector<Term>& operands);
  Term join(TermKind kind, std::vector<Term> operands, Term neutral, Term deciding);
  Term dual_of(Term term);

  std::vector<Node> nodes_;
  std::vector<Term> operands_;
  std::unordered_multimap<std::size_t, Term> index_;
  std::unordered_map<Term, Term> duals_;
};

// What can be said of a formula by its operators in normal form.
enum class Class : std::uint8_t {
  CoSafe,   // no Release: whatever satisfies it does so after finitely many letters
  Safe,     // no Until: whatever violates it does so after finitely many letters
  Mix,      // and, or of co-safe and safe formulas
  Neither,  // an Until inside of a Release or the other way round
};

Class classify(const Terms& terms, Term term);

}  // namespace stepwright::ltl
