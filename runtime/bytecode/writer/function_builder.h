#pragma once

// An assembler for one function: emits instructions, resolves labels, collects constants and source lines.
// Code after an unconditional Jump, Return or Trap up to the next bound label is dropped, as nothing reaches
// it; the operand stack must be empty where a label is bound behind such an instruction and nothing jumped
// forward to it. Labels may be bound before or after the jumps to them.
//
//   FunctionBuilder f("MAIN", bytecode::FunctionKind::Program, 8);
//   Label done = f.new_label();
//   f.line(0, 12);
//   f.load(MemType::Bool, AddressMode::This, 0);
//   f.jump_if_false(done);
//   f.const_i32(1); f.store(MemType::I16, AddressMode::This, 2);
//   f.bind(done);
//   f.emit(Opcode::Return);

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "runtime/base/strong_id.h"
#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/opcode.h"

namespace stepwright::writer {

struct LabelTag;
using Label = base::StrongId<LabelTag>;

struct LocalTag;
using LocalId = base::StrongId<LocalTag>;

// A finished function. `constants` are the 64-bit values behind ConstI64/ConstF64, whose operands in `code`
// index this list until the writer merges all lists into the container's pool.
struct Function {
  struct Line {
    std::uint32_t pc = 0;
    std::uint32_t file = 0;
    std::uint32_t line = 0;
    std::uint32_t column = 0;  // 0: not known
  };
  std::string name;
  bytecode::FunctionKind kind = bytecode::FunctionKind::Function;
  bool of_library = false;                    // see bytecode::kFunctionOfLibrary
  std::uint8_t result = bytecode::kNoResult;  // StackType or kNoResult
  std::uint16_t param_count = 0;
  std::vector<bytecode::StackType> locals;  // parameters first
  std::uint32_t instance_size = 0;
  std::uint32_t frame_size = 0;  // where it lies in the task's frames the writer decides
  std::vector<std::byte> code;
  std::vector<std::uint64_t> constants;
  std::vector<Line> lines;
};

class FunctionBuilder {
 public:
  // `instance_size` in bytes; 0 for FunctionKind::Function.
  FunctionBuilder(std::string name, bytecode::FunctionKind kind, std::uint32_t instance_size = 0);

  // Parameters first (in the order in which callers push them), then other locals; all locals start as zero.
  LocalId add_param(bytecode::StackType type);
  LocalId add_local(bytecode::StackType type);
  void set_result(bytecode::StackType type);
  // Parameters included.
  std::size_t local_count() const { return function_.locals.size(); }

  // Room for a local that needs an address: its offset in the function's frame, for addr_frame. `align` is a
  // power of two, 8 at most. Not initialised when the function starts.
  std::uint32_t allocate_frame(std::uint32_t bytes, std::uint32_t align);

  // An instruction without operands. Boolean instructions that follow each other become one where there is
  // one that does both (boolean_fusion.h).
  void emit(bytecode::Opcode opcode);

  void const_bool(bool value);
  void const_i32(std::int32_t value);
  void const_i64(std::int64_t value);
  void const_f32(float value);
  void const_f64(double value);

  // `offset` counts from the image (Abs) or the instance (This); leave it 0 for Ind.
  void load(bytecode::MemType type, bytecode::AddressMode mode, std::uint32_t offset = 0);
  void store(bytecode::MemType type, bytecode::AddressMode mode, std::uint32_t offset = 0);
  void load_bit(std::uint32_t byte, std::uint8_t bit);
  void store_bit(std::uint32_t byte, std::uint8_t bit);
  void local_get(LocalId local);
  void local_set(LocalId local);
  void addr_abs(std::uint32_t offset);
  void addr_this(std::uint32_t offset);
  void addr_frame(std::uint32_t offset);
  // Ref of an array, I32 index -> Ref of the element.
  void index(std::int32_t lower, std::int32_t upper, std::uint32_t stride);
  // Ref of an array, I32 index, lower, upper -> Ref of the element.
  void index_dyn(std::uint32_t stride);
  void offset(std::uint32_t bytes);
  // Target Ref, source Ref ->
  void mem_copy(std::uint32_t bytes);

  // The value on the stack must lie in lower..upper, else the program traps (SubrangeRange).
  void check_i32(std::int32_t lower, std::int32_t upper);
  void check_i64(std::int64_t lower, std::int64_t upper);
  void check_u64(std::uint64_t lower, std::uint64_t upper);

  // `bits`: 8, 16 or 32: the width of the rotated value.
  void rotate_i32(bytecode::Opcode rol_or_ror, std::uint8_t bits);
  // RoundF32, RoundF64, TruncF32 or TruncF64 to an integer type.
  void to_int(bytecode::Opcode conversion, bytecode::IntType target);
  void intrinsic(bytecode::IntrinsicId id);
  void string_op(bytecode::StringOpId id);
  void trap(std::uint8_t code);

  void call(std::uint32_t function);
  void call_instance(bytecode::AddressMode mode, std::uint32_t function, std::uint32_t offset = 0);

  Label new_label();
  void bind(Label label);
  void jump(Label label);
  void jump_if_false(Label label);
  void jump_if_true(Label label);

  // The instructions that follow come from this place (1-based; column 0: not known) of
  // ContainerModel::source_files[file].
  void line(std::uint32_t file, std::uint32_t line, std::uint32_t column = 0);

  // True while the next instruction could be reached.
  bool reachable() const { return reachable_; }

  // The function, labels resolved. Requires every label that is jumped to to be bound.
  Function take() &&;

 private:
  struct LabelState {
    static constexpr std::uint32_t kUnbound = 0xFFFFFFFF;
    std::uint32_t pc = kUnbound;
  };
  struct Fixup {
    std::uint32_t operand = 0;  // position of the distance in the code
    Label label;
  };

  bool begin(bytecode::Opcode opcode);
  bool fuse(bytecode::Opcode operation);
  void pair_up();
  bytecode::Opcode opcode_at(std::uint32_t pc) const {
    return static_cast<bytecode::Opcode>(function_.code[pc]);
  }
  template <typename T>
  void append(T value);
  void emit_u32(bytecode::Opcode opcode, std::uint32_t operand);
  void emit_u8(bytecode::Opcode opcode, std::uint8_t operand);
  void append_constant(std::uint64_t bits);
  void emit_constants(bytecode::Opcode opcode, std::uint64_t lower, std::uint64_t upper);
  void emit_jump(bytecode::Opcode opcode, Label label);
  std::uint32_t position() const { return static_cast<std::uint32_t>(function_.code.size()); }

  Function function_;
  std::unordered_map<std::uint64_t, std::uint32_t> constant_index_;  // value -> index into the constants
  std::vector<LabelState> labels_;
  std::vector<Fixup> fixups_;
  std::optional<std::uint32_t> last_;    // the instruction before, if nothing jumps behind it
  std::optional<std::uint32_t> before_;  // the instruction before that one, if nothing comes between
  bool reachable_ = true;
};

}  // namespace stepwright::writer
