#pragma once

// Facts about a whole program that make its code shorter: where instances lie, where slots lie, which bytes
// can only be 0 or 1.
//
// Threads: immutable; any. The program's container outlives it.

#include <cstdint>
#include <vector>

#include "runtime/bytecode/program.h"
#include "runtime/native/internal/extent.h"
#include "runtime/native/internal/function_code.h"
#include "runtime/native/internal/memory_effects.h"

namespace stepwright::native {

struct FunctionFacts {
  FunctionPlaces places;
  std::vector<std::uint32_t> bases;  // every instance, if `listed`
  bool listed = true;
  bool uses_self = false;    // runs on more than one instance: its code needs the register
  bool spoils_self = false;  // leaves another instance in the register
};

class ProgramFacts {
 public:
  explicit ProgramFacts(const bytecode::Program& program);

  const bytecode::ContainerView& view() const { return program_.container(); }
  const bytecode::Program& program() const { return program_; }
  std::uint32_t function_count() const { return static_cast<std::uint32_t>(functions_.size()); }
  const FunctionFacts& facts(std::uint32_t function) const { return functions_[function]; }
  const FunctionCode& code(std::uint32_t function) const { return codes_[function]; }
  const std::vector<MemoryEffect>& effects(std::uint32_t function) const { return effects_[function]; }

  // The instruction's access to memory; requires that it has one.
  const MemoryEffect& effect(std::uint32_t function, std::uint32_t item, bool store) const;

  // Bytes of the block that holds the context and all slots.
  std::uint32_t context_bytes() const { return context_bytes_; }

  // True if every byte of the extent can only hold 0 or 1, as long as whoever writes the image from outside
  // writes Bools as 0 or 1: the program itself stores nothing but Bools there.
  bool plain_bool(std::uint32_t function, const Extent& extent) const;

 private:
  std::vector<std::uint32_t> callers_first() const;
  void find_instances(std::uint32_t function);
  void add_instance(std::uint32_t function, std::uint64_t base);
  template <typename Visit>
  void each_place(std::uint32_t function, const Extent& extent, Visit visit) const;
  void place_slots(std::uint32_t function);
  void find_spoilers(const std::vector<std::uint32_t>& order);
  void mark_bytes();

  bytecode::Program program_;
  std::vector<FunctionCode> codes_;
  std::vector<FunctionFacts> functions_;
  std::vector<std::vector<MemoryEffect>> effects_;
  std::vector<std::uint32_t>
      others_before_;  // how many bytes before this may hold something else than 0 or 1
  std::uint32_t context_bytes_ = 0;
};

}  // namespace stepwright::native
