#include "runtime/bytecode/writer/function_builder.h"

#include "runtime/bytecode/writer/boolean_fusion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

namespace stepwright::writer {

using bytecode::AddressMode;
using bytecode::Opcode;

FunctionBuilder::FunctionBuilder(std::string name, bytecode::FunctionKind kind, std::uint32_t instance_size) {
  function_.name = std::move(name);
  function_.kind = kind;
  function_.instance_size = instance_size;
}

LocalId FunctionBuilder::add_param(bytecode::StackType type) {
  assert(function_.param_count == function_.locals.size() && "parameters come before other locals");
  ++function_.param_count;
  return add_local(type);
}

LocalId FunctionBuilder::add_local(bytecode::StackType type) {
  function_.locals.push_back(type);
  return LocalId(static_cast<std::uint32_t>(function_.locals.size() - 1));
}

void FunctionBuilder::set_result(bytecode::StackType type) {
  function_.result = static_cast<std::uint8_t>(type);
}

template <typename T>
void FunctionBuilder::append(T value) {
  const auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  function_.code.insert(function_.code.end(), bytes.begin(), bytes.end());
}

// Starts an instruction; false if nothing reaches it, so that it is dropped.
bool FunctionBuilder::begin(Opcode opcode) {
  if (!reachable_) return false;
  before_ = last_;
  last_ = position();
  append(static_cast<std::uint8_t>(opcode));
  if (opcode == Opcode::Jump || opcode == Opcode::Return || opcode == Opcode::Trap) reachable_ = false;
  return true;
}

// A load of a BOOL and the boolean operation behind it become one instruction: the load's opcode is replaced.
bool FunctionBuilder::fuse(Opcode operation) {
  if (!reachable_ || !last_) return false;
  const auto fused = fused_operation(opcode_at(*last_), operation);
  if (!fused) return false;
  function_.code[*last_] = static_cast<std::byte>(*fused);
  if (operation != Opcode::NotBool) pair_up();
  return true;
}

// The last two instructions become one if there is one that does both, and no line starts at the second.
void FunctionBuilder::pair_up() {
  if (!reachable_ || !before_) return;
  if (!function_.lines.empty() && function_.lines.back().pc > *before_) return;
  const auto pair = fused_pair(opcode_at(*before_), opcode_at(*last_));
  if (!pair) return;
  auto& code = function_.code;
  code[*before_] = static_cast<std::byte>(pair->opcode);
  code.erase(code.begin() + *last_);
  if (pair->swapped) std::rotate(code.end() - 8, code.end() - 4, code.end());
  last_ = before_;
  before_.reset();
}

void FunctionBuilder::emit(Opcode opcode) {
  assert(bytecode::info(opcode).operands == bytecode::Operands::None);
  if (!fuse(opcode)) begin(opcode);
}

void FunctionBuilder::emit_u32(Opcode opcode, std::uint32_t operand) {
  assert(bytecode::info(opcode).operands == bytecode::Operands::U32);
  if (begin(opcode)) append(operand);
}

void FunctionBuilder::emit_u8(Opcode opcode, std::uint8_t operand) {
  assert(bytecode::info(opcode).operands == bytecode::Operands::U8);
  if (begin(opcode)) append(operand);
}

void FunctionBuilder::append_constant(std::uint64_t bits) {
  auto& pool = function_.constants;
  const auto [known, is_new] = constant_index_.try_emplace(bits, static_cast<std::uint32_t>(pool.size()));
  append(known->second);
  if (is_new) pool.push_back(bits);
}

void FunctionBuilder::emit_constants(Opcode opcode, std::uint64_t lower, std::uint64_t upper) {
  if (!begin(opcode)) return;
  append_constant(lower);
  append_constant(upper);
}

void FunctionBuilder::const_bool(bool value) {
  emit_u8(Opcode::ConstBool, value ? 1 : 0);
}
void FunctionBuilder::const_i32(std::int32_t value) {
  emit_u32(Opcode::ConstI32, static_cast<std::uint32_t>(value));
}
void FunctionBuilder::const_i64(std::int64_t value) {
  if (begin(Opcode::ConstI64)) append_constant(static_cast<std::uint64_t>(value));
}
void FunctionBuilder::const_f32(float value) {
  emit_u32(Opcode::ConstF32, std::bit_cast<std::uint32_t>(value));
}
void FunctionBuilder::const_f64(double value) {
  if (begin(Opcode::ConstF64)) append_constant(std::bit_cast<std::uint64_t>(value));
}

void FunctionBuilder::load(bytecode::MemType type, AddressMode mode, std::uint32_t offset) {
  const Opcode opcode = bytecode::load_opcode(type, mode);
  mode == AddressMode::Ind ? emit(opcode) : emit_u32(opcode, offset);
}
void FunctionBuilder::store(bytecode::MemType type, AddressMode mode, std::uint32_t offset) {
  const Opcode opcode = bytecode::store_opcode(type, mode);
  mode == AddressMode::Ind ? emit(opcode) : emit_u32(opcode, offset);
  if (type == bytecode::MemType::Bool) pair_up();
}

void FunctionBuilder::load_bit(std::uint32_t byte, std::uint8_t bit) {
  if (!begin(Opcode::LoadBit)) return;
  append(byte);
  append(bit);
}
void FunctionBuilder::store_bit(std::uint32_t byte, std::uint8_t bit) {
  if (!begin(Opcode::StoreBit)) return;
  append(byte);
  append(bit);
}

void FunctionBuilder::local_get(LocalId local) {
  emit_u32(Opcode::LocalGet, local.value);
}
void FunctionBuilder::local_set(LocalId local) {
  emit_u32(Opcode::LocalSet, local.value);
}
void FunctionBuilder::addr_abs(std::uint32_t offset) {
  emit_u32(Opcode::AddrAbs, offset);
}
void FunctionBuilder::addr_this(std::uint32_t offset) {
  emit_u32(Opcode::AddrThis, offset);
}
void FunctionBuilder::addr_frame(std::uint32_t offset) {
  emit_u32(Opcode::AddrFrame, offset);
}

std::uint32_t FunctionBuilder::allocate_frame(std::uint32_t bytes, std::uint32_t align) {
  assert(std::has_single_bit(align) && align <= 8);
  const std::uint32_t at = (function_.frame_size + align - 1) / align * align;
  function_.frame_size = at + bytes;
  return at;
}

void FunctionBuilder::index(std::int32_t lower, std::int32_t upper, std::uint32_t stride) {
  if (!begin(Opcode::Index)) return;
  append(lower);
  append(upper);
  append(stride);
}

void FunctionBuilder::index_dyn(std::uint32_t stride) {
  emit_u32(Opcode::IndexDyn, stride);
}

void FunctionBuilder::check_i32(std::int32_t lower, std::int32_t upper) {
  if (!begin(Opcode::CheckI32)) return;
  append(lower);
  append(upper);
}
void FunctionBuilder::check_i64(std::int64_t lower, std::int64_t upper) {
  emit_constants(Opcode::CheckI64, static_cast<std::uint64_t>(lower), static_cast<std::uint64_t>(upper));
}
void FunctionBuilder::check_u64(std::uint64_t lower, std::uint64_t upper) {
  emit_constants(Opcode::CheckU64, lower, upper);
}

void FunctionBuilder::offset(std::uint32_t bytes) {
  emit_u32(Opcode::Offset, bytes);
}
void FunctionBuilder::mem_copy(std::uint32_t bytes) {
  emit_u32(Opcode::MemCopy, bytes);
}
void FunctionBuilder::rotate_i32(Opcode rol_or_ror, std::uint8_t bits) {
  emit_u8(rol_or_ror, bits);
}
void FunctionBuilder::to_int(Opcode conversion, bytecode::IntType target) {
  emit_u8(conversion, static_cast<std::uint8_t>(target));
}
void FunctionBuilder::intrinsic(bytecode::IntrinsicId id) {
  emit_u8(Opcode::Intrinsic, static_cast<std::uint8_t>(id));
}
void FunctionBuilder::string_op(bytecode::StringOpId id) {
  emit_u8(Opcode::StringOp, static_cast<std::uint8_t>(id));
}
void FunctionBuilder::trap(std::uint8_t code) {
  emit_u8(Opcode::Trap, code);
}
void FunctionBuilder::call(std::uint32_t function) {
  emit_u32(Opcode::Call, function);
}

void FunctionBuilder::call_instance(AddressMode mode, std::uint32_t function, std::uint32_t offset) {
  if (mode == AddressMode::Ind) return emit_u32(Opcode::CallInstanceInd, function);
  if (!begin(mode == AddressMode::Abs ? Opcode::CallInstanceAbs : Opcode::CallInstanceThis)) return;
  append(function);
  append(offset);
}

Label FunctionBuilder::new_label() {
  labels_.emplace_back();
  return Label(static_cast<std::uint32_t>(labels_.size() - 1));
}

void FunctionBuilder::bind(Label label) {
  LabelState& state = labels_[label.value];
  assert(state.pc == LabelState::kUnbound && "a label is bound once");
  state.pc = position();
  last_.reset();
  before_.reset();
  reachable_ = true;
}

void FunctionBuilder::emit_jump(Opcode opcode, Label label) {
  if (!begin(opcode)) return;
  fixups_.push_back({position(), label});
  append(std::int32_t{0});
}
void FunctionBuilder::jump(Label label) {
  emit_jump(Opcode::Jump, label);
}
void FunctionBuilder::jump_if_false(Label label) {
  emit_jump(Opcode::JumpIfFalse, label);
}
void FunctionBuilder::jump_if_true(Label label) {
  emit_jump(Opcode::JumpIfTrue, label);
}

void FunctionBuilder::line(std::uint32_t file, std::uint32_t line, std::uint32_t column) {
  auto& lines = function_.lines;
  if (!lines.empty() && lines.back().pc == position()) lines.pop_back();
  const Function::Line place{position(), file, line, column};
  if (!lines.empty() && lines.back().file == file && lines.back().line == line &&
      lines.back().column == column)
    return;
  lines.push_back(place);
}

Function FunctionBuilder::take() && {
  for (const Fixup& fixup : fixups_) {
    const LabelState& target = labels_[fixup.label.value];
    assert(target.pc != LabelState::kUnbound && "a label that is jumped to must be bound");
    const auto distance =
        static_cast<std::int32_t>(static_cast<std::int64_t>(target.pc) - (fixup.operand + std::int64_t{4}));
    std::memcpy(function_.code.data() + fixup.operand, &distance, sizeof(distance));
  }
  // A line noted behind the last instruction belongs to no code.
  while (!function_.lines.empty() && function_.lines.back().pc >= function_.code.size())
    function_.lines.pop_back();
  return std::move(function_);
}

}  // namespace stepwright::writer
