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

  // Of a FOR: the locals of the limit and of the step; not used where they are constants.
  struct Counter {
    writer::LocalId limit;
    writer::LocalId step;
  };
  struct Turn {
    writer::Label start;
    writer::Label exit;
    bool ends = false;  // TRUE on the stack ends the loop; else it goes on
  };

  source::Position last_slot() const;
  void block(const semantics::Block& statements);
  void statement(const semantics::Statement& statement);
  void instance(const semantics::Statement& statement);
  void branches(const semantics::Statement& statement);
  void select(const semantics::Statement& statement);
  void case_test(const semantics::CaseRange& range, writer::LocalId selector, const semantics::Type& type);
  // for_loop.cpp
  void count(const semantics::Statement& statement);
  void count_by_constant(const semantics::Statement& statement);
  void count_by_value(const semantics::Statement& statement);
  // Pushes whether the constant step leads past the limit. `limit` is the local that holds it.
  void push_last(const semantics::Statement& statement, writer::LocalId limit);
  // Pushes whether the variable, or the value that comes next, has not passed the limit.
  void push_within(const semantics::Statement& statement, const Counter& counter, bool next);
  void push_within(const semantics::Statement& statement, const Counter& counter, bool next, bool upwards);
  void push_step_fits(const semantics::Statement& statement, const Counter& counter, bool upwards);
  void push_step(const semantics::Statement& statement, const Counter& counter);
  void push_next(const semantics::Statement& statement, const Counter& counter);
  // Takes the answer from the stack whether the loop goes on or ends: steps and turns, or leaves the loop.
  void step_on(const semantics::Statement& statement, const Counter& counter, const Turn& turn);
  void release(const Loop& loop, const semantics::Type& type);
  void leave_in_range(const semantics::Statement& statement, const Counter& counter, writer::Label exit);
  void while_loop(const semantics::Statement& statement);
  void repeat_loop(const semantics::Statement& statement);
  void body(const semantics::Statement& statement, const Loop& loop);
  void label(std::uint32_t label);
  void leave();
  bool has_slot_result() const { return pou_.result != nullptr && pou_.result->is_scalar(); }

  const semantics::Pou& pou_;
  writer::FunctionBuilder b_;
  ContainerLimits& limits_;
  ExpressionEmitter e_;
  std::vector<Loop> loops_;
  std::vector<writer::Label> labels_;
};

}  // namespace stepwright::codegen
