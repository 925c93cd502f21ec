// What each command does (runtime/doc/modbus_controller.md, Commands).

#include <algorithm>
#include <array>
#include <limits>

#include "firmware/app/controller.h"

namespace stepwright::app {

namespace control = modbus::control;
using control::Refusal;
using modbus::pdu::Exception;

namespace {

constexpr std::uint16_t kStartWords = control::command::kArguments + 1;
constexpr std::uint16_t kBeginWords = control::command::kArguments + 2 + control::kDigestRegisters;
constexpr std::uint16_t kBitsWords = control::command::kArguments + control::bits::kCount;
constexpr std::uint64_t kNsPerMs = 1'000'000;

std::span<const std::uint16_t> arguments(const CommandWords& command) {
  return std::span(command.words).subspan(control::command::kArguments);
}

Refusal refusal_of(image::BitsStatus status) {
  switch (status) {
    case image::BitsStatus::Done:
      return Refusal::Done;
    case image::BitsStatus::OutOfBounds:
      return Refusal::OutOfBounds;
    case image::BitsStatus::ForcesFull:
      return Refusal::ForcesFull;
    case image::BitsStatus::NotForced:
      return Refusal::NotForced;
  }
  return Refusal::OutOfBounds;
}

// When a force ends; one that would last longer than the clock does has no end.
std::int64_t end_of(std::uint64_t ms, std::int64_t now_ns) {
  const auto left_ns = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() - now_ns);
  if (ms == 0 || ms >= left_ns / kNsPerMs) return image::kNoEnd;
  return now_ns + static_cast<std::int64_t>(ms * kNsPerMs);
}

image::BitsStatus change_forces(Machine& machine, control::Command code, const image::ImageBits& bits,
                                std::int64_t end_ns) {
  image::Force force;
  const image::BitsStatus status = image::to_force(bits, machine.image().size(), force);
  if (status != image::BitsStatus::Done) return status;
  force.end_ns = end_ns;
  if (code == control::Command::Unforce) return image::clear_force(*machine.forces(), force);
  return image::set_force(*machine.forces(), force, machine.image().size());
}

}  // namespace

Exception Controller::submit(const CommandWords& command) {
  if (command.number == answer_.number) return Exception::None;
  if (command_waits_) return command.number == waiting_.number ? Exception::None : Exception::DeviceBusy;
  waiting_ = command;
  command_waits_ = true;
  return Exception::None;
}

// False while the digest of a transfer is being taken.
bool Controller::prepared(const CommandWords& command) {
  const auto code = static_cast<control::Command>(command.words[control::command::kCode]);
  return code != control::Command::TransferCommit || transfer_.digest_step();
}

Judgement Controller::carry_out(const CommandWords& command) {
  const auto code = static_cast<control::Command>(command.words[control::command::kCode]);
  switch (code) {
    case control::Command::Nothing:
      return {};
    case control::Command::Start:
      if (command.count < kStartWords) return {Refusal::BadArguments, kStartWords};
      return start(arguments(command)[0]);
    case control::Command::Stop:
      return stop();
    case control::Command::TransferBegin:
      if (command.count < kBeginWords) return {Refusal::BadArguments, kBeginWords};
      return begin_transfer(command);
    case control::Command::TransferCommit:
      return commit();
    case control::Command::TransferAbort:
      transfer_.abort();
      return {};
    case control::Command::WriteBits:
    case control::Command::Force:
    case control::Command::Unforce:
      if (command.count < kBitsWords) return {Refusal::BadArguments, kBitsWords};
      return bits(code, command);
    case control::Command::ClearRetained:
      return clear_retained();
  }
  return {Refusal::UnknownCommand, 0};
}

Judgement Controller::start(std::uint16_t flags) {
  while (retain_.busy()) retain_.step();  // they are newer than what stands in the flash
  auto kept = retain_.values_of(machine_.digest());
  if ((flags & control::kStartCold) != 0 || kept.size() != machine_.retain_copy().size()) kept = {};
  const std::int64_t now_ns = board_.tick.now_ns();
  const bool lock_step = (flags & control::kStartLockStep) != 0;
  const Refusal refusal = machine_.start({.lock_step = lock_step, .now_ns = now_ns, .retained = kept});
  if (refusal != Refusal::Done) return {refusal, 0};
  inputs_lost_ = false;
  turn_ = 0;
  sign_of_life_ns_ = now_ns;
  retain_due_ns_ = now_ns + kRetainPeriodNs;
  retain_restored_ = !kept.empty();
  return {};
}

Judgement Controller::stop() {
  if (machine_.running()) {
    while (retain_.busy()) retain_.step();
    keep_retained(true);  // before outputs go to their safe state
  }
  return {machine_.stop(), 0};
}

Judgement Controller::begin_transfer(const CommandWords& command) {
  storage::Digest digest;
  control::get_bytes(arguments(command).subspan(2, control::kDigestRegisters), digest);
  return transfer_.begin(control::get32(arguments(command), 0), digest, slot_);
}

// Only once nothing can be refused any more what runs is stopped.
Judgement Controller::commit() {
  const Judgement whole = transfer_.complete();
  if (whole.refusal == Refusal::Incomplete) return whole;  // the rest may still come
  const Judgement judgement = whole.refusal == Refusal::Done ? judge(store_.written()) : whole;
  transfer_.abort();
  if (judgement.refusal != Refusal::Done) return judgement;
  static_cast<void>(stop());
  while (retain_.busy()) retain_.step();  // its values stand in memory that the new program gets
  if (!store_.finish(transfer_.digest())) return {Refusal::FlashFailed, 0};
  slot_ = store_.target();
  machine_.load(transfer_.digest());
  retain_restored_ = false;
  inputs_lost_ = false;
  return {};
}

Judgement Controller::bits(control::Command code, const CommandWords& command) {
  using namespace control::bits;
  if (machine_.forces() == nullptr) return {Refusal::NoProgram, 0};
  const std::span<const std::uint16_t> words = arguments(command);
  std::array<std::byte, kDigestBytes> named{};
  control::get_bytes(words.subspan(kDigest, kDigestBytes / 2), named);
  if (!std::equal(named.begin(), named.end(), machine_.digest().begin())) return {Refusal::OtherProgram, 0};
  const image::ImageBits bits{control::get32(words, kByte), control::get64(words, kMask),
                              control::get64(words, kValue)};
  if (code != control::Command::WriteBits) {
    const std::int64_t end_ns = end_of(control::get64(words, kMs), board_.tick.now_ns());
    return {refusal_of(change_forces(machine_, code, bits, end_ns)), 0};
  }
  const Refusal refusal = refusal_of(image::write_bits(machine_.image(), bits));
  touched();
  return {refusal, 0};
}

Judgement Controller::clear_retained() {
  if (machine_.running()) return {Refusal::NotStopped, 0};
  retain_asked_ = false;
  return {retain_.clear() ? Refusal::Done : Refusal::FlashFailed, 0};
}

}  // namespace stepwright::app
