#include "ladder/print/table.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/sfc_layout.h"
#include "ladder/graphic/text_wrap.h"

namespace stepwright::print {

namespace {

constexpr std::size_t kBetween = 2;
constexpr std::size_t kNarrowest = 6;

std::string section_of(const graphic::Variable& variable) {
  constexpr const char* words[] = {"VAR",        "VAR_TEMP",     "VAR_INPUT", "VAR_OUTPUT",
                                   "VAR_IN_OUT", "VAR_EXTERNAL", "VAR_GLOBAL"};
  std::string text = words[static_cast<std::size_t>(variable.section)];
  if (variable.constant) text += " CONSTANT";
  if (variable.retain) text += " RETAIN";
  return text;
}

void remove_empty_columns(Table& table) {
  for (std::size_t column = table.heads.size(); column-- > 0;) {
    const bool used = std::any_of(table.rows.begin(), table.rows.end(),
                                  [column](const auto& row) { return !row[column].empty(); });
    if (used) continue;
    table.heads.erase(table.heads.begin() + static_cast<std::ptrdiff_t>(column));
    for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
  }
}

void append(std::vector<std::string>& to, const std::string& sheet, const std::vector<std::string>& places) {
  if (!places.empty()) to.push_back(sheet + ": " + joined(places));
}

}  // namespace

std::vector<std::size_t> column_widths(const Table& table, std::size_t total) {
  std::vector<std::size_t> widths;
  for (std::size_t column = 0; column < table.heads.size(); ++column) {
    std::size_t width = graphic::length_of(table.heads[column]);
    for (const auto& row : table.rows) width = std::max(width, graphic::length_of(row[column]));
    widths.push_back(width);
  }
  const auto sum = [&widths] {
    return std::accumulate(widths.begin(), widths.end(), std::size_t{0}) + kBetween * (widths.size() - 1);
  };
  while (!widths.empty() && sum() > total) {
    const auto widest = std::max_element(widths.begin(), widths.end());
    if (*widest <= kNarrowest) break;
    --*widest;
  }
  return widths;
}

Cells cells_of(const std::vector<std::string>& row, const std::vector<std::size_t>& widths) {
  Cells cells;
  for (std::size_t i = 0; i < row.size(); ++i)
    cells.push_back(graphic::wrap_words(row[i], std::max<std::size_t>(widths[i], 1)));
  return cells;
}

std::size_t lines_of(const Cells& cells) {
  std::size_t lines = 1;
  for (const auto& each : cells) lines = std::max(lines, each.size());
  return lines;
}

Table declaration_table(const graphic::Sheet& sheet) {
  Table table{{"Section", "Name", "Type", "Address", "Initial", "Comment"}, {}};
  for (const graphic::Variable& each : sheet.variables)
    table.rows.push_back({section_of(each), each.name, each.type, each.address, each.initial, each.comment});
  remove_empty_columns(table);
  return table;
}

Table cross_reference_table(const std::vector<VariableUses>& uses) {
  Table table{{"Variable", "Type", "Address", "Written", "Read"}, {}};
  for (const VariableUses& each : uses)
    table.rows.push_back({each.name, each.type, each.address, joined(each.written), joined(each.read)});
  remove_empty_columns(table);
  return table;
}

Table global_reference_table(const std::vector<graphic::Sheet>& sheets) {
  struct Shared {
    VariableUses uses;
    bool shared = false;
  };
  std::map<std::string, Shared> variables;
  for (const graphic::Sheet& sheet : sheets) {
    for (const graphic::Variable& each : sheet.variables) {
      if (each.section != graphic::VariableSection::Global &&
          each.section != graphic::VariableSection::External)
        continue;
      VariableUses& uses = variables[graphic::upper(each.name)].uses;
      uses.name = each.name;
      uses.type = each.type;
      if (!each.address.empty()) uses.address = each.address;
    }
  }
  if (variables.empty()) return {};
  for (const graphic::Sheet& sheet : sheets) {
    for (const VariableUses& each : cross_reference(sheet)) {
      const auto found = variables.find(graphic::upper(each.name));
      if (found == variables.end()) continue;
      append(found->second.uses.written, sheet.name, each.written);
      append(found->second.uses.read, sheet.name, each.read);
      found->second.shared = true;
    }
  }
  std::vector<VariableUses> used;
  for (auto& [key, each] : variables)
    if (each.shared) used.push_back(std::move(each.uses));
  return cross_reference_table(used);
}

}  // namespace stepwright::print
