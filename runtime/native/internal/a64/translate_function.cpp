#include "runtime/native/internal/a64/translate.h"

#include <cassert>

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

class FunctionTranslator {
 public:
  FunctionTranslator(ProgramWork& program, std::uint32_t function)
      : work_(program, function),
        labels_(work_.code().items.size()),
        entry_types_(work_.code().items.size()) {}

  void run() {
    const FunctionCode& code = work_.code();
    Assembler& out = work_.out();
    out.bind(work_.program().functions[work_.function()]);
    out.stp(GpX(29), GpX(30), ptr_pre(GpX(GpX::kIdSp), -16));
    for (std::uint32_t i = code.record.param_count; i < code.record.local_count; ++i) {
      out.str(GpX(GpX::kIdZr), work_.local(i));
    }
    for (std::uint32_t i = 0; i < code.items.size(); ++i) {
      work_.set_item(i);
      begin(i);
      step(code.items[i].instruction);
      reachable_ = !ends_block(code.items[i].instruction.opcode);
    }
    work_.emit_cold();
  }

 private:
  // Joins what runs on from the instruction before with the jumps that lead here.
  void begin(std::uint32_t item) {
    const bool is_target = work_.code().items[item].is_target;
    if (!is_target && reachable_) return;
    Operands& operands = work_.operands();
    if (reachable_) {
      operands.store_all();
      entry_types_[item] = operands.types();
    }
    if (is_target) work_.out().bind(label(item));
    operands.begin_block(entry_types_[item]);
  }

  void step(const Instruction& in) {
    if (is_jump(in.opcode)) return jump(in);
    const bool known = translate_memory(work_, in) || translate_stack(work_, in) ||
                       translate_boolean(work_, in) || translate_integer(work_, in) ||
                       translate_comparison(work_, in) || translate_float(work_, in) ||
                       translate_conversion(work_, in) || translate_shift(work_, in) ||
                       translate_call(work_, in) || translate_library(work_, in);
    assert(known);
    static_cast<void>(known);
  }

  asmjit::Label label(std::uint32_t item) {
    if (!labels_[item].isValid()) labels_[item] = work_.out().newLabel();
    return labels_[item];
  }

  void jump(const Instruction& in) {
    const std::uint32_t target = work_.code().items[work_.item()].target;
    const std::uint32_t cost = in.signed_a() < 0 ? 0u - in.a : 0;
    if (in.opcode == Opcode::Jump) {
      prepare(target);
      return go(target, cost);
    }
    CondCode taken = condition();
    if (in.opcode == Opcode::JumpIfFalse) taken = asmjit::arm::negateCond(taken);
    prepare(target);  // leaves the flags as they are
    if (cost == 0) return work_.emit().branch(taken, label(target));
    const asmjit::Label over = work_.out().newLabel();
    work_.out().b(asmjit::arm::negateCond(taken), over);
    go(target, cost);
    work_.out().bind(over);
  }

  // The condition under which the popped value is TRUE.
  CondCode condition() {
    if (const auto flags = work_.take_flags()) return *flags;
    const RegisterId value = work_.operands().pop_register();
    work_.out().cmp(w(value), 0);
    work_.operands().release(value);
    return CondCode::kNE;
  }

  // The operands into their slots, where the target's code expects them.
  void prepare(std::uint32_t target) {
    work_.operands().store_all();
    entry_types_[target] = work_.operands().types();
  }

  void go(std::uint32_t target, std::uint32_t cost) {
    if (cost != 0) work_.charge(cost);
    work_.out().b(label(target));
  }

  FunctionWork work_;
  std::vector<asmjit::Label> labels_;
  std::vector<std::vector<StackType>> entry_types_;
  bool reachable_ = true;
};

}  // namespace

void translate_function(ProgramWork& program, std::uint32_t function) {
  FunctionTranslator(program, function).run();
}

}  // namespace stepwright::native::a64
