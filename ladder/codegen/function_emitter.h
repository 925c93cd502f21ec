#pragma once

// The statements of one POU as a function. Internal to this folder.

#include <utility>
#include <vector>

#include "ladder/codegen/expression_emitter.h"

namespace stepwright::codegen {

class FunctionEmitter {
 public:
  FunctionEmitter(const ProgramLayout& layout, FileTable& files, const semantics::Pou& pou);

  // The finished function; the emitter is used up.
  writer::Function run() &&;

 private:
  struct Loop {
    writer::Label exit;
    writer::Label next;
    // FOR: what it keeps in locals.
    std::vector<std::pair<const semantics::Value*, writer::LocalId>> kept = {};
  };

  void block(const semantics::Block& statements);
  void statement(const semantics::Statement& statement);
  void instance(const semantics::Statement& statement);
  void branches(const semantics::Statement& statement);
  void select(const semantics::Statement& statement);
  void case_test(const semantics::CaseRange& range, writer::LocalId selector, const semantics::Type& type);
  void count(const semantics::Statement& statement);
  void count_by_constant(const semantics::Statement& statement);
  void count_by_value(const semantics::Statement& statement);
  // Pushes whether the constant step leads past the limit. `limit` is the local that holds it.
  void push_last(const semantics::Statement& statement, writer::LocalId limit);
  void advance(const semantics::Statement& statement, writer::LocalId step);
  void while_loop(const semantics::Statement& statement);
  void repeat_loop(const semantics::Statement& statement);
  void body(const semantics::Statement& statement, const Loop& loop);
  void label(std::uint32_t label);
  void leave();
  bool has_slot_result() const { return pou_.result != nullptr && pou_.result->is_scalar(); }

  const semantics::Pou& pou_;
  writer::FunctionBuilder b_;
  ExpressionEmitter e_;
  std::vector<Loop> loops_;
  std::vector<writer::Label> labels_;
};

}  // namespace stepwright::codegen
