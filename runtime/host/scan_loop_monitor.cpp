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
    gate_.step(command.count, reading());
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

// Before every turn, and no wait lasts longer than the next end: whoever gave the force may be gone. In
// simulated time, too, a minute of a person is one of the wall; a recording knows behind which scan it ended.
void ScanLoop::end_forces() {
  if (program_ == nullptr) return;
  image::ForceTable& forces = program_->cycle().forces();
  if (forces.next_end_ns() == image::kNoEnd) return;
  const std::int64_t now_ns = clock_.now_ns();
  if (forces.next_end_ns() > now_ns) return;
  {
    const auto hold = hold_tasks();
    image::Force ended;
    while (forces.take_ended(now_ns, ended)) tap_.unforced(ended.address, ended.bit);
  }
  publish_forces();
}

// After every command, so that what it forced is known before it is answered, and whenever another program
// takes over.
void ScanLoop::publish_forces() {
  if (program_ == nullptr) return;
  const auto forces = program_->cycle().forces().forces();
  ForceList list{};
  list.program_digest = FixedText<kDigestLetters>(program_->digest());
  list.count = forces.size();
  std::copy(forces.begin(), forces.end(), list.forces.begin());
  forces_.store(list);
}

}  // namespace stepwright::host
