#pragma once

// The folder of a cell's state: socket, locks, retained values, logs. Whoever may write into it decides what
// the cell does; so it belongs to this user, or to root, and is not everybody's to write.
//
//   if (auto made = claim_state_dir(config); !made) return fail(made.error(), ...);
//
// Threads: any.

#include <filesystem>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::config {

struct CellConfig;

// Where the state of a cell is that names no folder: in the temporary folder, below one that is this user's
// alone. The same for all processes of the user, whether he has a session or not.
std::filesystem::path default_state_dir(const std::string& cell);

// Makes it, for this user only, if it is not there; true if it was made. Fails with R0078 and the reason
// where it cannot be made, is no folder, or belongs to somebody else or to everybody. A default folder is no
// link.
[[nodiscard]] result::Result<bool> claim_state_dir(const CellConfig& config);

// For who only looks for a process there, maybe another user: R0078 if everybody may write into the folder,
// or if a default folder is a link or somebody else's. One that is not there is nobody's.
[[nodiscard]] result::Result<void> check_state_dir(const CellConfig& config);

}  // namespace stepwright::config
