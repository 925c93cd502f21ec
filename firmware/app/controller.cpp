#include "firmware/app/controller.h"

#include <cstring>

#include "firmware/app/retained_values.h"

namespace stepwright::app {

namespace control = modbus::control;
using control::Refusal;

Controller::Controller(port::Board& board)
    : board_(board),
      clock_(board.tick),
      store_(board.flash),
      retain_(board.flash),
      machine_(board.memory, io_, clock_),
      transfer_(store_) {}

// A container that no longer passes, because the firmware is another one, leaves the older slot its turn.
void Controller::boot() {
  std::uint32_t refused = 0;
  for (int slot = store_.newest(); slot >= 0; slot = store_.newest(refused)) {
    if (judge(store_.container(slot)).refusal == Refusal::Done) {
      machine_.load(store_.digest(slot));
      slot_ = slot;
      return;
    }
    refused |= 1u << slot;
  }
}

Judgement Controller::judge(std::span<const std::byte> container) {
  const Judgement judgement = machine_.judge(container);
  if (judgement.refusal != Refusal::Done) return judgement;
  if (machine_.judged_retain_bytes() > retain_.capacity())
    return {Refusal::NotSupported, static_cast<std::uint32_t>(Lacking::RetainBytes)};
  return {};
}

bool Controller::work() {
  const std::int64_t now_ns = board_.tick.now_ns();
  const bool had_command = command_waits_;
  if (command_waits_ && prepared(waiting_)) {
    // The number appears last, with everything that the command brought about.
    const Judgement result = carry_out(waiting_);
    answer_ = {waiting_.number, result};
    command_waits_ = false;
  }
  machine_.end_forces(now_ns);
  const bool due = machine_.due(now_ns);
  if (due) scan_by_clock(now_ns);
  keep_retained(false);
  return had_command || due || retain_.busy();
}

void Controller::scan_by_clock(std::int64_t now_ns) {
  const bool has_plant = !machine_.inputs().empty() || !machine_.outputs().empty();
  const bool lost = has_plant && now_ns - sign_of_life_ns_ > kSilenceNs;
  io_.set_lost(lost);
  machine_.scan();
  io_.set_lost(false);
  inputs_lost_ = inputs_lost_ || lost;
  if (!machine_.running()) retain_asked_ = true;
}

// Values that did not change are not written: flash wears out.
void Controller::keep_retained(bool now) {
  retain_.step();
  const std::span<std::byte> copy = machine_.retain_copy();
  if (copy.empty() || retain_.busy()) return;
  const std::int64_t now_ns = board_.tick.now_ns();
  const bool periodic = machine_.running() && !machine_.lock_step() && now_ns >= retain_due_ns_;
  if (!now && !retain_asked_ && !periodic) return;
  retain_asked_ = false;
  retain_due_ns_ = now_ns + kRetainPeriodNs;
  copy_retained(machine_.program(), machine_.image(), copy);
  const auto stored = retain_.values_of(machine_.digest());
  if (stored.size() == copy.size() && std::memcmp(stored.data(), copy.data(), copy.size()) == 0) return;
  retain_.write(machine_.digest(), copy);
}

void Controller::exchange(std::uint16_t turn, std::span<const std::byte> inputs) {
  sign_of_life_ns_ = board_.tick.now_ns();
  if (machine_.lock_step() && turn == turn_) return;
  turn_ = turn;
  io_.write(inputs);
  if (!machine_.running()) return machine_.idle();
  if (!machine_.lock_step()) return;
  machine_.scan();
  if (!machine_.running()) retain_asked_ = true;
}

void Controller::touched() {
  machine_.idle();
}

std::uint16_t Controller::flags() const {
  unsigned flags = 0;
  if (machine_.lock_step()) flags |= control::kLockStep;
  if (transfer_.active()) flags |= control::kTransferring;
  if (inputs_lost_) flags |= control::kInputsLost;
  if (board_.watchdog.caused_this_start()) flags |= control::kWatchdogReset;
  if (retain_restored_) flags |= control::kRetainRestored;
  return static_cast<std::uint16_t>(flags);
}

}  // namespace stepwright::app
