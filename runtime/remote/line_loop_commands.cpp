// Commands, as the line's thread performs them between two turns.

#include <array>
#include <utility>

#include "runtime/remote/line_loop.h"

namespace stepwright::remote {
namespace {

using host::CommandKind;
using host::Completion;
using host::Outcome;

// By the detail of Refusal::NotSupported.
constexpr std::array kLacking = {"",
                                 "it has too little memory for image, stack and retained values",
                                 "it has fewer inputs",
                                 "it has fewer outputs",
                                 "it retains fewer values",
                                 "its verifier has too little memory: shorter functions need less",
                                 "its firmware has no strings and no elementary functions"};

const char* words_for(control::Refusal refusal) {
  switch (refusal) {
    case control::Refusal::TooLarge:
      return "the program is larger than the controller takes";
    case control::Refusal::Incomplete:
      return "a part of the program did not arrive";
    case control::Refusal::WrongDigest:
      return "the program arrived damaged";
    case control::Refusal::NotVerified:
      return "the controller's verifier refuses the program";
    case control::Refusal::FlashFailed:
      return "the controller's flash memory failed";
    case control::Refusal::NotStopped:
      return "the controller does that only while nothing runs";
    case control::Refusal::NotSupported:
      return "the program uses what this controller lacks";
    case control::Refusal::BadArguments:
      return "the controller does not accept the arguments";
    default:
      return "the controller does not know the command";
  }
}

result::Diagnostics one(const char* code, result::Location where, std::string message, std::string hint) {
  return {{code, result::Severity::Error, std::move(where), std::move(message), std::move(hint)}};
}

}  // namespace

void LineLoop::take_commands() {
  end_forces();
  while (auto command = queues_.next_command()) perform(*command);
}

void LineLoop::take_urgent() {
  while (auto command = queues_.next_urgent()) perform(*command);
}

void LineLoop::perform(const RemoteCommand& command) {
  Completion completion = apply(command);
  publish();  // who sees the completion must find a status that knows of it
  queues_.complete(std::move(completion));
}

// What this side does by itself; the rest needs the controller.
Completion LineLoop::apply(const RemoteCommand& asked) {
  const host::Command& command = asked.command;
  const Completion done{command.ticket, Outcome::Done, {}};
  switch (command.kind) {
    case CommandKind::Acknowledge:
      if (command.event >= events_.last) gate_.release(reading());
      return done;
    case CommandKind::SupervisorAlive:
      gate_.supervisor_is_there();
      return done;
    case CommandKind::SupervisorLost:
      return supervisor_lost(command);
    case CommandKind::InjectFault:
      return inject(command);
    case CommandKind::Step:
      return step(command);
    case CommandKind::Continue:
      gate_.go_on(running(), reading());
      return done;
    case CommandKind::RecordEnd:
      return done;
    case CommandKind::RecordBegin:
    case CommandKind::WriteBlock:
    case CommandKind::Change:  // refused before they come here
      return failed(command.ticket, one("R0147", {link_.name(), 0, 0}, "this controller cannot do that", ""));
    case CommandKind::Load:
    case CommandKind::Start:
    case CommandKind::Stop:
    case CommandKind::Force:
    case CommandKind::Unforce:
    case CommandKind::Write:
      break;
  }
  return reach(asked);
}

Completion LineLoop::reach(const RemoteCommand& asked) {
  const host::Command& command = asked.command;
  if (command.kind == CommandKind::Stop) stopped_at_ = command.order;
  if (command.kind == CommandKind::Stop && !running())
    return {command.ticket, program_ == nullptr ? Outcome::NoProgram : Outcome::Done, {}};
  if (!contact_) {
    return failed(command.ticket,
                  one("R0141", {link_.name(), 0, 0}, "the controller is lost: " + line_problem_,
                      "the gateway goes on looking for it"));
  }
  switch (command.kind) {
    case CommandKind::Load:
      return load(asked);
    case CommandKind::Start:
      return start(command);
    case CommandKind::Stop:
      return stop(command, command.text.view());
    default:
      return bits(command);
  }
}

Completion LineLoop::failed(std::uint64_t ticket, result::Diagnostics why) {
  return {ticket, Outcome::Refused, std::move(why)};
}

// Of a request that the line did not carry: then the controller is lost, too.
Completion LineLoop::lost(std::uint64_t ticket, result::Diagnostics why) {
  if (contact_) lose(why);
  return failed(ticket, std::move(why));
}

Completion LineLoop::refused(std::uint64_t ticket, const CommandAnswer& answer) {
  switch (answer.refusal) {
    case control::Refusal::Done:
      return {ticket, Outcome::Done, {}};
    case control::Refusal::NoProgram:
      return {ticket, Outcome::NoProgram, {}};
    case control::Refusal::AlreadyRunning:
      return {ticket, Outcome::AlreadyRunning, {}};
    case control::Refusal::OutOfBounds:
      return {ticket, Outcome::OutOfBounds, {}};
    case control::Refusal::ForcesFull:
      return {ticket, Outcome::ForcesFull, {}};
    case control::Refusal::NotForced:
      return {ticket, Outcome::NotForced, {}};
    case control::Refusal::OtherProgram: {
      Completion completion{ticket, Outcome::ProgramDiffers, {}};
      if (program_ != nullptr)
        completion.program_digest = host::FixedText<host::kDigestLetters>(program_->digest());
      return completion;
    }
    default:
      return failed(ticket, refusal(answer));
  }
}

// runtime/doc/modbus_controller.md says what the details of a refusal are.
result::Diagnostics LineLoop::refusal(const CommandAnswer& answer) const {
  if (answer.refusal == control::Refusal::NotSupported && answer.detail < kLacking.size())
    return one(kControllerRefuses, {link_.name(), 0, 0}, words_for(answer.refusal), kLacking[answer.detail]);
  return one(kControllerRefuses, {link_.name(), 0, 0}, words_for(answer.refusal),
             "refusal " + std::to_string(static_cast<unsigned>(answer.refusal)) + ", detail " +
                 std::to_string(answer.detail));
}

Completion LineLoop::start(const host::Command& command) {
  if (command.order < stopped_at_) return {command.ticket, Outcome::Overtaken, {}};
  if (program_ == nullptr) return {command.ticket, Outcome::NoProgram, {}};
  if (running()) return {command.ticket, Outcome::AlreadyRunning, {}};
  std::uint16_t flags = 0;
  if (simulated()) flags |= control::kStartLockStep;
  if (command.cold) flags |= control::kStartCold;
  auto answer = link_.command(control::Command::Start, std::array{flags});
  if (!answer) return lost(command.ticket, answer.error());
  if (!answer->done()) return refused(command.ticket, *answer);
  if (auto begun = begin_run(); !begun) return lost(command.ticket, begun.error());
  gate_.arm(command.barrier);
  now_.state = host::RuntimeState::Running;
  progress_ns_ = due_ns_ = wall_ns();
  emit(host::EventKind::Started, {});
  gate_.begin(reading());
  return {command.ticket, Outcome::Done, {}};
}

// Image and clock as the start left them.
LineLoop::Done LineLoop::begin_run() {
  auto status = link_.status();
  if (!status) return result::forward(status);
  // By the clock the first steps may have changed by now: then their image stands for that of the start.
  known_event_ = status->event_kind == control::Event::Started ? status->event : status->event - 1;
  if (auto read = read_event_image(); !read) return read;
  auto outputs = link_.outputs(plant_.outputs());
  if (!outputs) return result::forward(outputs);
  turn_ = outputs->turn;
  base_ns_ = next_ns_ - outputs->next_ns;
  return {};
}

Completion LineLoop::stop(const host::Command& command, std::string_view reason, scan::SafeCause cause) {
  const auto stopped = [&]() -> Done {
    auto answer = link_.command(control::Command::Stop);
    if (!answer) return result::forward(answer);
    auto status = link_.status();
    if (!status) return result::forward(status);
    if (status->state == control::State::Running)
      return result::fail("R0143", {link_.name(), 0, 0}, "the controller runs on after a stop");
    known_event_ = status->event;
    if (auto read = read_event_image(); !read) return read;
    auto outputs = link_.outputs(plant_.outputs());
    if (!outputs) return result::forward(outputs);
    now_.scan = outputs->scan;
    now_.trace_hash = outputs->trace_hash;
    return {};
  };
  if (auto done = stopped(); !done) return lost(command.ticket, done.error());
  gate_.rest(reading());
  now_.state = host::RuntimeState::Stopped;
  static_cast<void>(plant_.write(own_time_ns()));
  emit(host::EventKind::Stopped, std::string(reason), cause);
  return {command.ticket, Outcome::Done, {}};
}

// Write, force and unforce: what the runtime on the host would refuse is refused before it is sent.
Completion LineLoop::bits(const host::Command& command) {
  if (program_ == nullptr) return {command.ticket, Outcome::NoProgram, {}};
  if (command.program_digest.view() != program_->digest()) {
    Completion completion{command.ticket, Outcome::ProgramDiffers, {}};
    completion.program_digest = host::FixedText<host::kDigestLetters>(program_->digest());
    return completion;
  }
  image::ImageBits bits = command.bits;
  image::Force force;
  const bool write = command.kind == CommandKind::Write;
  const bool possible = write ? image::within(bits, image_.size())
                              : image::to_force(bits, image_.size(), force) == image::BitsStatus::Done;
  const bool one_bit = !write && force.bit != image::kWholeBytes;
  const bool spare_bit = one_bit && force.bit != 0 && program_->bools().holds(force.address);
  if (!possible || spare_bit) return {command.ticket, Outcome::OutOfBounds, {}};
  if (!one_bit) {
    const auto bytes = static_cast<std::uint32_t>(image::reach_of(bits));
    bits.value = program_->bools().settled(bits.byte_offset, bytes, bits.value);
  }
  // It ends where it is: whoever watches here may die before.
  const auto ms =
      static_cast<std::uint64_t>((std::max<std::int64_t>(command.duration_ns, 0) + 999'999) / 1'000'000);
  const auto arguments = bits_arguments(bits, program_->digest_bytes(), ms);
  const control::Command code = write                                ? control::Command::WriteBits
                                : command.kind == CommandKind::Force ? control::Command::Force
                                                                     : control::Command::Unforce;
  auto answer = link_.command(code, arguments);
  if (!answer) return lost(command.ticket, answer.error());
  if (answer->done() && command.kind == CommandKind::Force) {
    if (!one_bit) force.value = bits.value & bits.mask;
    if (command.duration_ns > 0) force.end_ns = wall_ns() + command.duration_ns;
    static_cast<void>(forces_.set(force, image_.size()));
  }
  if (answer->done() && command.kind == CommandKind::Unforce) forces_.clear(force.address, force.bit);
  return refused(command.ticket, *answer);
}

// The controller has released them by itself.
void LineLoop::end_forces() {
  bool any = false;
  image::Force ended;
  while (forces_.take_ended(wall_ns(), ended)) any = true;
  if (any) publish();
}

Completion LineLoop::step(const host::Command& command) {
  if (!simulated()) return {command.ticket, Outcome::NotSimulated, {}};
  if (program_ == nullptr) return {command.ticket, Outcome::NoProgram, {}};
  gate_.step(command.count, reading());
  return {command.ticket, Outcome::Done, {}, now_.scan + command.count};
}

Completion LineLoop::inject(const host::Command& command) {
  if (plant_.plant() == nullptr) return {command.ticket, Outcome::NoPlant, {}};
  if (auto injected = plant_.plant()->inject_fault(command.text.str(), command.value); !injected)
    return {command.ticket, Outcome::PlantRefused, std::move(injected.error())};
  return {command.ticket, Outcome::Done, {}};
}

Completion LineLoop::supervisor_lost(const host::Command& command) {
  if (config_.host.on_lost_supervisor != host::LostSupervisor::Safe) {
    gate_.supervisor_is_lost(reading());
    return {command.ticket, Outcome::Done, {}};
  }
  gate_.supervisor_is_away();
  stopped_at_ = command.order;
  if (!running() || !contact_) return {command.ticket, Outcome::Done, {}};
  return stop(command, host::kSupervisorLost, scan::SafeCause::SupervisorLost);
}

}  // namespace stepwright::remote
