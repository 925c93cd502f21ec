#pragma once

// A container on its way into the free slot, piece by piece (runtime/doc/modbus_controller.md, Download).
// Called by the main loop only. No heap: the pieces go to the flash as they come.

#include <cstdint>
#include <span>

#include "firmware/app/machine.h"
#include "firmware/storage/program_store.h"
#include "runtime/modbus/pdu/exception.h"

namespace stepwright::app {

class Transfer {
 public:
  explicit Transfer(storage::ProgramStore& store) : store_(store) {}

  // A new transfer; one that was under way is gone. `in_use` is the slot that must not be touched.
  Judgement begin(std::uint32_t bytes, const storage::Digest& digest, int in_use);

  // The next piece. One that arrived before is ignored; one that leaves a gap, leads beyond the end or
  // belongs to no transfer is IllegalDataValue; DeviceFailure if the flash failed.
  modbus::pdu::Exception piece(std::uint32_t offset, std::span<const std::byte> bytes);

  // Takes the digest of another kilobyte of what stands in the flash; true when nothing is left to be taken,
  // because it is done or not all bytes are here.
  bool digest_step();
  // Whether all bytes are here and their digest is the announced one. Requires digest_step() until it is
  // true.
  Judgement complete();

  void abort() { active_ = false; }
  bool active() const { return active_; }
  std::uint32_t arrived() const { return active_ ? arrived_ : 0; }
  const storage::Digest& digest() const { return digest_; }

 private:
  storage::ProgramStore& store_;
  bool active_ = false;
  std::uint32_t bytes_ = 0;
  std::uint32_t arrived_ = 0;
  storage::Digest digest_{};  // as it was announced
  storage::Sha256 sum_;       // of the first summed_ bytes
  std::uint32_t summed_ = 0;
};

}  // namespace stepwright::app
