#include "runtime/native/internal/memory_effects.h"

#include <cstring>
#include <utility>

#include "runtime/native/internal/context.h"

namespace stepwright::native {

namespace {

using bytecode::AddressMode;
using bytecode::Instruction;
using bytecode::MemType;
using bytecode::Opcode;

// What is known of an operand: where it leads, if it is an address, or its value.
struct Operand {
  Extent place;  // no bytes of its own: first to end are the addresses that it can be
  bool constant = false;
  std::int32_t value = 0;
};

// Follows addresses through the operand stack, from one instruction to the next. Where ways meet nothing is
// known.
class EffectScan {
 public:
  EffectScan(const bytecode::Program& program, const FunctionCode& code, const FunctionPlaces& places)
      : view_(program.container()),
        memory_size_(program.memory_size()),
        code_(code),
        places_(places),
        depth_at_(code.items.size(), 0) {}

  std::vector<MemoryEffect> run() {
    for (item_ = 0; item_ < code_.items.size(); ++item_) {
      const FunctionCode::Item& item = code_.items[item_];
      if (item.is_target || !reachable_) {
        const std::size_t depth = reachable_ ? stack_.size() : depth_at_[item_];
        stack_.assign(depth, {});
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
      add_value(bytecode::is_this_boolean(in.opcode) ? places_.own(in.a, 1) : absolute(in.a, 1),
                MemType::Bool, false);
      return effect(in);
    }
    switch (in.opcode) {
      case Opcode::LoadBit:
      case Opcode::StoreBit:
        add_bytes(absolute(in.a, 1), 1, in.opcode == Opcode::StoreBit);
        return effect(in);
      case Opcode::LocalGet:
      case Opcode::LocalSet:
        local(in);
        return effect(in);
      case Opcode::MemCopy:
        add_bytes(top(0).place.moved(0, in.a), in.a, false);
        add_bytes(top(1).place.moved(0, in.a), in.a, true);
        return effect(in);
      case Opcode::StringOp:
        string_op(static_cast<bytecode::StringOpId>(in.a));
        return effect(in);
      default:
        return operand(in);
    }
  }

  // Instructions that touch nothing, but make an operand of which something is known.
  void operand(const Instruction& in) {
    switch (in.opcode) {
      case Opcode::ConstI32:
        stack_.push_back({{}, true, static_cast<std::int32_t>(in.a)});
        return;
      case Opcode::AddrAbs:
        stack_.push_back({absolute(in.a, 0)});
        return;
      case Opcode::AddrThis:
        stack_.push_back({places_.own(in.a, 0)});
        return;
      case Opcode::AddrFrame:
        stack_.push_back({places_.framed(in.a)});
        return;
      case Opcode::Dup:
        stack_.push_back(Operand(top(0)));
        return;
      case Opcode::Index:
        return index(in);
      case Opcode::Offset:
        top(0) = {top(0).place.moved(in.a, 0)};
        return;
      default:
        return effect(in);
    }
  }

  // An index that is known and wrong traps: no element is touched.
  void index(const Instruction& in) {
    const Operand number = top(0);
    stack_.pop_back();
    const std::int64_t lower = in.signed_a();
    const std::int64_t upper = in.signed_b();
    const Extent base = top(0).place;
    if (number.constant && number.value >= lower && number.value <= upper) {
      top(0) = {base.moved(static_cast<std::uint64_t>(number.value - lower) * in.c, 0)};
    } else {
      top(0) = {base.moved(0, static_cast<std::uint64_t>(upper - lower) * in.c)};
    }
  }

  void access(const Instruction& in) {
    const MemoryAccess access = memory_access(in.opcode);
    const std::uint32_t bytes = size_of(access.type);
    Extent extent;
    if (access.mode == AddressMode::Abs) {
      extent = absolute(in.a, bytes);
    } else if (access.mode == AddressMode::This) {
      extent = places_.own(in.a, bytes);
    } else {
      extent = top(access.store ? 1 : 0).place.moved(0, bytes);
    }
    add_value(extent, access.type, access.store);
    if (access.store && access.type == MemType::Ref) effects_.back().ref_inside = inside(top(0).place);
    effect(in);
  }

  void local(const Instruction& in) {
    const std::uint64_t at = places_.first_slot + std::uint64_t{in.a} * kSlotBytes;
    const auto type = slot_memory(view_.local_type(code_.record, in.a));
    add_value({Space::Slot, at, at + size_of(type)}, type, in.opcode == Opcode::LocalSet);
  }

  // What gives no result writes to its deepest operand, as much as the largest string has. (Reads matter in
  // loops only, and a loop that works on strings keeps nothing in registers.)
  void string_op(bytecode::StringOpId id) {
    constexpr std::uint64_t kLongest = bytecode::kStringHeaderBytes + bytecode::kMaxStringCapacity * 2;
    const bytecode::OperationInfo& info = bytecode::kStringOps[static_cast<std::uint8_t>(id)];
    if (*info.pushes != '\0') return;
    add_bytes(top(std::strlen(info.pops) - 1).place.moved(0, kLongest), kLongest, true);
  }

  void effect(const Instruction& in) {
    const StackEffect change = stack_effect(view_, code_.record, in);
    stack_.resize(stack_.size() - change.pops);
    stack_.resize(stack_.size() + change.pushes);
  }

  Operand& top(std::size_t below) { return stack_[stack_.size() - 1 - below]; }

  static Extent absolute(std::uint32_t offset, std::uint32_t bytes) {
    return {Space::Image, offset, std::uint64_t{offset} + bytes};
  }

  // Slots are the function's own; instances lie in the memory as a whole.
  bool inside(const Extent& extent) const {
    switch (extent.space) {
      case Space::Slot:
        return true;
      case Space::Image:
        return extent.end <= memory_size_;
      case Space::Instance:
        return extent.end <= code_.record.instance_size;
      case Space::Unknown:
        return false;
    }
    return false;
  }

  void add_value(const Extent& extent, MemType type, bool store) {
    add_bytes(extent, size_of(type), store);
    effects_.back().type = type;
    effects_.back().is_value = true;
  }

  void add_bytes(const Extent& extent, std::uint64_t bytes, bool store) {
    MemoryEffect effect;
    effect.item = item_;
    effect.extent = extent;
    effect.store = store;
    effect.inside = inside(extent);
    effect.fixed = effect.inside && extent.is_place_of(bytes);
    effects_.push_back(effect);
  }

  const bytecode::ContainerView& view_;
  std::uint64_t memory_size_;
  const FunctionCode& code_;
  FunctionPlaces places_;
  std::vector<std::uint32_t> depth_at_;
  std::vector<Operand> stack_;
  std::vector<MemoryEffect> effects_;
  std::uint32_t item_ = 0;
  bool reachable_ = true;
};

}  // namespace

std::vector<MemoryEffect> memory_effects(const bytecode::Program& program, const FunctionCode& code,
                                         const FunctionPlaces& places) {
  return EffectScan(program, code, places).run();
}

}  // namespace stepwright::native
