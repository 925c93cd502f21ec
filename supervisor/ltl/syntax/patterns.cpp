#include "supervisor/ltl/syntax/patterns.h"

namespace stepwright::ltl {

namespace {

class Writer {
 public:
  Writer(SyntaxTree& tree, const Scope& scope, Place at) : tree_(tree), scope_(scope), at_(at) {}

  // G !p; F r -> (!p U r); G(q -> G !p); G((q & !r & F r) -> (!p U r)); G((q & !r) -> (!p W r)). Universality
  // is the absence of the contrary.
  SyntaxId absence(SyntaxId good) {
    const SyntaxId r = scope_.end;
    switch (scope_.kind) {
      case ScopeKind::Globally:
        return always(good);
      case ScopeKind::Before:
        return implies(eventually(r), until(good, r));
      case ScopeKind::After:
        return always(implies(scope_.begin, always(good)));
      case ScopeKind::Between:
        return always(implies(closed(), until(good, r)));
      case ScopeKind::AfterUntil:
        return always(implies(open(), weak(good, r)));
    }
    return good;
  }

  // F p; !r W (p & !r); G !q | F(q & F p); G((q & !r) -> (!r W (p & !r))); G((q & !r) -> (!r U (p & !r))).
  SyntaxId existence(SyntaxId p) {
    switch (scope_.kind) {
      case ScopeKind::Globally:
        return eventually(p);
      case ScopeKind::Before:
        return weak(no(scope_.end), inside(p));
      case ScopeKind::After:
        return either(always(no(scope_.begin)), eventually(both(scope_.begin, eventually(p))));
      case ScopeKind::Between:
        return always(implies(open(), weak(no(scope_.end), inside(p))));
      case ScopeKind::AfterUntil:
        return always(implies(open(), until(no(scope_.end), inside(p))));
    }
    return p;
  }

  // !p W s; F r -> (!p U (s | r)); G !q | F(q & (!p W s)); G((q & !r & F r) -> (!p U (s | r)));
  // G((q & !r) -> (!p W (s | r))).
  SyntaxId precedence(SyntaxId p, SyntaxId s) {
    const SyntaxId r = scope_.end;
    switch (scope_.kind) {
      case ScopeKind::Globally:
        return weak(no(p), s);
      case ScopeKind::Before:
        return implies(eventually(r), until(no(p), either(s, r)));
      case ScopeKind::After:
        return either(always(no(scope_.begin)), eventually(both(scope_.begin, weak(no(p), s))));
      case ScopeKind::Between:
        return always(implies(closed(), until(no(p), either(s, r))));
      case ScopeKind::AfterUntil:
        return always(implies(open(), weak(no(p), either(s, r))));
    }
    return p;
  }

  // G(p -> F s); F r -> ((p -> (!r U (s & !r))) U r); G(q -> G(p -> F s)); the last two as before.
  SyntaxId response(SyntaxId p, SyntaxId s) {
    const ScopeKind kind = scope_.kind;
    if (kind == ScopeKind::Globally || kind == ScopeKind::After) return absence(implies(p, eventually(s)));
    return absence(implies(p, until(no(scope_.end), inside(s))));
  }

  SyntaxId no(SyntaxId a) { return add(Operator::Not, {a}); }

 private:
  SyntaxId add(Operator op, std::vector<SyntaxId> children) {
    return tree_.add(op, std::move(children), at_);
  }
  SyntaxId both(SyntaxId a, SyntaxId b) { return add(Operator::And, {a, b}); }
  SyntaxId either(SyntaxId a, SyntaxId b) { return add(Operator::Or, {a, b}); }
  SyntaxId implies(SyntaxId a, SyntaxId b) { return add(Operator::Implies, {a, b}); }
  SyntaxId always(SyntaxId a) { return add(Operator::Always, {a}); }
  SyntaxId eventually(SyntaxId a) { return add(Operator::Eventually, {a}); }
  SyntaxId until(SyntaxId a, SyntaxId b) { return add(Operator::Until, {a, b}); }
  SyntaxId weak(SyntaxId a, SyntaxId b) { return add(Operator::WeakUntil, {a, b}); }
  SyntaxId inside(SyntaxId a) { return both(a, no(scope_.end)); }
  SyntaxId open() { return inside(scope_.begin); }
  SyntaxId closed() { return add(Operator::And, {scope_.begin, no(scope_.end), eventually(scope_.end)}); }

  SyntaxTree& tree_;
  const Scope& scope_;
  Place at_;
};

}  // namespace

SyntaxId add_pattern(SyntaxTree& tree, Pattern pattern, const Scope& scope, SyntaxId subject, SyntaxId other,
                     Place at) {
  Writer write(tree, scope, at);
  switch (pattern) {
    case Pattern::Absence:
      return write.absence(write.no(subject));
    case Pattern::Existence:
      return write.existence(subject);
    case Pattern::Universality:
      return write.absence(subject);
    case Pattern::Precedence:
      return write.precedence(subject, other);
    case Pattern::Response:
      return write.response(subject, other);
  }
  return subject;
}

}  // namespace stepwright::ltl
