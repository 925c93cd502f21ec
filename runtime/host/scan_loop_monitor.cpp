// What the scan thread does for people who look on: steps, recordings, the list of forces.

#include <algorithm>

#include "runtime/host/scan_loop.h"

namespace stepwright::host {

Completion ScanLoop::step(const Command& command) {
  Completion completion{command.ticket, Outcome::Done, {}, 0};
  if (real()) {
    completion.outcome = Outcome::NotSimulated;
  } else if (program_ == nullptr) {
    completion.outcome = Outcome::NoProgram;
  } else {
    end_stretch();
    stepper_.step(command.count);
    completion.scan = now_.scan + command.count;
  }
  return completion;
}

void ScanLoop::record(record::Session* session) {
  tap_.begin(session);
  if (program_ != nullptr) tap_.state(record::StateCause::Begin, running());
}

record::Running ScanLoop::running() {
  return {program_->digest(), program_->cycle(), program_->image()};
}

// After every command: what it forced is known before it is answered.
void ScanLoop::publish_forces() {
  if (program_ == nullptr) return;
  const auto forces = program_->cycle().forces().forces();
  ForceList list{};
  list.count = forces.size();
  std::copy(forces.begin(), forces.end(), list.forces.begin());
  forces_.store(list);
}

}  // namespace stepwright::host
