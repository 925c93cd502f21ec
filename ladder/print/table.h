#pragma once

// Tables of a print: rows of texts that are wrapped in their columns. Internal to this folder; pure
// functions.

#include <cstddef>
#include <string>
#include <vector>

#include "ladder/graphic/sheet.h"
#include "ladder/print/cross_reference.h"

namespace stepwright::print {

struct Table {
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;  // each as long as `heads`
};

// Characters of each column such that all of them, with two between, take `total` at most: what is widest
// gives way first.
std::vector<std::size_t> column_widths(const Table& table, std::size_t total);

// A row as lines: per column its lines.
using Cells = std::vector<std::vector<std::string>>;
Cells cells_of(const std::vector<std::string>& row, const std::vector<std::size_t>& widths);
std::size_t lines_of(const Cells& cells);

// Declarations; columns that no variable needs are left out.
Table declaration_table(const graphic::Sheet& sheet);
Table cross_reference_table(const std::vector<VariableUses>& uses);
// Variables that several sheets share (VAR_GLOBAL, VAR_EXTERNAL), with the sheets where they are used.
Table global_reference_table(const std::vector<graphic::Sheet>& sheets);

}  // namespace stepwright::print
