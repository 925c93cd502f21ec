#pragma once

// Holds the programs of a runtime from their preparation until nothing needs them: the one that runs, those
// on their way to the scan thread, the one before the newest change while that is on trial, and those that
// ended but hold events that nobody has taken.
//
// Threads: the service's. Invariant: events come in the order of their sequence, whichever program they are
// of. Programs that are not needed are handed out, to be destroyed by a thread that may wait.
//
//   registry.add(std::move(program), std::move(plan), ticket);
//   if (const ProgramRegistry::Held* held = registry.done(completion.ticket)) ...
//   while (const ProgramRegistry::Held* held = registry.next_event()) ... held->program->events().pop();
//   preparer.discard(registry.take_unused(loop.figures().program, loop.figures().kept));

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/host/change_plan.h"
#include "runtime/host/prepared_program.h"

namespace stepwright::host {

class ProgramRegistry {
 public:
  struct Held {
    std::unique_ptr<PreparedProgram> program;
    std::unique_ptr<ChangePlan> plan;  // null: it replaces what runs
    std::uint64_t ticket = 0;
    bool pending = true;  // the scan thread has not answered yet
  };

  void add(std::unique_ptr<PreparedProgram> program, std::unique_ptr<ChangePlan> plan, std::uint64_t ticket);
  // The program of that ticket, which the scan thread has answered now; null if the ticket is of something
  // else.
  const Held* done(std::uint64_t ticket);
  bool any_pending() const;
  template <typename Function>
  void for_each(const Function& function) const {
    for (const Held& held : held_) function(*held.program);
  }
  // Null if it is none of them.
  PreparedProgram* find(const PreparedProgram* program) const;

  // The program that holds the oldest event; null if there is none.
  const Held* next_event() const;
  // Hands out what neither the scan thread (which names what it still uses) nor an event needs. Requires
  // names that the scan thread published before this call.
  [[nodiscard]] std::vector<Held> take_unused(const PreparedProgram* running, const PreparedProgram* kept);

 private:
  std::vector<Held> held_;
};

}  // namespace stepwright::host
