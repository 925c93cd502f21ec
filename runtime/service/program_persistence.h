#pragma once

// Interface of what keeps the loaded program for the next start. A download is answered when the program is
// kept, or with a warning that says why it is not.
//
// Threads: the service's. Nothing here waits for a disk.

#include <cstddef>
#include <optional>
#include <span>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::service {

class ProgramPersistence {
 public:
  virtual ~ProgramPersistence() = default;

  // Another program has been loaded. The container is copied.
  virtual void keep(std::span<const std::byte> container) = 0;
  // Of the newest program: nothing while it is being written; empty when it is kept; else why it is not, as
  // warnings. What failed is tried again, and may be kept later.
  virtual std::optional<result::Diagnostics> outcome() = 0;
  // Readable when there is another outcome; `outcome` clears it. Negative: there is nothing to wait for.
  virtual int descriptor() const = 0;
};

}  // namespace stepwright::service
