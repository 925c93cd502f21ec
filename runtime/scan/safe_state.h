#pragma once

// Safe state of the outputs, for the time when nobody may drive them: a matrix of cause and output. A cause
// has a list of rules: off, as it was, a fixed value, or a ramp, which brings a number to its target at a
// rate per second of the scan's clock and leaves it there.
//
// Thread rule: one thread. No heap: rules and memory belong to the caller and outlive the state.
// Invariants: bits without a rule are zero; what the program writes after the cause came is not driven; for
// equal times and equal outputs at the cause the outputs are the same, however often they are asked for.
// The memory is that of all outputs there are. A program may have fewer: then `driven` leaves those behind
// its own in their safe state, and `apply_behind` brings their ramps on while it runs.
//
//   scan::SafeState safe(matrix, memory);        // as many bytes of memory as there are outputs
//   safe.driven(outputs);                        // after every scan of a program that runs
//   safe.enter(scan::SafeCause::Trap, now_ns);   // the program may not drive them any more
//   safe.apply(now_ns, outputs);                 // every scan, until a program starts again

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::scan {

// Why nobody drives the outputs. The numbers are part of the shared-memory I/O: append, never renumber.
enum class SafeCause : std::uint8_t {
  Stop = 0,            // by command, or because another program was loaded
  Trap = 1,            // a program fault
  Watchdog = 2,        // a task took too long, or its program never came to an end
  IoLost = 3,          // the device does not answer
  SupervisorLost = 4,  // the supervisor was lost and the configuration asks for the safe state
  Killed = 5,          // the runtime is gone; the guard drives
};
inline constexpr std::size_t kSafeCauses = 6;

enum class SafeMode : std::uint8_t {
  Zero,   // off
  Hold,   // as they were
  Value,  // a fixed value
};

// The rule for some bits of one output byte. Bits without a rule go to zero; of several rules for a bit the
// last one holds.
struct SafeOutput {
  std::uint32_t byte = 0;    // of the output area; rules for bytes outside it have no effect
  std::uint8_t mask = 0xFF;  // the bits it is about
  SafeMode mode = SafeMode::Zero;
  std::uint8_t value = 0;  // SafeMode::Value
};

// The number that lies in an output, little-endian.
enum class RampType : std::uint8_t { U8, I8, U16, I16, U32, I32, F32 };

constexpr std::uint32_t size_of(RampType type) {
  return type <= RampType::I8 ? 1 : type <= RampType::I16 ? 2 : 4;
}

// The rule for a number that goes to its target slowly. It wins over the rules for its bits.
struct SafeRamp {
  std::uint32_t byte = 0;  // of the output area; a ramp that leads out of it has no effect
  RampType type = RampType::I16;
  double target = 0.0;      // within the type's range
  double per_second = 1.0;  // above zero
};
inline constexpr std::size_t kMaxRamps = 64;  // of one cause; more have no effect

struct SafeRules {
  std::span<const SafeOutput> outputs;
  std::span<const SafeRamp> ramps;
};
// By cause.
using SafeMatrix = std::array<SafeRules, kSafeCauses>;

// Puts the output area into the safe state that the rules for bits ask for.
void apply_safe_state(std::span<const SafeOutput> rules, std::span<std::byte> outputs);

class SafeState {
 public:
  // Nobody else writes the memory.
  SafeState(const SafeMatrix& matrix, std::span<std::byte> memory) : matrix_(matrix), memory_(memory) {}

  // These outputs are driven now: what Hold keeps, and where ramps begin. What is larger than the memory is
  // left out.
  void driven(std::span<const std::byte> outputs);

  // The cause came at `time_ns`; the time of a clock that `apply` is asked with, too.
  void enter(SafeCause cause, std::int64_t time_ns);

  // The outputs as they are to be at `time_ns`; not before that of `enter`. Outputs beyond the memory become
  // zero.
  void apply(std::int64_t time_ns, std::span<std::byte> outputs);

  // The same for the outputs from byte `first` on, in the memory; those before it stay as they are.
  void apply_behind(std::size_t first, std::int64_t time_ns);

  // The outputs behind `first` go on as those of `before`, which another program has left: with its cause and
  // its ramps. Requires an equal matrix.
  void go_on(const SafeState& before);

  SafeCause cause() const { return cause_; }
  // Every ramp has come to its target: nothing changes any more.
  bool settled() const { return settled_; }
  // The outputs that were driven last, or are to be.
  std::span<const std::byte> outputs() const { return memory_; }

 private:
  std::span<const SafeRamp> ramps() const;
  double position_of(std::size_t ramp, std::int64_t time_ns) const;

  SafeMatrix matrix_;
  std::span<std::byte> memory_;
  SafeCause cause_ = SafeCause::Stop;
  std::int64_t since_ns_ = 0;
  bool settled_ = true;
  std::array<double, kMaxRamps> starts_{};  // of the cause's ramps
};

}  // namespace stepwright::scan
