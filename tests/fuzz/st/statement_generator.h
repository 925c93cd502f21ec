#pragma once

// Random statements of one POU. Every loop ends: FOR has few turns, WHILE and REPEAT count theirs.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

class StatementGenerator {
 public:
  // `counters`: the variables of loops, one for each level, which nothing else writes.
  StatementGenerator(Random& random, Program& program, Pou& pou, const Scope& scope,
                     std::vector<const Variable*> counters, const std::vector<const Extra*>& extras)
      : random_(random),
        program_(program),
        pou_(pou),
        scope_(scope),
        expressions_(random, program, scope),
        counters_(std::move(counters)),
        extras_(extras),
        material_(random, program, pou, scope, expressions_) {}

  Statements block(int count, int depth);
  // The same without RETURN.
  Statements action(int count);
  Material& material() { return material_; }

 private:
  Statement make(StatementKind kind) { return {.kind = kind, .id = program_.statements++}; }
  void add(Statements& out, int depth);
  void assign(Statements& out);
  bool copy(Statements& out);
  bool call_block(Statements& out);
  bool call_function(Statements& out);
  void branches(Statements& out, int depth);
  void select(Statements& out, int depth);
  std::vector<CaseLabel> labels(const Type& type, std::int64_t& next);
  bool count(Statements& out, int depth);
  void steps(Statement& out, Scalar type);
  bool loop(Statements& out, int depth);
  bool leave(Statements& out);
  bool extra(Statements& out);
  const Way* writable(const Type& type);

  Random& random_;
  Program& program_;
  Pou& pou_;
  const Scope& scope_;
  ExpressionGenerator expressions_;
  std::vector<const Variable*> counters_;
  const std::vector<const Extra*>& extras_;
  Material material_;
  bool may_return_ = true;
  std::size_t loops_ = 0;
};

}  // namespace stepwright::st_fuzz
