#include "runtime/native/internal/x86/effect_check.h"
#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;

namespace {

// A constant, or the time, that the next two instructions store: without a branch, which random inputs would
// make the processor guess wrong. Where `kept` holds, what is there is stored again.
bool store_unless(FunctionWork& work, x86::CondCode kept) {
  const auto& items = work.code().items;
  const FunctionCode::Item& push = items[work.item() + 1];
  const FunctionCode::Item& store = items[work.item() + 2];
  const Opcode opcode = push.instruction.opcode;
  const bool constant =
      opcode == Opcode::ConstBool || opcode == Opcode::ConstI32 || opcode == Opcode::ConstF32;
  if ((!constant && opcode != Opcode::Now) || push.is_target || store.is_target) return false;
  if (!is_memory_access(store.instruction.opcode)) return false;
  const MemoryAccess access = memory_access(store.instruction.opcode);
  if (!access.store || access.mode == bytecode::AddressMode::Ind) return false;
  const bool own = access.mode == bytecode::AddressMode::This;
  const Location to = own ? work.of_self(store.instruction.a) : work.absolute(store.instruction.a);
  const std::uint32_t bytes = size_of(access.type);
  const MemoryEffect& effect = work.effect_of(work.item() + 2, true);
  if (work.pinned(effect) != nullptr) return false;

  // Nothing here changes the flags.
  check_access(work, to, effect, bytes);
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  const RegisterId value = operands.allocate(false);
  const x86::Mem memory = operands.memory(to, bytes);
  if (constant) {
    out.mov(gp32(value), push.instruction.a);
  } else {
    out.mov(gp64(value), x86::ptr(kContext, static_cast<std::int32_t>(offsetof(Context, now_ns)), 8));
  }
  bytes < 4 ? out.movzx(gp32(kScratch), memory) : out.mov(general(kScratch, bytes), memory);
  out.emit(x86::Inst::cmovccFromCond(kept), gp64(value), gp64(kScratch));
  operands.before_write(effect.extent);
  out.mov(memory, general(value, bytes));
  operands.registers().release(value);
  return true;
}

class FunctionTranslator {
 public:
  FunctionTranslator(ProgramWork& program, std::uint32_t function)
      : work_(program, function),
        loops_(plan_loops(program.facts, function)),
        labels_(work_.code().items.size()),
        entry_types_(work_.code().items.size()) {}

  void run() {
    const FunctionCode& code = work_.code();
    work_.out().bind(work_.program().functions[work_.function()]);
    const std::uint32_t locals = code.record.local_count;
    for (std::uint32_t i = code.record.param_count; i < locals; ++i) {
      work_.out().mov(work_.operands().memory(work_.local(i), 8), 0);
    }
    for (std::uint32_t i = 0; i < code.items.size(); ++i) {
      if (i < resume_) continue;
      work_.set_item(i);
      begin(i);
      step(code.items[i].instruction);
      reachable_ = !ends_block(code.items[i].instruction.opcode);
      end(i);
    }
    work_.emit_cold();
  }

 private:
  // Joins what runs on from the instruction before with the jumps that lead here.
  void begin(std::uint32_t item) {
    const bool is_target = work_.code().items[item].is_target;
    if (is_target || !reachable_) {
      Operands& operands = work_.operands();
      if (reachable_) {
        operands.store_all();
        entry_types_[item] = operands.types();
      }
      if (is_target) work_.out().bind(label(item));
      operands.begin_block(entry_types_[item]);
    }
    if (next_loop_ < loops_.size() && loops_[next_loop_].first == item) {
      work_.enter_loop(loops_[next_loop_]);
      loop_start_ = work_.out().newLabel();
      work_.out().bind(loop_start_);
      ++next_loop_;
    }
  }

  void end(std::uint32_t item) {
    if (reachable_) check_loop(work_);
    if (work_.loop() == nullptr || work_.loop()->last != item) return;
    if (reachable_) work_.write_back();
    work_.leave_loop();
  }

  void step(const Instruction& in) {
    if (is_jump(in.opcode)) return jump(in);
    const bool known =
        translate_memory(work_, in) || translate_stack(work_, in) || translate_integer(work_, in) ||
        translate_comparison(work_, in) || translate_float(work_, in) || translate_conversion(work_, in) ||
        translate_shift(work_, in) || translate_division(work_, in) || translate_intrinsic(work_, in) ||
        translate_call(work_, in) || translate_library(work_, in);
    assert(known);
    static_cast<void>(known);
  }

  asmjit::Label label(std::uint32_t item) {
    if (!labels_[item].isValid()) labels_[item] = work_.out().newLabel();
    return labels_[item];
  }

  // Where a jump to this instruction goes: around the loads of the loop that it starts, or through the code
  // that leaves the loop.
  asmjit::Label edge(std::uint32_t target) {
    const Loop* const loop = work_.loop();
    if (loop == nullptr) return label(target);
    if (!loop->holds(target)) return work_.leaving(label(target));
    return target == loop->first ? loop_start_ : label(target);
  }

  void jump(const Instruction& in) {
    Operands& operands = work_.operands();
    const std::uint32_t target = work_.code().items[work_.item()].target;
    const std::uint32_t cost = in.signed_a() < 0 ? 0u - in.a : 0;
    if (in.opcode == Opcode::Jump) {
      prepare(target);
      return go(target, cost);
    }
    const bool if_true = in.opcode == Opcode::JumpIfTrue;
    // Storing what lies below could change the flags.
    if (operands.depth() > 1) operands.settle_flags();
    Value condition = operands.pop();
    prepare(target);
    x86::CondCode taken = test(condition);
    if (!if_true) taken = x86::negateCond(taken);
    if (target == work_.item() + 3 && store_unless(work_, taken)) {
      resume_ = target;
      return;
    }
    if (cost == 0) {
      work_.out().j(taken, edge(target));
    } else {
      const asmjit::Label over = work_.out().newLabel();
      work_.out().j(x86::negateCond(taken), over);
      go(target, cost);
      work_.out().bind(over);
    }
  }

  // The operands into their slots, where the target's code expects them.
  void prepare(std::uint32_t target) {
    work_.operands().store_all();
    entry_types_[target] = work_.operands().types();
  }

  void go(std::uint32_t target, std::uint32_t cost) {
    if (cost == 0) {
      work_.out().jmp(edge(target));
      return;
    }
    work_.charge(cost, edge(target));
  }

  // The condition under which the popped value is TRUE.
  x86::CondCode test(Value& condition) {
    Operands& operands = work_.operands();
    x86::Assembler& out = work_.out();
    if (condition.is(Value::Kind::Flags)) return condition.condition;
    const bool inverted = condition.is(Value::Kind::Load) && condition.inverted;
    if (condition.is(Value::Kind::Load)) {
      const x86::Mem byte = operands.memory(condition.location, 1);
      condition.bit == bytecode::kNoBit ? out.cmp(byte, 0) : out.test(byte, 1 << condition.bit);
    } else {
      const RegisterId reg = operands.in_register(condition);
      out.test(gp8(reg), gp8(reg));
    }
    operands.release(condition);
    return inverted ? x86::CondCode::kZero : x86::CondCode::kNotZero;
  }

  FunctionWork work_;
  std::vector<Loop> loops_;
  std::size_t next_loop_ = 0;
  asmjit::Label loop_start_;
  std::vector<asmjit::Label> labels_;
  std::vector<std::vector<StackType>> entry_types_;
  std::uint32_t resume_ = 0;  // instructions before this one are translated
  bool reachable_ = true;
};

}  // namespace

void translate_function(ProgramWork& program, std::uint32_t function) {
  FunctionTranslator(program, function).run();
}

}  // namespace stepwright::native
