#include "runtime/native/internal/memory_effects.h"

#include <cstring>

#include "runtime/native/internal/x86/value.h"

namespace stepwright::native {

namespace {

using bytecode::AddressMode;
using bytecode::Instruction;
using bytecode::MemType;
using bytecode::Opcode;

constexpr Extent kUnknown{};

// Follows addresses through the operand stack; every other operand is unknown.
class EffectScan {
 public:
  EffectScan(const bytecode::ContainerView& view, const FunctionCode& code, const FunctionPlaces& places)
      : view_(view), code_(code), places_(places), depth_at_(code.items.size(), 0) {}

  std::vector<MemoryEffect> run() {
    for (item_ = 0; item_ < code_.items.size(); ++item_) {
      const FunctionCode::Item& item = code_.items[item_];
      if (item.is_target || !reachable_) {
        const std::size_t depth = reachable_ ? stack_.size() : depth_at_[item_];
        stack_.assign(depth, kUnknown);
      }
      reachable_ = true;
      step(item.instruction);
      if (item.target != kNoInstruction) {
        depth_at_[item.target] = static_cast<std::uint32_t>(stack_.size());
      }
      reachable_ = !ends_block(item.instruction.opcode);
    }
    return std::move(effects_);
  }

 private:
  void step(const Instruction& in) {
    if (is_memory_access(in.opcode)) return access(in);
    if (bytecode::is_fused_boolean(in.opcode)) {
      add(bytecode::is_this_boolean(in.opcode) ? places_.own(in.a, 1)
                                               : Extent{Space::Image, in.a, std::uint64_t{in.a} + 1},
          MemType::Bool, true, false);
      return effect(in);
    }
    switch (in.opcode) {
      case Opcode::LoadBit:
      case Opcode::StoreBit:
        add({Space::Image, in.a, std::uint64_t{in.a} + 1}, MemType::U8, false, in.opcode == Opcode::StoreBit);
        return effect(in);
      case Opcode::LocalGet:
      case Opcode::LocalSet: {
        const std::uint64_t at = places_.first_slot + std::uint64_t{in.a} * kSlotBytes;
        const auto type = slot_memory(view_.local_type(code_.record, in.a));
        add({Space::Slot, at, at + size_of(type)}, type, true, in.opcode == Opcode::LocalSet);
        return effect(in);
      }
      case Opcode::AddrAbs:
        stack_.push_back({Space::Image, in.a, in.a});
        return;
      case Opcode::AddrThis:
        stack_.push_back(places_.own(in.a, 0));
        return;
      case Opcode::AddrFrame:
        stack_.push_back(places_.framed(in.a));
        return;
      case Opcode::StringOp:
        string_op(static_cast<bytecode::StringOpId>(in.a));
        return effect(in);
      case Opcode::Index: {
        stack_.pop_back();
        const auto elements = static_cast<std::uint64_t>(std::int64_t{in.signed_b()} - in.signed_a());
        stack_.back() = stack_.back().moved(0, elements * in.c);
        return;
      }
      case Opcode::Offset:
        stack_.back() = stack_.back().moved(in.a, 0);
        return;
      case Opcode::MemCopy:
        add(stack_[stack_.size() - 1].moved(0, in.a), MemType::U8, false, false);
        add(stack_[stack_.size() - 2].moved(0, in.a), MemType::U8, false, true);
        return effect(in);
      default:
        return effect(in);
    }
  }

  void access(const Instruction& in) {
    const MemoryAccess access = memory_access(in.opcode);
    const std::uint32_t bytes = size_of(access.type);
    if (access.mode != AddressMode::Ind) {
      const Extent fixed = access.mode == AddressMode::Abs
                               ? Extent{Space::Image, in.a, std::uint64_t{in.a} + bytes}
                               : places_.own(in.a, bytes);
      add(fixed, access.type, true, access.store);
    } else {
      const Extent base = stack_[stack_.size() - (access.store ? 2 : 1)];
      add(base.moved(0, bytes), access.type, base.first == base.end, access.store);
    }
    effect(in);
  }

  // What gives no result writes to its deepest operand, as much as the largest string has. (Reads matter in
  // loops only, and a loop that works on strings keeps nothing in registers.)
  void string_op(bytecode::StringOpId id) {
    constexpr std::uint64_t kLongest = bytecode::kStringHeaderBytes + bytecode::kMaxStringCapacity * 2;
    const bytecode::OperationInfo& info = bytecode::kStringOps[static_cast<std::uint8_t>(id)];
    if (*info.pushes != '\0') return;
    add(stack_[stack_.size() - std::strlen(info.pops)].moved(0, kLongest), MemType::U8, false, true);
  }

  void effect(const Instruction& in) {
    const StackEffect change = stack_effect(view_, code_.record, in);
    stack_.resize(stack_.size() - change.pops);
    stack_.resize(stack_.size() + change.pushes, kUnknown);
  }

  void add(const Extent& extent, MemType type, bool scalar, bool store) {
    effects_.push_back({item_, extent, type, scalar && extent.space != Space::Unknown, store});
  }

  const bytecode::ContainerView& view_;
  const FunctionCode& code_;
  FunctionPlaces places_;
  std::vector<std::uint32_t> depth_at_;
  std::vector<Extent> stack_;
  std::vector<MemoryEffect> effects_;
  std::uint32_t item_ = 0;
  bool reachable_ = true;
};

}  // namespace

std::vector<MemoryEffect> memory_effects(const bytecode::ContainerView& view, const FunctionCode& code,
                                         const FunctionPlaces& places) {
  return EffectScan(view, code, places).run();
}

}  // namespace stepwright::native
