#pragma once

// The table of a plan on a controller whose program was loaded by hand, as `translate --handshake` writes it.
// Pure but for the file.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/remote/hand_loaded.h"

namespace stepwright::gateway {

struct HandPlan {
  std::uint16_t registers = 0;  // of HS_ENABLE
  std::vector<remote::HandAction> actions;
};

// C0566 with the file's name for anything else, and for a file that cannot be read.
[[nodiscard]] result::Result<HandPlan> read_hand_plan(const std::filesystem::path& file);

}  // namespace stepwright::gateway
