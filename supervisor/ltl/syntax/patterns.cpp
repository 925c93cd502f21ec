#include "supervisor/ltl/syntax/patterns.h"

namespace stepwright::ltl {

namespace {

class Writer {
 public:
  Writer(SyntaxTree& tree, const Scope& scope, Place at) : _tree(tree), _scope(scope), _at(at) {}

  // G !p; F r -> (!p U r); G(q -> G !p); G((q & !r & F r) -> (!p U r)); G((q & !r) -> (!p W r)). Universality
  // is the absence of the contrary.
  SyntaxId absence(SyntaxId good) {
    const SyntaxId r = _scope.end;
    switch (_scope.kind) {
      case ScopeKind::Globally:
        return always(good);
      case ScopeKind::Before:
        return implies(eventually(r), until(good, r));
      case ScopeKind::After:
        return always(implies(_scope.begin, always(good)));
      case ScopeKind::Between:
        return always(implies(closed(), until(good, r)));
      case ScopeKind::AfterUntil:
        return always(implies(open(), weak(good, r)));
    }
    return good;
  }

  // F p; !r W (p & !r); G !q | F(q & F p); G((q & !r) -> (!r W (p & !r))); G((q & !r) -> (!r U (p & !r))).
  SyntaxId existence(SyntaxId p) {
    switch (_scope.kind) {
      case ScopeKind::Globally:
        return eventually(p);
      case ScopeKind::Before:
        return weak(no(_scope.end), inside(p));
      case ScopeKind::After:
        return either(always(no(_scope.begin)), eventually(both(_scope.begin, eventually(p))));
      case ScopeKind::Between:
        return always(implies(open(), weak(no(_scope.end), inside(p))));
      case ScopeKind::AfterUntil:
        return always(implies(open(), until(no(_scope.end), inside(p))));
    }
    return p;
  }

  // !p W s; F r -> (!p U (s | r)); G !q | F(q & (!p W s)); G((q & !r & F r) -> (!p U (s | r)));
  // G((q & !r) -> (!p W (s | r))).
  SyntaxId precedence(SyntaxId p, SyntaxId s) {
    const SyntaxId r = _scope.end;
    switch (_scope.kind) {
      case ScopeKind::Globally:
        return weak(no(p), s);
      case ScopeKind::Before:
        return implies(eventually(r), until(no(p), either(s, r)));
      case ScopeKind::After:
        return either(always(no(_scope.begin)), eventually(both(_scope.begin, weak(no(p), s))));
      case ScopeKind::Between:
        return always(implies(closed(), until(no(p), either(s, r))));
      case ScopeKind::AfterUntil:
        return always(implies(open(), weak(no(p), either(s, r))));
    }
    return p;
  }

  // G(p -> F s); F r -> ((p -> (!r U (s & !r))) U r); G(q -> G(p -> F s)); the last two as before.
  SyntaxId response(SyntaxId p, SyntaxId s) {
    const ScopeKind kind = _scope.kind;
    if (kind == ScopeKind::Globally || kind == ScopeKind::After) return absence(implies(p, eventually(s)));
    return absence(implies(p, until(no(_scope.end), inside(s))));
  }

  SyntaxId no(SyntaxId a) { return add(Operator::Not, {a}); }

 private:
  SyntaxId add(Operator op, std::vector<SyntaxId> children) {
    return _tree.add(op, std::move(children), _at);
  }
  SyntaxId both(SyntaxId a, SyntaxId b) { return add(Operator::And, {a, b}); }
  SyntaxId either(SyntaxId a, SyntaxId b) { return add(Operator::Or, {a, b}); }
  SyntaxId implies(SyntaxId a, SyntaxId b) { return add(Operator::Implies, {a, b}); }
  SyntaxId always(SyntaxId a) { return add(Operator::Always, {a}); }
  SyntaxId eventually(SyntaxId a) { return add(Operator::Eventually, {a}); }
  SyntaxId until(SyntaxId a, SyntaxId b) { return add(Operator::Until, {a, b}); }
  SyntaxId weak(SyntaxId a, SyntaxId b) { return add(Operator::WeakUntil, {a, b}); }
  SyntaxId inside(SyntaxId a) { return both(a, no(_scope.end)); }
  SyntaxId open() { return inside(_scope.begin); }
  SyntaxId closed() { return add(Operator::And, {_scope.begin, no(_scope.end), eventually(_scope.end)}); }

  SyntaxTree& _tree;
  const Scope& _scope;
  Place _at;
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
