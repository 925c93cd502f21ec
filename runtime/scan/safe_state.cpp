#include "runtime/scan/safe_state.h"

#include <cstring>
#include <limits>

namespace stepwright::scan {
namespace {

constexpr double kNsPerSecond = 1e9;

std::size_t index_of(SafeCause cause) {
  return static_cast<std::size_t>(cause);
}

bool fits(const SafeRamp& ramp, std::span<const std::byte> outputs) {
  return ramp.byte <= outputs.size() && size_of(ramp.type) <= outputs.size() - ramp.byte;
}

template <typename T>
T load(std::span<const std::byte> outputs, std::uint32_t byte) {
  T value;
  std::memcpy(&value, outputs.data() + byte, sizeof value);
  return value;
}

template <typename T>
void store(std::span<std::byte> outputs, std::uint32_t byte, double number) {
  T value;
  if constexpr (std::numeric_limits<T>::is_integer) {
    value = static_cast<T>(static_cast<std::int64_t>(number < 0 ? number - 0.5 : number + 0.5));
  } else {
    value = static_cast<T>(number);
  }
  std::memcpy(outputs.data() + byte, &value, sizeof value);
}

double load_number(const SafeRamp& ramp, std::span<const std::byte> outputs) {
  switch (ramp.type) {
    case RampType::U8:
      return load<std::uint8_t>(outputs, ramp.byte);
    case RampType::I8:
      return load<std::int8_t>(outputs, ramp.byte);
    case RampType::U16:
      return load<std::uint16_t>(outputs, ramp.byte);
    case RampType::I16:
      return load<std::int16_t>(outputs, ramp.byte);
    case RampType::U32:
      return load<std::uint32_t>(outputs, ramp.byte);
    case RampType::I32:
      return load<std::int32_t>(outputs, ramp.byte);
    case RampType::F32:
      return static_cast<double>(load<float>(outputs, ramp.byte));
  }
  return ramp.target;
}

void store_number(const SafeRamp& ramp, double number, std::span<std::byte> outputs) {
  switch (ramp.type) {
    case RampType::U8:
      return store<std::uint8_t>(outputs, ramp.byte, number);
    case RampType::I8:
      return store<std::int8_t>(outputs, ramp.byte, number);
    case RampType::U16:
      return store<std::uint16_t>(outputs, ramp.byte, number);
    case RampType::I16:
      return store<std::int16_t>(outputs, ramp.byte, number);
    case RampType::U32:
      return store<std::uint32_t>(outputs, ramp.byte, number);
    case RampType::I32:
      return store<std::int32_t>(outputs, ramp.byte, number);
    case RampType::F32:
      return store<float>(outputs, ramp.byte, number);
  }
}

// Where a ramp begins: a REAL that is no finite number has no way to its target, so that it is there at once.
double start_of(const SafeRamp& ramp, std::span<const std::byte> outputs) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  const double start = load_number(ramp, outputs);
  return start >= -kLargest && start <= kLargest ? start : ramp.target;
}

double position(const SafeRamp& ramp, double start, double seconds) {
  const double way = ramp.per_second * seconds;
  if (start > ramp.target) return start - way > ramp.target ? start - way : ramp.target;
  return start + way < ramp.target ? start + way : ramp.target;
}

}  // namespace

// One look at every rule for each byte: the cause comes once, and the lists are short.
void apply_safe_state(std::span<const SafeOutput> rules, std::span<std::byte> outputs) {
  for (std::size_t byte = 0; byte < outputs.size(); ++byte) {
    const auto before = static_cast<std::uint32_t>(outputs[byte]);
    std::uint32_t safe = 0;
    for (const SafeOutput& rule : rules) {
      if (rule.byte != byte) continue;
      const std::uint32_t source = rule.mode == SafeMode::Hold    ? before
                                   : rule.mode == SafeMode::Value ? rule.value
                                                                  : 0;
      safe = (safe & ~std::uint32_t{rule.mask}) | (source & rule.mask);
    }
    outputs[byte] = static_cast<std::byte>(safe);
  }
}

std::span<const SafeRamp> SafeState::ramps() const {
  const std::span<const SafeRamp> all = matrix_[index_of(cause_)].ramps;
  return all.first(all.size() < kMaxRamps ? all.size() : kMaxRamps);
}

void SafeState::driven(std::span<const std::byte> outputs) {
  const std::size_t size = outputs.size() < memory_.size() ? outputs.size() : memory_.size();
  if (size != 0) std::memmove(memory_.data(), outputs.data(), size);
}

void SafeState::enter(SafeCause cause, std::int64_t time_ns) {
  cause_ = cause;
  since_ns_ = time_ns;
  settled_ = false;
  const std::span<const SafeRamp> ramps = this->ramps();
  for (std::size_t i = 0; i < ramps.size(); ++i) {
    if (fits(ramps[i], memory_)) starts_[i] = start_of(ramps[i], memory_);
  }
  apply_safe_state(matrix_[index_of(cause)].outputs, memory_);
}

double SafeState::position_of(std::size_t ramp, std::int64_t time_ns) const {
  const double seconds = static_cast<double>(time_ns - since_ns_) / kNsPerSecond;
  return position(ramps()[ramp], starts_[ramp], seconds < 0.0 ? 0.0 : seconds);
}

void SafeState::apply(std::int64_t time_ns, std::span<std::byte> outputs) {
  const std::span<const SafeRamp> ramps = this->ramps();
  bool settled = true;
  for (std::size_t i = 0; i < ramps.size(); ++i) {
    if (!fits(ramps[i], memory_)) continue;
    const double number = position_of(i, time_ns);
    settled = settled && number == ramps[i].target;
    store_number(ramps[i], number, memory_);
  }
  settled_ = settled;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    outputs[i] = i < memory_.size() ? memory_[i] : std::byte{0};
}

// A number of which the program has the first bytes only is brought on in the others.
void SafeState::apply_behind(std::size_t first, std::int64_t time_ns) {
  const std::span<const SafeRamp> ramps = this->ramps();
  bool settled = true;
  for (std::size_t i = 0; i < ramps.size(); ++i) {
    const std::size_t size = size_of(ramps[i].type);
    if (!fits(ramps[i], memory_) || ramps[i].byte + size <= first) continue;
    const double number = position_of(i, time_ns);
    settled = settled && number == ramps[i].target;
    SafeRamp alone = ramps[i];
    alone.byte = 0;
    std::array<std::byte, 4> bytes{};
    store_number(alone, number, bytes);
    for (std::size_t at = 0; at < size; ++at)
      if (ramps[i].byte + at >= first) memory_[ramps[i].byte + at] = bytes[at];
  }
  settled_ = settled;
}

void SafeState::go_on(const SafeState& before) {
  driven(before.memory_);
  cause_ = before.cause_;
  since_ns_ = before.since_ns_;
  settled_ = before.settled_;
  starts_ = before.starts_;
}

}  // namespace stepwright::scan
