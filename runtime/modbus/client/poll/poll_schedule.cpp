#include "runtime/modbus/client/poll/poll_schedule.h"

#include <algorithm>

namespace stepwright::modbus::client {
namespace {

constexpr std::chrono::milliseconds kTick{1};
constexpr int kShareOfTheDead = 3;  // parts of the others' time to one of theirs

}  // namespace

PollSchedule::PollSchedule(const std::vector<Device>& devices, Clock::time_point start, bool serial)
    : serial_(serial) {
  for (const Device& device : devices) units_.emplace_back(device, start, serial);
}

void PollSchedule::connecting() {
  silent_.clear();
  probe_at_ = {};
}

void PollSchedule::begin_anew(Clock::time_point now) {
  for (Unit& unit : units_) {
    unit.begin_anew();
    unit.hope(now);
  }
}

bool PollSchedule::others_awake(std::size_t index) const {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    if (i != index && !units_[i].asleep()) return true;
  }
  return false;
}

// After a silence everybody else who is due comes first, so that units which die together hold up the others
// for one timeout at a time.
bool PollSchedule::others_first(std::size_t index, Clock::time_point now) {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    Unit& other = units_[i];
    if (i == index || other.asleep() || other.doubtful() || other.asked_at() >= silence_at_) continue;
    const GroupPoll* const group = other.next_group();
    const auto write = other.writes().due();
    if ((group != nullptr && group->due <= now) || (write && *write <= now)) return true;
  }
  return false;
}

PollSchedule::Job PollSchedule::next(Clock::time_point now) {
  Job read;
  Job write;
  Job dead;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    Unit& unit = units_[i];
    const bool waits = (unit.doubtful() || unit.asleep()) && others_first(i, now);
    const auto earliest = waits ? std::max(unit.rests_until(), now + kTick) : unit.rests_until();
    const auto when = [&](Clock::time_point due) { return std::max(due, earliest); };
    if (unit.asleep()) {
      const auto at = when(std::max(unit.wakes_at(), probe_at_));
      if (at < dead.at) dead = {Turn::Probe, i, at};
      continue;
    }
    if (const GroupPoll* group = unit.next_group(); group != nullptr && when(group->due) < read.at)
      read = {Turn::Read, i, when(group->due)};
    if (const auto due = unit.writes().due(); due && when(*due) < write.at)
      write = {Turn::Write, i, when(*due)};
  }
  const bool reads = read.at <= now;
  const bool writes = write.at <= now;
  Job job{Turn::Wait, 0, std::min({read.at, write.at, dead.at})};
  if (dead.at <= now) {
    job = dead;
  } else if (reads && (!writes || wrote_last_)) {
    job = read;
  } else if (writes) {
    job = write;
  }
  if (job.turn != Turn::Wait) units_[job.unit].begins(now);
  return job;
}

void PollSchedule::answered(std::size_t index, Clock::time_point now) {
  // If nobody did before, it may have been the line that was dead.
  if (std::ranges::all_of(units_, &Unit::asleep)) {
    for (Unit& unit : units_) unit.hope(now);
  }
  units_[index].answered();
  silent_.clear();
}

PollSchedule::Silence PollSchedule::silent(std::size_t index, Clock::time_point sent, Clock::time_point now) {
  Unit& unit = units_[index];
  const bool was_asleep = unit.asleep();
  const bool awake = others_awake(index);
  silence_at_ = now;
  Silence silence{.dead = unit.silent(now, awake)};
  if (silence.dead && awake) probe_at_ = now + kShareOfTheDead * (now - sent);
  if (silence.dead && !awake) {  // nobody is left whom a try would delay
    for (Unit& each : units_) each.hope(now + each.device().retry_after);
  }
  // A unit that is known to be dead says nothing about the connection, as long as others speak.
  if (serial_ || (was_asleep && awake)) return silence;
  if (std::ranges::find(silent_, index) == silent_.end()) silent_.push_back(index);
  silence.of_connection = silent_.size() >= 2 || !awake;
  return silence;
}

}  // namespace stepwright::modbus::client
