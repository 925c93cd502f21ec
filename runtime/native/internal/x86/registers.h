#pragma once

// Registers of the x86-64 translator and what they hold. A register is used by values (counted), pinned to a
// variable for a whole loop, or free. A free register may still hold a variable's value, until the register
// is taken or the variable changes.

#include <array>
#include <cstdint>
#include <limits>

#include "runtime/bytecode/value_type.h"
#include "runtime/native/internal/extent.h"
#include "runtime/native/internal/x86/machine.h"

namespace stepwright::native {

// Known range of an I32 as a signed number; at first any.
struct Bounds {
  std::int32_t lower = std::numeric_limits<std::int32_t>::min();
  std::int32_t upper = std::numeric_limits<std::int32_t>::max();
};

class Registers {
 public:
  Registers();

  // A register of the class that nothing uses, the one whose remembered variable is the oldest, with one use;
  // kNoRegister if all are in use.
  RegisterId take(bool floating);
  // This register, which nothing uses.
  void take_exactly(RegisterId id);
  void retain(RegisterId id);
  void release(RegisterId id);
  std::uint32_t uses(RegisterId id) const { return states_[id].uses; }

  // Pinned registers are taken by nobody and change only with their variable.
  void pin(RegisterId id);
  void unpin(RegisterId id);
  bool pinned(RegisterId id) const { return states_[id].pinned; }

  // The register now holds what a load of this type from these bytes would give.
  void remember(RegisterId id, const Extent& where, bytecode::MemType type);
  // Before the register changes.
  void forget(RegisterId id) {
    states_[id].remembers = false;
    states_[id].bounds = {};
  }
  void forget_all();
  void forget_overlapping(const Extent& written, const InstanceRange& instances);
  // kNoRegister if no register holds it.
  RegisterId find(const Extent& where, bytecode::MemType type) const;

  // The code has seen to it that the number in the register lies within the bounds.
  void bound(RegisterId id, const Bounds& bounds) { states_[id].bounds = bounds; }
  bool within(RegisterId id, const Bounds& bounds) const {
    return bounds.lower <= states_[id].bounds.lower && states_[id].bounds.upper <= bounds.upper;
  }

 private:
  struct State {
    bool usable = false;
    bool pinned = false;
    bool remembers = false;
    bytecode::MemType type = bytecode::MemType::Bool;
    std::uint32_t uses = 0;
    std::uint32_t stamp = 0;
    Extent where;
    Bounds bounds;
  };

  std::array<State, kRegisterCount> states_{};
  std::uint32_t clock_ = 0;
};

}  // namespace stepwright::native
