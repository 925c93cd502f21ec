// The parts of ExpressionWriter for addresses: of any place, of the own variables in many forms, and those
// that stay on the stack while branches are taken.

#include "tests/unit/runtime/native/random_expressions.h"

namespace stepwright::native {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;

void ExpressionWriter::push_address(std::uint32_t bytes) {
  below(4) == 0 ? push_alias() : push_place(bytes);
  switch (below(20)) {
    case 0:
      return wait_for_branch();
    case 1:
      return replace_in_branch(bytes);
    default:
      return;
  }
}

// An index that is kept within so many numbers, a power of two, from `lower` on.
void ExpressionWriter::push_index(std::int32_t lower, std::int32_t count) {
  push(StackType::I32, 1);
  if (rash(25)) return;
  b_.const_i32(count - 1);
  b_.emit(Opcode::AndI32);
  b_.const_i32(lower);
  b_.emit(Opcode::AddI32);
}

void ExpressionWriter::push_place(std::uint32_t bytes) {
  const std::uint32_t stride = below(3) == 0 ? 1 + below(12) : 1u << below(4);
  const std::int32_t lower = below(3) == 0 ? static_cast<std::int32_t>(below(5)) - 2 : 0;
  const std::uint32_t span = 20 * stride + 2 * bytes;
  const bool own = around_.instance_size > span && below(3) != 0;
  const std::uint32_t size = own ? around_.instance_size : around_.image_size;
  const std::uint32_t base = size > span ? below(size - span) : 0;
  const auto index = [&](std::int32_t count) { push_index(lower, count); };
  // One variable for several indexes: checks that repeat one before.
  const bool repeated = around_.instance_size != 0 && below(6) == 0;
  const std::uint32_t variable = repeated ? own_place(MemType::I32) : 0;
  if (repeated) {
    index(4);
    b_.store(MemType::I32, AddressMode::This, variable);
  }
  if (rash(30)) {
    load(StackType::Ref);  // nowhere, or what was stored there
  } else if (around_.frame_size != 0 && below(4) == 0) {
    b_.addr_frame(below(kFrameScalars));
  } else {
    own ? b_.addr_this(base) : b_.addr_abs(base);
  }
  if (repeated) {
    for (std::uint32_t i = 1 + below(3); i > 0; --i) {
      b_.load(MemType::I32, AddressMode::This, variable);
      if (rash(12)) {
        b_.const_i32(1);
        b_.emit(Opcode::AddI32);
        b_.store(MemType::I32, AddressMode::This, variable);
        b_.load(MemType::I32, AddressMode::This, variable);
      }
      const auto wider = static_cast<std::int32_t>(below(4));
      b_.index(lower - (wider & 1), lower + 3 + (wider >> 1), below(2) == 0 ? stride : 1);
    }
    return;
  }
  switch (below(5)) {
    case 0:
      break;
    case 4:
      index(4);
      b_.const_i32(lower);
      index_between(stride);
      break;
    case 1:
      b_.offset(rash(30) ? around_.image_size : below(stride + 1));
      break;
    case 2:
      index(4);
      b_.index(lower, lower + 3, stride);
      index(4);
      b_.index(lower, lower + 3, below(2) == 0 ? stride : 1);
      break;
    default:
      index(8);
      b_.index(lower, lower + 7, stride);
      if (below(3) == 0) b_.offset(below(bytes + 1));
  }
  if (below(16) == 0) {
    b_.emit(Opcode::Dup);
    b_.emit(Opcode::Drop);
  }
}

// Where a variable of the function lies, as another way leads there: elements of arrays with one element,
// distances, the place in the image of the first instance that there is.
void ExpressionWriter::push_alias() {
  const MemType memory = memory_type(static_cast<StackType>(below(5)));
  const bool own = around_.instance_size != 0;
  const std::uint32_t at =
      own ? place(memory, around_.instance_size) : 64 + place(memory, around_.image_size - 64);
  const auto start = [&](std::uint32_t before) {
    if (own && below(3) == 0) return b_.addr_abs(around_.first_instance + at - before);
    own ? b_.addr_this(at - before) : b_.addr_abs(at - before);
  };
  const std::uint32_t distance = below(at + 1);
  switch (below(5)) {
    case 0:
      return start(0);
    case 1:
      start(distance);
      b_.offset(distance);
      if (rash(8)) b_.offset(around_.instance_size);
      return;
    case 2:
      start(at < 4 ? at : 4);
      push_index(0, 2);
      return b_.index(0, 1, 4);
    default: {
      start(0);
      for (auto dimensions = 1 + below(2); dimensions > 0; --dimensions) {
        const std::int32_t lower = static_cast<std::int32_t>(below(7)) - 3;
        push_index(lower, 1);
        b_.index(lower, lower, size_of(memory));
      }
    }
  }
}

// The address on the stack waits while something else happens, or not.
void ExpressionWriter::wait_for_branch() {
  const auto behind = b_.new_label();
  push(StackType::Bool, 1);
  below(2) == 0 ? b_.jump_if_false(behind) : b_.jump_if_true(behind);
  store_leaf();
  b_.bind(behind);
}

// Two addresses meet.
void ExpressionWriter::replace_in_branch(std::uint32_t bytes) {
  const auto behind = b_.new_label();
  push(StackType::Bool, 1);
  b_.jump_if_false(behind);
  b_.emit(Opcode::Drop);
  push_place(bytes);
  b_.bind(behind);
}

void ExpressionWriter::store_indirect() {
  const auto type = static_cast<StackType>(below(12) == 0 ? 5 : below(5));
  const MemType memory = memory_type(type);
  push_address(size_of(memory));
  if (below(5) != 0) return store_at_address(type, memory);
  // The address is used in one branch and dropped in the other.
  const auto otherwise = b_.new_label();
  const auto end = b_.new_label();
  push(StackType::Bool, 1);
  b_.jump_if_false(otherwise);
  store_at_address(type, memory);
  b_.jump(end);
  b_.bind(otherwise);
  b_.emit(Opcode::Drop);
  b_.bind(end);
}

void ExpressionWriter::store_at_address(StackType type, MemType memory) {
  push(type, 3);
  b_.store(memory, AddressMode::Ind);
}

void ExpressionWriter::store_by_copy_of_address() {
  const auto type = static_cast<StackType>(below(5));
  b_.emit(Opcode::Dup);
  push(type, 1);
  b_.store(memory_type(type), AddressMode::Ind);
}

// A reference is kept, something happens, and it is followed.
void ExpressionWriter::store_by_reference() {
  if (around_.instance_size == 0) return store_indirect();
  const std::uint32_t at = own_place(MemType::Ref);
  const auto type = static_cast<StackType>(below(5));
  push_address(8);
  b_.store(MemType::Ref, AddressMode::This, at);
  if (below(2) == 0) store_leaf();
  b_.load(MemType::Ref, AddressMode::This, at);
  push(type, 1);
  b_.store(memory_type(type), AddressMode::Ind);
}

}  // namespace stepwright::native
