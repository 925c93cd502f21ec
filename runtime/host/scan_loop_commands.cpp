// Commands, as the scan thread performs them between two scans.

#include <cassert>
#include <cstring>
#include <utility>

#include "runtime/host/scan_loop.h"

namespace stepwright::host {
namespace {

// Of the time between two scans, for commands.
constexpr std::int64_t kCommandShareNs = 200'000;

Outcome outcome_of(image::BitsStatus status) {
  switch (status) {
    case image::BitsStatus::Done:
      return Outcome::Done;
    case image::BitsStatus::OutOfBounds:
      return Outcome::OutOfBounds;
    case image::BitsStatus::ForcesFull:
      return Outcome::ForcesFull;
    case image::BitsStatus::NotForced:
      return Outcome::NotForced;
  }
  return Outcome::OutOfBounds;
}

}  // namespace

void ScanLoop::take_commands() {
  end_forces();
  bool any = false;
  bool stale = false;
  const std::int64_t begin_ns = clock_.now_ns();
  commands_left_ = false;
  while (auto command = next_command(begin_ns)) {
    Completion completion = held_apply(*command);
    publish_forces();
    // Who sees the completion must find a status that knows of it, and one that lets go of what was held: who
    // learns of a load may destroy the program before.
    figures_.store(now_);
    // There is room: the service has no more commands under way than either queue holds.
    finished_.push_back(std::move(completion));
    any = true;
    stale = stale || command->kind != CommandKind::Change;  // a change publishes itself, as part of its pause
  }
  if (!any) return;
  if (stale) {
    const auto hold = hold_tasks();
    publish();
  }
  // Behind the snapshot: who is told that a value is written finds it there.
  for (Completion& completion : finished_) {
    [[maybe_unused]] const bool pushed = completions_.push(std::move(completion));
    assert(pushed);
  }
  finished_.clear();
  news_.notify();
}

// Real clock: commands take turns with the scans. They have a share of the time after each, and more of it as
// long as the next one is far.
bool ScanLoop::time_for_commands(std::int64_t begin_ns) {
  if (!real() || program_ == nullptr) return true;
  const bool scans = now_.state == RuntimeState::Running;
  const std::int64_t due_ns = scans ? program_->cycle().next_time_ns() : idle_due_ns_;
  const std::int64_t now_ns = clock_.now_ns();
  return now_ns - begin_ns < kCommandShareNs || origin_ns_ + due_ns - now_ns > kUndisturbedNs;
}

Completion ScanLoop::held_apply(const Command& command) {
  Completion completion;
  {
    const auto hold = hold_tasks();
    completion = meant_for_another(command) ? other_program(command) : apply(command);
  }
  // The program that was held may go now, unless a trial needs it.
  if (!trial_.active()) now_.kept = nullptr;
  return completion;
}

// Here and not where the request comes in: what came between, a load, a change or a rollback, has made
// another variable of the address.
bool ScanLoop::meant_for_another(const Command& command) const {
  return names_memory(command.kind) && program_ != nullptr &&
         command.program_digest.view() != program_->digest();
}

Completion ScanLoop::other_program(const Command& command) const {
  Completion completion{command.ticket, Outcome::ProgramDiffers, {}};
  completion.program_digest = FixedText<kDigestLetters>(program_->digest());
  return completion;
}

Completion ScanLoop::apply(const Command& command) {
  const auto done = [&](Outcome outcome) { return Completion{command.ticket, outcome, {}}; };
  switch (command.kind) {
    case CommandKind::Load:
      return done(load(command.program));
    case CommandKind::Start:
      if (auto problems = refused_start(command); !problems.empty())
        return {command.ticket, Outcome::RetainRefused, std::move(problems)};
      return done(start(command));
    case CommandKind::Stop:
      stopped_at_ = command.order;
      return done(stop(command.text.view()));
    case CommandKind::Acknowledge:
      if (command.event >= now_.events.last) gate_.release(reading());
      return done(Outcome::Done);
    case CommandKind::Force:
      return done(force(command.bits, command.duration_ns));
    case CommandKind::Unforce:
      return done(unforce(command.bits));
    case CommandKind::Write:
      return done(write(command.bits));
    case CommandKind::WriteBlock:
      return done(write_block(*command.block));
    case CommandKind::InjectFault:
      return inject_fault(command);
    case CommandKind::SupervisorAlive:
      gate_.supervisor_is_there();
      return done(Outcome::Done);
    case CommandKind::SupervisorLost:
      if (config_.on_lost_supervisor == LostSupervisor::Safe) stopped_at_ = command.order;
      supervisor_lost();
      return done(Outcome::Done);
    case CommandKind::Step:
      return step(command);
    case CommandKind::Continue:
      gate_.go_on(now_.state == RuntimeState::Running, reading());
      return done(Outcome::Done);
    case CommandKind::RecordBegin:
      record(command.recording);
      return done(Outcome::Done);
    case CommandKind::RecordEnd:
      tap_.end("it was told to");
      return done(Outcome::Done);
    case CommandKind::Change:
      return change(command);
  }
  return done(Outcome::Done);
}

Outcome ScanLoop::load(PreparedProgram* program) {
  stop("another program was loaded");
  if (program_ != nullptr) {
    earlier_scans_.add(program_->cycle().statistics().scan_time);
    earlier_overruns_ += program_->cycle().statistics().overruns;
  }
  // The outputs stay as safe as they are, and for the same reason, until the new program is started.
  const auto cause = program_ == nullptr ? scan::SafeCause::Stop : program_->cycle().safe_state().cause();
  program->cycle().inherit_outputs(io_.outputs(), cause, safe_time_ns());
  now_.kept = program_;  // until its tasks are let go
  adopt(*program);
  now_.state = RuntimeState::Stopped;
  tap_.loaded(program->digest());
  publish();  // before the completion: the service lets go of what the figures do not name
  return Outcome::Done;
}

void ScanLoop::adopt(PreparedProgram& program) {
  program_ = &program;
  program.steps().reset(program.image().bytes());
  now_.program = &program;
  publish_forces();
  if (real()) take_place_of(program.tasks());
}

// The scan thread is the thread of the task that leads: as urgent, on its processor, and at ordinary priority
// if that task is freewheeling. Most programs ask for what is there already.
void ScanLoop::take_place_of(const TaskPlan& tasks) {
  const ThreadPlacement& wanted = tasks.tasks[tasks.leader].placement;
  if (wanted == placement_) return;
  placement_ = wanted;
  // A priority that is refused was refused when the thread began, which the status says.
  static_cast<void>(place_thread(wanted));
}

// Why the start would lose what the user wants kept.
result::Diagnostics ScanLoop::refused_start(const Command& command) const {
  if (program_ == nullptr || now_.state == RuntimeState::Running || command.order < stopped_at_) return {};
  return retain_.refusal(program_->retained(), command.cold);
}

Outcome ScanLoop::start(const Command& command) {
  if (command.order < stopped_at_) return Outcome::Overtaken;
  if (program_ == nullptr) return Outcome::NoProgram;
  if (now_.state == RuntimeState::Running) return Outcome::AlreadyRunning;
  if (real()) {
    next_start_ns_ = clock_.now_ns() - origin_ns_;
    // A start that the first scan would take back is none: whoever asks is told now.
    if (!command.regardless && (io_.lapsed() || io_.read_inputs(next_start_ns_, program_->image().inputs()) ==
                                                    image::IoStatus::Lost))
      return Outcome::IoLost;
  }
  // Initial values, then what is retained; what somebody forced stays forced.
  const image::ForceTable forces = program_->cycle().forces();
  program_->cycle().start({next_start_ns_, now_.scan, now_.trace_hash});
  program_->cycle().forces() = forces;
  retain_.begin(program_->retained(), program_->image().bytes(), command.cold);
  program_->steps().reset(program_->image().bytes());
  program_->task_threads().start(next_start_ns_);
  gate_.arm(command.barrier);
  now_.state = RuntimeState::Running;
  tap_.state(record::StateCause::Start, running());
  emit(EventKind::Started, {}, {});
  gate_.begin(reading());
  return Outcome::Done;
}

// Without effect unless it runs: what is stopped or trapped has its outputs in their safe state already.
Outcome ScanLoop::stop(std::string_view reason, scan::SafeCause cause) {
  if (now_.state != RuntimeState::Running) return program_ == nullptr ? Outcome::NoProgram : Outcome::Done;
  end_trial();
  gate_.rest(reading());
  // In real time the next scan may be far away: ramps begin now.
  next_start_ns_ = real() ? safe_time_ns() : program_->cycle().next_time_ns();
  idle_due_ns_ = next_start_ns_;
  program_->task_threads().stop();
  retain_.finish(program_->image().bytes());  // before outputs go to their safe state
  if (real()) {
    program_->cycle().stop(cause, next_start_ns_);
  } else {
    program_->cycle().stop(cause);
  }
  program_->publish_timings();
  now_.state = RuntimeState::Stopped;
  tap_.stopped(reason);
  emit(EventKind::Stopped, {}, reason);
  return Outcome::Done;
}

Outcome ScanLoop::force(const ImageBits& bits, std::int64_t duration_ns) {
  if (program_ == nullptr) return Outcome::NoProgram;
  const std::size_t image_bytes = program_->image().bytes().size();
  image::Force wanted;
  image::BitsStatus status = image::to_force(bits, image_bytes, wanted);
  if (status != image::BitsStatus::Done) return outcome_of(status);
  const BoolBytes& bools = program_->bools();
  if (wanted.bit == image::kWholeBytes) {
    wanted.value = bools.settled(wanted.address, wanted.size, wanted.value);
  } else if (wanted.bit != 0 && bools.holds(wanted.address)) {
    return Outcome::OutOfBounds;  // a BOOL in a byte of its own has no other bit
  }
  if (duration_ns > 0) wanted.end_ns = clock_.now_ns() + duration_ns;
  status = image::set_force(program_->cycle().forces(), wanted, image_bytes);
  if (status == image::BitsStatus::Done) tap_.forced(wanted);
  return outcome_of(status);
}

Outcome ScanLoop::unforce(const ImageBits& bits) {
  if (program_ == nullptr) return Outcome::NoProgram;
  image::Force wanted;
  image::BitsStatus status = image::to_force(bits, program_->image().bytes().size(), wanted);
  if (status == image::BitsStatus::Done) status = image::clear_force(program_->cycle().forces(), wanted);
  if (status == image::BitsStatus::Done) tap_.unforced(wanted.address, wanted.bit);
  return outcome_of(status);
}

Outcome ScanLoop::write(const ImageBits& bits) {
  if (program_ == nullptr) return Outcome::NoProgram;
  const std::span<std::byte> image = program_->image().bytes();
  const image::BitsStatus status = image::write_bits(image, bits);
  if (status != image::BitsStatus::Done) return outcome_of(status);
  const auto written = image.subspan(bits.byte_offset, image::reach_of(bits));
  program_->bools().settle(bits.byte_offset, written);
  tap_.wrote(bits.byte_offset, written);
  return Outcome::Done;
}

Outcome ScanLoop::write_block(const BlockWrite& block) {
  if (program_ == nullptr) return Outcome::NoProgram;
  const std::size_t image_bytes = program_->image().bytes().size();
  for (const ImageBits& part : block.parts)
    if (!image::within(part, image_bytes)) return Outcome::OutOfBounds;
  for (const ImageBits& part : block.parts) write(part);
  return Outcome::Done;
}

Completion ScanLoop::inject_fault(const Command& command) {
  Completion completion{command.ticket, Outcome::Done, {}};
  if (plant_ == nullptr) {
    completion.outcome = Outcome::NoPlant;
  } else if (auto injected = plant_->inject_fault(command.text.str(), command.value); !injected) {
    completion.outcome = Outcome::PlantRefused;
    completion.problems = std::move(injected.error());
  }
  return completion;
}

void ScanLoop::supervisor_lost() {
  if (config_.on_lost_supervisor == LostSupervisor::Safe) {
    gate_.supervisor_is_away();
    stop(kSupervisorLost, scan::SafeCause::SupervisorLost);
  } else {
    gate_.supervisor_is_lost(reading());
  }
}

}  // namespace stepwright::host
