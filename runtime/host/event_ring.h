#pragma once

// The events of one program on their way from the scan thread to the service thread: a bounded ring of slots
// that are large enough for the program's image, taken when the program is loaded.
//
// Threads: one producer (scan), one consumer (service), no locks. Invariants: step changes, of which there
// may be any number, leave the last slots free: one for the event of a command, and one for a trap, whose
// reason no other message carries.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/bytecode/trap.h"
#include "runtime/host/fixed_text.h"
#include "runtime/host/limits.h"
#include "runtime/host/runtime_state.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::host {

class PreparedProgram;

// Data of an event beside the image.
struct EventNote {
  std::uint64_t sequence = 0;
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  EventKind kind = EventKind::StepChange;
  bytecode::Trap trap;                            // EventKind::Trap; without a code: see the reason
  FixedText<kMaxReasonBytes> reason;              // EventKind::Stopped, and Trap without a code
  scan::SafeCause cause = scan::SafeCause::Stop;  // of both
  const PreparedProgram* other =
      nullptr;  // EventKind::Changed: the old one; RolledBack: the one that trapped
};

class EventRing {
 public:
  // As many slots as these bytes have room for, within these bounds.
  static constexpr std::size_t kBytes = 8u << 20;
  static constexpr std::size_t kFewestSlots = 6;
  static constexpr std::size_t kMostSlots = 256;

  struct Slot {
    EventNote note;
    std::vector<std::byte> image;
    std::vector<double> plant;
  };

  EventRing(std::size_t image_bytes, std::size_t plant_values);

  // Producer.
  // Brings the memory of the next event near the processor.
  void warm();
  // No room for a step change.
  bool full() const;
  // False if the ring has no room for an event of this kind. Requires the sizes of the constructor.
  bool push(const EventNote& note, std::span<const std::byte> image, std::span<const double> plant);

  // Consumer: the oldest event, valid until `pop`; null if there is none.
  const Slot* front() const;
  void pop();

 private:
  std::size_t room() const;
  std::size_t after(std::size_t index) const { return index + 1 == slots_.size() ? 0 : index + 1; }

  std::vector<Slot> slots_;  // one stays empty
  std::atomic<std::size_t> head_{0};
  std::atomic<std::size_t> tail_{0};
};

}  // namespace stepwright::host
