#pragma once

// Which registers hold something. A register is used by values (counted), pinned to a variable for the whole
// of a loop, or free; a free one may still hold a variable's value, until something else needs the register
// or the variable changes.

#include <array>
#include <cstdint>

#include "runtime/bytecode/value_type.h"
#include "runtime/native/internal/extent.h"
#include "runtime/native/internal/machine.h"

namespace stepwright::native {

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
  void forget(RegisterId id) { states_[id].remembers = false; }
  void forget_all();
  void forget_overlapping(const Extent& written, const InstanceRange& instances);
  // kNoRegister if no register holds it.
  RegisterId find(const Extent& where, bytecode::MemType type) const;

 private:
  struct State {
    bool usable = false;
    bool pinned = false;
    bool remembers = false;
    bytecode::MemType type = bytecode::MemType::Bool;
    std::uint32_t uses = 0;
    std::uint32_t stamp = 0;
    Extent where;
  };

  std::array<State, kRegisterCount> states_{};
  std::uint32_t clock_ = 0;
};

}  // namespace stepwright::native
