#include "runtime/native/internal/x86/registers.h"

#include <cassert>

namespace stepwright::native {

Registers::Registers() {
  for (const RegisterId id : kGeneral) states_[id].usable = true;
  for (RegisterId id = kFirstXmm; id < kRegisterCount; ++id) states_[id].usable = true;
}

RegisterId Registers::take(bool floating) {
  RegisterId best = kNoRegister;
  const RegisterId first = floating ? kFirstXmm : 0;
  for (RegisterId id = first; id < first + kFirstXmm; ++id) {
    const State& state = states_[id];
    if (!state.usable || state.pinned || state.uses != 0) continue;
    if (!state.remembers) {
      best = id;
      break;
    }
    if (best == kNoRegister || state.stamp < states_[best].stamp) best = id;
  }
  if (best != kNoRegister) take_exactly(best);
  return best;
}

void Registers::take_exactly(RegisterId id) {
  State& state = states_[id];
  assert(state.usable && !state.pinned && state.uses == 0);
  state.uses = 1;
  forget(id);
}

void Registers::retain(RegisterId id) {
  ++states_[id].uses;
}

void Registers::release(RegisterId id) {
  assert(states_[id].uses > 0);
  --states_[id].uses;
}

void Registers::pin(RegisterId id) {
  assert(states_[id].uses == 0);
  states_[id].pinned = true;
  forget(id);
}

void Registers::unpin(RegisterId id) {
  states_[id].pinned = false;
}

void Registers::remember(RegisterId id, const Extent& where, bytecode::MemType type) {
  State& state = states_[id];
  if (state.pinned) return;
  state.remembers = true;
  state.where = where;
  state.type = type;
  state.stamp = ++clock_;
}

void Registers::forget_all() {
  for (RegisterId id = 0; id < kRegisterCount; ++id) forget(id);
}

void Registers::forget_overlapping(const Extent& written, const InstanceRange& instances) {
  for (State& state : states_) {
    if (state.remembers && may_overlap(state.where, written, instances)) state.remembers = false;
  }
}

RegisterId Registers::find(const Extent& where, bytecode::MemType type) const {
  for (RegisterId id = 0; id < kRegisterCount; ++id) {
    const State& state = states_[id];
    if (state.remembers && state.type == type && state.where == where) return id;
  }
  return kNoRegister;
}

}  // namespace stepwright::native
