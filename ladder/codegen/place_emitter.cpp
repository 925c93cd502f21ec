// Places as instructions: addresses, loads, parts of bit strings.

#include "ladder/codegen/expression_emitter.h"

namespace stepwright::codegen {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using semantics::Base;
using semantics::Place;
using semantics::PlaceStep;
using writer::LocalId;

void ExpressionEmitter::load(const Place& place) {
  if (place.bit != bytecode::kNoBit) return load_bit(place);
  if (place.whole != nullptr) return load_part(place);
  if (place.character) return load_character(place);
  if (is_slot(place)) return b_.local_get(LocalId(place.slot));
  const MemType type = semantics::mem_type(*place.type);
  if (!place.is_direct() || place.base == Base::Frame) {
    reference(place);
    return b_.load(type, AddressMode::Ind);
  }
  if (in_area(place)) return b_.load(type, AddressMode::Abs, address(place));
  b_.load(type, AddressMode::This, place.offset);
}

void ExpressionEmitter::reference(const Place& place) {
  std::size_t step = 0;
  base_reference(place, step);
  for (; step < place.steps.size(); ++step) walk(place.steps[step]);
}

// Where the way begins; a reference that is followed at once is loaded directly.
void ExpressionEmitter::base_reference(const Place& place, std::size_t& step) {
  const bool follows = !place.steps.empty() && place.steps.front().follow;
  switch (place.base) {
    case Base::This:
      if (follows) {
        ++step;
        return b_.load(MemType::Ref, AddressMode::This, place.offset);
      }
      return b_.addr_this(place.offset);
    case Base::ThisRef:
      return b_.load(MemType::Ref, AddressMode::This, place.offset);
    case Base::Frame:
      return b_.addr_frame(place.offset);
    case Base::Slot:
      // The slot holds a reference that is followed.
      ++step;
      return b_.local_get(LocalId(place.slot));
    case Base::SlotRef:
      return b_.local_get(LocalId(place.slot));
    default:
      if (follows) {
        ++step;
        return b_.load(MemType::Ref, AddressMode::Abs, address(place));
      }
      b_.addr_abs(address(place));
  }
}

void ExpressionEmitter::walk(const PlaceStep& step) {
  if (step.follow) b_.load(MemType::Ref, AddressMode::Ind);
  if (step.index) {
    value(*step.index);
    b_.index(step.lower, step.upper, step.stride);
  }
  if (!step.open.empty()) open_index(step);
  if (step.offset != 0) b_.offset(step.offset);
}

// The last index counts elements, each one before it rows of what follows. Every index is checked against
// bounds of its own: a step of no bytes changes nothing but traps.
void ExpressionEmitter::open_index(const PlaceStep& step) {
  const bool several = step.open.size() > 1;
  if (!several) {
    value(*step.open[0].index);
    value(*step.open[0].lower);
    value(*step.open[0].upper);
    return b_.index_dyn(step.stride);
  }
  const LocalId at = local(bytecode::StackType::Ref);
  const LocalId flat = local(bytecode::StackType::I32);
  const LocalId count = local(bytecode::StackType::I32);
  const LocalId index = local(bytecode::StackType::I32);
  b_.local_set(at);
  b_.const_i32(0);
  b_.local_set(flat);
  b_.const_i32(1);
  b_.local_set(count);
  for (const semantics::OpenIndex& each : step.open) {
    value(*each.index);
    b_.local_set(index);
    b_.local_get(at);
    b_.local_get(index);
    value(*each.lower);
    value(*each.upper);
    b_.index_dyn(0);
    b_.local_set(at);
    // flat := flat * extent + (index - lower); count := count * extent
    const auto push_extent = [&] {
      value(*each.upper);
      value(*each.lower);
      b_.emit(Opcode::SubI32);
      b_.const_i32(1);
      b_.emit(Opcode::AddI32);
    };
    b_.local_get(flat);
    push_extent();
    b_.emit(Opcode::MulI32);
    b_.local_get(index);
    b_.emit(Opcode::AddI32);
    value(*each.lower);
    b_.emit(Opcode::SubI32);
    b_.local_set(flat);
    b_.local_get(count);
    push_extent();
    b_.emit(Opcode::MulI32);
    b_.local_set(count);
  }
  b_.local_get(at);
  b_.local_get(flat);
  b_.const_i32(0);
  b_.local_get(count);
  b_.const_i32(1);
  b_.emit(Opcode::SubI32);
  b_.index_dyn(step.stride);
}

void ExpressionEmitter::load_bit(const Place& place) {
  if (place.is_direct() && in_area(place)) return b_.load_bit(address(place), place.bit);
  reference(place);
  b_.load(MemType::U8, AddressMode::Ind);
  b_.const_i32(1 << place.bit);
  b_.emit(Opcode::AndI32);
  b_.emit(Opcode::I32ToBool);
}

// A byte and a BOOL on the stack become the byte with the bit set to the BOOL.
void ExpressionEmitter::merge_bit(std::uint8_t bit) {
  const LocalId set = local(bytecode::StackType::I32);
  b_.emit(Opcode::BoolToI32);
  b_.const_i32(bit);
  b_.emit(Opcode::ShlI32);
  b_.local_set(set);
  b_.const_i32(0xFF & ~(1 << bit));
  b_.emit(Opcode::AndI32);
  b_.local_get(set);
  b_.emit(Opcode::OrI32);
}

// Bits of a slot: shifted down, cut to the size of the part.
void ExpressionEmitter::load_part(const Place& place) {
  const bool wide = place.whole->size == 8;
  b_.local_get(LocalId(place.slot));
  b_.const_i32(place.shift);
  b_.emit(wide ? Opcode::ShrI64 : Opcode::ShrI32);
  if (place.type->is_bool()) {
    if (wide) b_.emit(Opcode::I64ToI32);
    b_.const_i32(1);
    b_.emit(Opcode::AndI32);
    return b_.emit(Opcode::I32ToBool);
  }
  if (wide && place.type->size < 8) b_.emit(Opcode::I64ToI32);
  wrap(*place.type);
}

// The part on the stack becomes the slot's value with it.
void ExpressionEmitter::merge_part(const Place& place) {
  const bool wide = place.whole->size == 8;
  const unsigned bits = place.type->bit_count();
  const std::uint64_t ones = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const std::uint64_t mask = ~(ones << place.shift);
  if (place.type->is_bool()) b_.emit(Opcode::BoolToI32);
  if (wide && place.type->size < 8) b_.emit(Opcode::U32ToI64);
  b_.const_i32(place.shift);
  b_.emit(wide ? Opcode::ShlI64 : Opcode::ShlI32);
  b_.local_get(LocalId(place.slot));
  if (wide) {
    b_.const_i64(static_cast<std::int64_t>(mask));
    b_.emit(Opcode::AndI64);
    return b_.emit(Opcode::OrI64);
  }
  b_.const_i32(static_cast<std::int32_t>(mask & ((std::uint64_t{1} << place.whole->bit_count()) - 1)));
  b_.emit(Opcode::AndI32);
  b_.emit(Opcode::OrI32);
  // The upper bits of a slot are those of the sign.
  if (place.whole->is_integer()) wrap(*place.whole);
}

}  // namespace stepwright::codegen
