#pragma once

// Random typed expressions, and the places that they read.

#include <cstdint>
#include <random>
#include <vector>

#include "runtime/bytecode/writer/function_builder.h"

namespace stepwright::native {

// A function that random code may call.
struct Callee {
  std::uint32_t index = 0;
  bytecode::FunctionKind kind = bytecode::FunctionKind::Function;
  std::vector<bytecode::StackType> parameters;
  bytecode::StackType result = bytecode::StackType::I32;
  std::uint32_t size = 0;                // of an instance
  std::vector<std::uint32_t> instances;  // absolute addresses
};

// Where code stands and what is there.
struct Surroundings {
  std::uint32_t image_size = 0;
  std::uint32_t instance_size = 0;   // 0: no instance
  std::uint32_t bit_bytes = 0;       // bits lie in the first so many bytes of the image
  std::uint32_t frame_size = 0;      // of the function; strings are kept behind its first kFrameScalars bytes
  std::uint32_t first_instance = 0;  // absolute address of the first instance that it runs on
  std::uint32_t nested_instance = 0;    // offset of an instance within the own one; 0: none
  std::vector<std::uint32_t> counters;  // offsets in the instance that loops count in
  std::vector<bytecode::StackType> locals;
  std::size_t parameters = 0;  // of the locals
  bool has_result = false;
  bytecode::StackType result = bytecode::StackType::I32;
  std::vector<Callee> callees;
  bool careful = false;  // does what traps only behind a guard
};

inline constexpr std::uint32_t kFrameScalars = 32;
inline constexpr std::uint32_t kStringBytes = 32;  // room for one string
inline constexpr std::uint32_t kStrings = 3;       // of each function's frame
inline constexpr std::uint32_t kFrameBytes = kFrameScalars + kStrings * kStringBytes;

class ExpressionWriter {
 public:
  ExpressionWriter(writer::FunctionBuilder& builder, const Surroundings& around, std::mt19937& random)
      : b_(builder), around_(around), random_(random) {}

  // Code that leaves one operand of this type.
  void push(bytecode::StackType type, int depth);
  // A Ref behind which about `bytes` bytes are meant to lie in the image, mostly.
  void push_address(std::uint32_t bytes);
  void store_variable();
  void store_leaf();
  void store_indirect();
  // By an address that stays on the stack.
  void store_by_copy_of_address();
  void store_by_reference();
  void call(const Callee& callee);
  // An operation on strings that leaves nothing.
  void change_string();
  // Gives every string of the frame a capacity.
  void init_strings();

 private:
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_() % limit); }
  bool rash(std::uint32_t one_in) { return below(one_in) == 0 && !around_.careful; }
  bytecode::MemType memory_type(bytecode::StackType type);
  std::uint32_t place(bytecode::MemType type, std::uint32_t size);
  std::uint32_t own_place(bytecode::MemType type);
  void push_place(std::uint32_t bytes);
  void push_alias();
  void push_index(std::int32_t lower, std::int32_t count);
  void wait_for_branch();
  void replace_in_branch(std::uint32_t bytes);
  void store_at_address(bytecode::StackType type, bytecode::MemType memory);
  void leaf(bytecode::StackType type);
  void load(bytecode::StackType type);
  void constant(bytecode::StackType type);
  void binary(bytecode::StackType type, int depth);
  void divide(bytecode::StackType type, int depth);
  void comparison(int depth);
  void conversion(bytecode::StackType type, int depth);
  void choice(bytecode::StackType type, int depth);
  void shift(bytecode::StackType type, int depth);
  void intrinsic(bytecode::StackType type, int depth);
  void push_string();
  void string_operands(const bytecode::OperationInfo& info);
  bool read_string(bytecode::StackType type);
  void check(bytecode::StackType type, int depth);
  void elementary(bytecode::StackType type, int depth);
  void compare_references();
  void index_between(std::uint32_t stride);
  bytecode::Opcode typed(bytecode::Opcode first, bytecode::StackType type) const;

  writer::FunctionBuilder& b_;
  const Surroundings& around_;
  std::mt19937& random_;
};

}  // namespace stepwright::native
