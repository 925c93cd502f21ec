#pragma once

// One walk over the statements of a POU: counts what its variables are used for and reports what can be seen
// on the way (loops, conditions, assignments).

#include "ladder/lint/internal/uses.h"
#include "ladder/lint/lint.h"

namespace stepwright::lint::internal {

enum class Access : std::uint8_t { Read, Write, Both };

class BodyWalker {
 public:
  // All must outlive the walker. `writes` numbers the writes of the whole program.
  BodyWalker(Uses& uses, std::size_t pou, Level level, std::uint64_t& writes, source::DiagnosticSink& sink)
      : uses_(uses), index_(pou), pou_(*uses.model.pous[pou]), level_(level), writes_(writes), sink_(sink) {}

  void run();

 private:
  // body_walker.cpp
  void statements(const syntax::Statements& list);
  void statement(const syntax::Statement& each);
  void assignment(const syntax::Statement& each);
  void branches(const syntax::Statement& each);
  void count_loop(const syntax::Statement& each);
  void condition_loop(const syntax::Statement& each);
  void enter_loop();
  void leave_loop();

  // expression_walker.cpp
  void expression(const syntax::Expression& each);
  void call(const syntax::Expression& each);
  void argument(const syntax::Argument& each, const semantics::Pou* callee, std::size_t& position);
  void place(const syntax::Expression& each, Access access, bool keeps = false);
  void variable(const syntax::Expression& root, Access access, bool whole, bool keeps);
  void read(VariableUse& use, Position where);
  void write(VariableUse& use, Position where);
  void note_site(VariableUse& use, Position where, bool keeps);
  const semantics::Type* type_of(const syntax::Expression& each);
  const semantics::Pou* callee_of(const syntax::Expression& each);

  // statement_rules.cpp: what one statement shows by itself
  bool speaks_of(Position where) const;
  bool is_constant(const syntax::Expression& each) const;
  bool keeps_value(const syntax::Expression& target, const syntax::Expression& value) const;
  void check_condition(const syntax::Expression& condition);
  void check_effect(const syntax::Statement& assignment);
  void check_empty(const syntax::Statements& body, Position where, const char* what);
  void check_ignored(const syntax::Expression& call);
  // True if something that the condition reads was written since `writes`.
  bool changed_since(const syntax::Expression& condition, std::uint64_t writes);

  struct Loop {
    bool left = false;  // EXIT, RETURN or a jump stands in it
  };

  Uses& uses_;
  std::size_t index_;
  const semantics::Pou& pou_;
  Level level_;
  std::uint64_t& writes_;
  source::DiagnosticSink& sink_;
  std::vector<Loop> loops_;
  std::uint32_t outer_loops_ = 0;       // loops that stand in no other, so far
  std::vector<VariableUse*> doubtful_;  // of the outermost loop that is open
  std::uint64_t last_unknown_ = 0;      // the last write that may have been to any variable
  std::uint64_t last_foreign_ = 0;      // the last call of a POU, which may write globals
  std::uint32_t conditional_ = 0;
};

// Both are written alike: the same variable, the same constant.
bool same(const syntax::Expression& a, const syntax::Expression& b);
// The name or address that a place begins with: `a` of a.b[i].
const syntax::Expression& root_of(const syntax::Expression& place);

}  // namespace stepwright::lint::internal
