#pragma once

// A sheet as blocks that flow over pages. Internal to this folder; not thread-safe.

#include <vector>

#include "ladder/graphic/sheet.h"
#include "ladder/print/flow.h"
#include "ladder/print/page.h"
#include "ladder/print/table.h"

namespace stepwright::print {

// The sheet must outlive the blocks.
std::vector<Block> blocks_of(const graphic::Sheet& sheet, const PageFormat& format);

// A heading with a table below it; nothing for an empty table.
void append_table(std::vector<Block>& blocks, const std::string& heading, const Table& table,
                  const PageFormat& format);

}  // namespace stepwright::print
