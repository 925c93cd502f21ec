#pragma once

// Lock of a cell that is up: the kernel keeps a lock in the cell's state folder for as long as its
// `stepwright up` lives, however that ends.
//
// Threads: any.

#include <optional>

#include "cell/config/cell_config.h"
#include "cell/processes/cell_record.h"
#include "hmi_web/storage/file_lock.h"
#include "runtime/ground/result/result.h"

namespace stepwright::up {

// The right to keep this cell up. M0013, with who has it, if it is up already; M0023 if another cell is, in
// the same state folder; S0001 if that cannot be written.
[[nodiscard]] result::Result<storage::FileLock> take_cell(const config::CellConfig& config);

// What the `stepwright up` of the cell says of it; nothing if it is not up. M0015 if that cannot be read;
// M0023 if it is another cell that is up there.
[[nodiscard]] result::Result<std::optional<processes::CellRecord>> find_cell(
    const config::CellConfig& config);

}  // namespace stepwright::up
