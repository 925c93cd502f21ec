#include "runtime/bytecode/code_check.h"

#include "runtime/bytecode/instruction.h"
#include "runtime/bytecode/stack_states.h"
#include "runtime/bytecode/trap.h"

namespace stepwright::bytecode {

namespace {

using Status = VerifyStatus;
using State = StackStates::State;

bool fits(std::uint64_t offset, std::uint64_t bytes, std::uint64_t size) {
  return offset <= size && bytes <= size - offset;
}

StackType type_of(char letter) {
  switch (letter) {
    case 'b':
      return StackType::Bool;
    case 'i':
      return StackType::I32;
    case 'l':
      return StackType::I64;
    case 'f':
      return StackType::F32;
    case 'd':
      return StackType::F64;
    default:
      return StackType::Ref;
  }
}

class CodeChecker {
 public:
  CodeChecker(const ContainerView& view, std::uint32_t function, std::span<std::uint32_t> scratch)
      : view_(view),
        function_(view.record<Section::Functions>(function)),
        code_(view.code(function_)),
        image_size_(image_bytes(view.sizes())),
        states_at_(scratch.first(code_.size())),
        stacks_(scratch.subspan(code_.size())) {
    for (State& state : states_at_) state = StackStates::kNone;
  }

  Status run() {
    while (pc_ < code_.size()) {
      Instruction in;
      if (!decode(code_, pc_, in)) return in.size == 0 ? Status::BadOpcode : Status::BadOperand;
      if (const Status status = enter(in); status != Status::Ok) return status;
      if (const Status status = operands(in); status != Status::Ok) return status;
      if (const Status status = effect(in); status != Status::Ok) return status;
      pc_ += in.size;
    }
    return reachable_ ? Status::MissingReturn : Status::Ok;
  }

  std::uint32_t pc() const { return pc_; }
  std::uint32_t max_depth() const { return max_depth_; }

 private:
  // Joins the stack of the instruction before with the stacks of the jumps that lead here.
  Status enter(const Instruction& in) {
    const State expected = states_at_[pc_];
    if (expected != StackStates::kNone) {
      if (reachable_ && state_ != expected) return Status::StackJoin;
      state_ = expected;
    } else if (!reachable_) {
      state_ = StackStates::kEmpty;
    }
    states_at_[pc_] = state_;
    reachable_ = true;
    for (std::uint32_t i = 1; i < in.size; ++i) {
      if (states_at_[pc_ + i] != StackStates::kNone) return Status::BadJump;
    }
    return Status::Ok;
  }

  // What the operands name must exist; memory accesses lie within the image or the instance.
  Status operands(const Instruction& in) const {
    if (in.opcode >= Opcode::LoadBoolAbs && in.opcode <= Opcode::StoreRefInd) return memory_operand(in);
    if (is_fused_boolean(in.opcode)) {
      // `b` is 0 where there is one operand only.
      const std::uint64_t size = is_this_boolean(in.opcode) ? function_.instance_size : image_size_;
      return in.a < size && in.b < size ? Status::Ok : Status::BadAddress;
    }
    switch (in.opcode) {
      case Opcode::LoadBit:
      case Opcode::StoreBit:
        return in.b < 8 && in.a < image_size_ ? Status::Ok : Status::BadAddress;
      case Opcode::AddrAbs:
        return in.a < image_size_ ? Status::Ok : Status::BadAddress;
      case Opcode::AddrThis:
        return in.a < function_.instance_size ? Status::Ok : Status::BadAddress;
      case Opcode::AddrFrame:
        return in.a < function_.frame_size ? Status::Ok : Status::BadAddress;
      case Opcode::IndexDyn:
      case Opcode::Offset:
      case Opcode::MemCopy:
        return in.a <= image_size_ ? Status::Ok : Status::BadAddress;
      case Opcode::Index:
        return operand(in.signed_a() <= in.signed_b() && in.c <= image_size_);
      case Opcode::ConstBool:
        return operand(in.a <= 1);
      case Opcode::CheckI32:
        return operand(in.signed_a() <= in.signed_b());
      case Opcode::CheckI64:
      case Opcode::CheckU64:
        return operand(bounds_in_order(in));
      case Opcode::StringOp:
        return operand(in.a < kStringOpCount);
      case Opcode::ConstI64:
      case Opcode::ConstF64:
        return operand(in.a < view_.count<Section::Constants>());
      case Opcode::LocalGet:
      case Opcode::LocalSet:
        return operand(in.a < function_.local_count);
      case Opcode::RolI32:
      case Opcode::RorI32:
        return operand(in.a == 8 || in.a == 16 || in.a == 32);
      case Opcode::RoundF32:
      case Opcode::RoundF64:
      case Opcode::TruncF32:
      case Opcode::TruncF64:
        return operand(in.a < kIntTypeCount);
      case Opcode::Intrinsic:
        return operand(in.a < kIntrinsicCount);
      case Opcode::Trap:
        return operand(in.a > 0 && in.a < kTrapCodeCount);
      default:
        return Status::Ok;
    }
  }

  static Status operand(bool good) { return good ? Status::Ok : Status::BadOperand; }

  bool bounds_in_order(const Instruction& in) const {
    if (in.a >= view_.count<Section::Constants>() || in.b >= view_.count<Section::Constants>()) return false;
    const std::uint64_t lower = view_.record<Section::Constants>(in.a);
    const std::uint64_t upper = view_.record<Section::Constants>(in.b);
    return in.opcode == Opcode::CheckU64
               ? lower <= upper
               : static_cast<std::int64_t>(lower) <= static_cast<std::int64_t>(upper);
  }

  Status memory_operand(const Instruction& in) const {
    const auto number =
        static_cast<std::uint32_t>(in.opcode) - static_cast<std::uint32_t>(Opcode::LoadBoolAbs);
    const auto type = static_cast<MemType>(number / 3 % kMemTypeCount);
    const auto mode = static_cast<AddressMode>(number % 3);
    if (mode == AddressMode::Ind) return Status::Ok;
    const std::uint64_t size = mode == AddressMode::Abs ? image_size_ : function_.instance_size;
    return fits(in.a, size_of(type), size) ? Status::Ok : Status::BadAddress;
  }

  Status effect(const Instruction& in) {
    switch (in.opcode) {
      case Opcode::LocalGet:
        return push(view_.local_type(function_, in.a));
      case Opcode::LocalSet:
        return pop(view_.local_type(function_, in.a));
      case Opcode::Dup:
        return states_depth() == 0 ? Status::StackUnderflow : push(stacks_.top(state_));
      case Opcode::Drop:
        return states_depth() == 0 ? Status::StackUnderflow : pop(stacks_.top(state_));
      case Opcode::Select:
        return select();
      case Opcode::Intrinsic:
        return simple(kIntrinsics[in.a].pops, kIntrinsics[in.a].pushes);
      case Opcode::StringOp:
        return simple(kStringOps[in.a].pops, kStringOps[in.a].pushes);
      case Opcode::RoundF32:
      case Opcode::TruncF32:
        return to_int(StackType::F32, static_cast<IntType>(in.a));
      case Opcode::RoundF64:
      case Opcode::TruncF64:
        return to_int(StackType::F64, static_cast<IntType>(in.a));
      case Opcode::Jump:
      case Opcode::JumpIfFalse:
      case Opcode::JumpIfTrue:
        return jump(in);
      case Opcode::Call:
        return call(in);
      case Opcode::CallInstanceAbs:
      case Opcode::CallInstanceThis:
      case Opcode::CallInstanceInd:
        return call_instance(in);
      case Opcode::Return:
        return leave();
      case Opcode::Trap:
        reachable_ = false;
        return Status::Ok;
      default:
        return simple(info(in.opcode).pops, info(in.opcode).pushes);
    }
  }

  std::uint32_t states_depth() const { return stacks_.depth(state_); }

  Status pop(StackType type) {
    if (states_depth() == 0) return Status::StackUnderflow;
    if (stacks_.top(state_) != type) return Status::StackType;
    state_ = stacks_.pop(state_);
    return Status::Ok;
  }

  Status push(StackType type) {
    const State next = stacks_.push(state_, type);
    if (next == StackStates::kNone) return Status::ScratchTooSmall;
    state_ = next;
    if (states_depth() > max_depth_) max_depth_ = states_depth();
    return max_depth_ <= kMaxStackSlots ? Status::Ok : Status::TooLarge;
  }

  Status simple(const char* pops, const char* pushes) {
    std::uint32_t count = 0;
    while (pops[count] != '\0') ++count;
    for (; count > 0; --count) {
      if (const Status status = pop(type_of(pops[count - 1])); status != Status::Ok) return status;
    }
    return *pushes == '\0' ? Status::Ok : push(type_of(*pushes));
  }

  Status select() {
    if (const Status status = pop(StackType::Bool); status != Status::Ok) return status;
    if (states_depth() < 2) return Status::StackUnderflow;
    return pop(stacks_.top(stacks_.pop(state_)));
  }

  Status to_int(StackType from, IntType to) {
    const Status status = pop(from);
    return status == Status::Ok ? push(stack_type(to)) : status;
  }

  Status jump(const Instruction& in) {
    if (in.opcode != Opcode::Jump) {
      if (const Status status = pop(StackType::Bool); status != Status::Ok) return status;
    }
    const std::int64_t target = std::int64_t{pc_} + in.size + in.signed_a();
    if (target < 0 || target >= static_cast<std::int64_t>(code_.size())) return Status::BadJump;
    State& there = states_at_[static_cast<std::uint32_t>(target)];
    // What lies before the next instruction has been passed: only its instructions' starts are marked.
    const bool passed = target < std::int64_t{pc_} + in.size;
    if (passed && there == StackStates::kNone) return Status::BadJump;
    if (there != StackStates::kNone && there != state_) return Status::StackJoin;
    there = state_;
    reachable_ = in.opcode != Opcode::Jump;
    return Status::Ok;
  }

  Status call(const Instruction& in) {
    if (in.a >= view_.count<Section::Functions>()) return Status::BadCall;
    const FunctionRecord callee = view_.record<Section::Functions>(in.a);
    if (callee.kind != static_cast<std::uint8_t>(FunctionKind::Function)) return Status::BadCall;
    if (!frame_is_behind(callee)) return Status::BadFrame;
    for (std::uint32_t i = callee.param_count; i > 0; --i) {
      if (const Status status = pop(view_.local_type(callee, i - 1)); status != Status::Ok) return status;
    }
    return callee.result == kNoResult ? Status::Ok : push(static_cast<StackType>(callee.result));
  }

  Status call_instance(const Instruction& in) {
    if (in.a >= view_.count<Section::Functions>()) return Status::BadCall;
    const FunctionRecord callee = view_.record<Section::Functions>(in.a);
    if (callee.kind == static_cast<std::uint8_t>(FunctionKind::Function)) return Status::BadCall;
    if (!frame_is_behind(callee)) return Status::BadFrame;
    if (in.opcode == Opcode::CallInstanceInd) return pop(StackType::Ref);
    const std::uint64_t size = in.opcode == Opcode::CallInstanceAbs ? image_size_ : function_.instance_size;
    return fits(in.b, callee.instance_size, size) ? Status::Ok : Status::BadAddress;
  }

  // What is active together must not share memory; check_tables has seen that no sum overflows.
  bool frame_is_behind(const FunctionRecord& callee) const {
    return callee.frame_offset >= function_.frame_offset + function_.frame_size;
  }

  Status leave() {
    if (function_.result != kNoResult) {
      if (const Status status = pop(static_cast<StackType>(function_.result)); status != Status::Ok)
        return status;
    }
    reachable_ = false;
    return state_ == StackStates::kEmpty ? Status::Ok : Status::StackJoin;
  }

  const ContainerView& view_;
  FunctionRecord function_;
  std::span<const std::byte> code_;
  std::uint64_t image_size_;
  std::span<State> states_at_;
  StackStates stacks_;
  std::uint32_t pc_ = 0;
  State state_ = StackStates::kEmpty;
  bool reachable_ = true;
  std::uint32_t max_depth_ = 0;
};

}  // namespace

CodeCheck check_code(const ContainerView& view, std::uint32_t function, std::span<std::uint32_t> scratch) {
  const auto code_size = view.record<Section::Functions>(function).code_size;
  if (scratch.size() < code_check_words(code_size)) {
    return {{VerifyStatus::ScratchTooSmall, Section::Functions, function, 0}, 0};
  }
  CodeChecker checker(view, function, scratch.first(static_cast<std::size_t>(code_check_words(code_size))));
  const VerifyStatus status = checker.run();
  return {{status, Section::Functions, function, status == VerifyStatus::Ok ? 0 : checker.pc()},
          checker.max_depth()};
}

}  // namespace stepwright::bytecode
