#include "runtime/host/program_registry.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace stepwright::host {

void ProgramRegistry::add(std::unique_ptr<PreparedProgram> program, std::unique_ptr<ChangePlan> plan,
                          std::uint64_t ticket) {
  held_.push_back({std::move(program), std::move(plan), ticket, true});
}

const ProgramRegistry::Held* ProgramRegistry::done(std::uint64_t ticket) {
  for (Held& held : held_) {
    if (!held.pending || held.ticket != ticket) continue;
    held.pending = false;
    return &held;
  }
  return nullptr;
}

bool ProgramRegistry::any_pending() const {
  return std::any_of(held_.begin(), held_.end(), [](const Held& held) { return held.pending; });
}

PreparedProgram* ProgramRegistry::find(const PreparedProgram* program) const {
  for (const Held& held : held_)
    if (held.program.get() == program) return held.program.get();
  return nullptr;
}

const ProgramRegistry::Held* ProgramRegistry::next_event() const {
  const Held* oldest = nullptr;
  // Whoever sees an event finds every earlier one too, in whatever ring, but only if it looks after that: the
  // rings are gone through again until no earlier one comes up.
  for (bool again = true; again;) {
    again = false;
    for (const Held& held : held_) {
      const EventRing::Slot* slot = held.program->events().front();
      if (slot == nullptr) continue;
      if (oldest != nullptr && oldest->program->events().front()->note.sequence <= slot->note.sequence) {
        continue;
      }
      oldest = &held;
      again = true;
    }
  }
  return oldest;
}

std::vector<ProgramRegistry::Held> ProgramRegistry::take_unused(const PreparedProgram* running,
                                                                const PreparedProgram* kept) {
  // An event may speak of a program other than its own.
  if (next_event() != nullptr) return {};
  const auto needed = [&](const Held& held) {
    return held.pending || held.program.get() == running || held.program.get() == kept;
  };
  const auto first_gone = std::stable_partition(held_.begin(), held_.end(), needed);
  std::vector<Held> gone(std::make_move_iterator(first_gone), std::make_move_iterator(held_.end()));
  held_.erase(first_gone, held_.end());
  for (Held& held : held_)
    if (!held.pending && kept == nullptr) held.plan.reset();
  return gone;
}

}  // namespace stepwright::host
