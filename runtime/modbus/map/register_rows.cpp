#include "runtime/modbus/map/register_rows.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "runtime/bytecode/reader/resolve_name.h"

namespace stepwright::modbus::map {
namespace {

using bytecode::kNoBit;
using reader::ProgramInfo;
using reader::Tag;
using reader::Variable;

std::uint32_t size_of(const Variable& variable) {
  return variable.bit != kNoBit ? 1 : bytecode::size_of(bytecode::mem_type(variable.type));
}

// "%QW3" of a place in inputs, outputs or markers; empty elsewhere, and where no such address begins.
std::string direct_address(const ProgramInfo& info, const Variable& variable) {
  const bytecode::SizesRecord& sizes = info.sizes();
  const std::uint32_t outputs = sizes.input_bytes;
  const std::uint32_t markers = outputs + sizes.output_bytes;
  const std::uint32_t size = size_of(variable);
  std::uint32_t byte = variable.address;
  char area = 'I';
  if (byte >= markers + sizes.marker_bytes) return {};
  if (byte >= markers) {
    area = 'M';
    byte -= markers;
  } else if (byte >= outputs) {
    area = 'Q';
    byte -= outputs;
  }
  const std::string begin = std::string("%") + area;
  if (variable.bit != kNoBit) return begin + "X" + std::to_string(byte) + "." + std::to_string(variable.bit);
  if (byte % size != 0) return {};
  return begin + (size == 1 ? 'B' : size == 2 ? 'W' : size == 4 ? 'D' : 'L') + std::to_string(byte / size);
}

std::string enumerators(const Variable& variable) {
  std::string text;
  if (variable.enumerators == nullptr) return text;
  for (const auto& [value, name] : *variable.enumerators)
    text += (text.empty() ? "" : ", ") + std::to_string(value) + " " + name;
  return text;
}

// Which addresses of a segment hold a variable; false: none, or not the whole of it.
bool place(const Segment& segment, Table table, const Variable& variable, RegisterRow& row) {
  if (segment.kind == Kind::Zero || bytecode::is_string(variable.type)) return false;
  const std::uint32_t size = size_of(variable);
  const bool bit = variable.bit != kNoBit;
  if (variable.address < segment.address) return false;
  const std::uint32_t byte = variable.address - segment.address;
  if (segment.kind == Kind::Bits) {
    const std::int64_t first = std::int64_t{byte} * 8 + (bit ? variable.bit : 0) - segment.bit;
    const std::uint32_t bits = bit ? 1 : size * 8;
    if (first < 0 || first + bits > segment.count || (!bit && !holds_bits(table))) return false;
    row.first = segment.first + static_cast<std::uint32_t>(first);
    row.addresses = bits;
    return true;
  }
  const std::uint32_t width = bytes_of(segment.kind);
  const std::uint32_t registers = registers_of(segment.kind);
  const std::uint32_t index = byte / width;
  if ((index + 1) * registers > segment.count) return false;
  row.first = segment.first + index * registers;
  row.addresses = registers;
  if (!bit && size == width && byte % width == 0) return true;
  if (segment.kind == Kind::Word && !bit && size > width && byte % width == 0) {
    // Words that follow each other, the least significant first.
    row.addresses = size / width;
    row.word_order = Order::LowFirst;
    return (index + row.addresses) <= segment.count;
  }
  if (segment.kind != Kind::Word || size != 1) return false;
  const std::uint32_t lowest = byte % width * 8 + (bit ? variable.bit : 0u);
  row.comment = bit ? "bit " + std::to_string(lowest)
                    : "bits " + std::to_string(lowest) + " to " + std::to_string(lowest + 7);
  return true;
}

// The declared variables of one segment, then what of it no variable is declared for is left out.
void add_rows(const ProgramInfo& info, Table table, const Segment& segment, std::vector<RegisterRow>& rows) {
  for (const Tag& tag : info.tags()) {
    RegisterRow row;
    row.word_order = segment.word_order;
    if (!place(segment, table, tag.variable, row)) continue;
    row.table = table;
    row.name = tag.name;
    row.address = direct_address(info, tag.variable);
    row.type = bytecode::name_of(tag.variable.type);
    row.writable = segment.writable;
    row.byte_order = segment.byte_order;
    if (row.comment.empty()) row.comment = enumerators(tag.variable);
    rows.push_back(std::move(row));
  }
}

// A variable has one row in a table: of views of the same bytes the one in which it is whole.
void keep_best(std::vector<RegisterRow>& rows) {
  const auto rank = [](const RegisterRow& row) {
    const bool part = row.comment.starts_with("bit");
    const bool turned = row.addresses > 1 && row.word_order == Order::LowFirst;
    return (part ? 2 : 0) + (turned ? 1 : 0);
  };
  std::map<std::pair<Table, std::string>, int> best;
  for (const RegisterRow& row : rows) {
    const auto [found, added] = best.try_emplace({row.table, row.name}, rank(row));
    if (!added) found->second = std::min(found->second, rank(row));
  }
  std::erase_if(rows, [&](const RegisterRow& row) { return rank(row) > best.at({row.table, row.name}); });
}

}  // namespace

std::vector<RegisterRow> register_rows(const ProgramInfo& info, const RegisterMap& map) {
  std::vector<RegisterRow> rows;
  for (std::size_t i = 0; i < kTables; ++i) {
    const auto table = static_cast<Table>(i);
    for (const Segment& segment : map.segments(table)) add_rows(info, table, segment, rows);
  }
  keep_best(rows);
  std::sort(rows.begin(), rows.end(), [](const RegisterRow& a, const RegisterRow& b) {
    return std::tie(a.table, a.first, a.name) < std::tie(b.table, b.first, b.name);
  });
  return rows;
}

std::string function_codes(Table table, bool writable) {
  switch (table) {
    case Table::Coils:
      return writable ? "1, 5, 15" : "1";
    case Table::DiscreteInputs:
      return "2";
    case Table::HoldingRegisters:
      return writable ? "3, 6, 16, 22, 23" : "3";
    case Table::InputRegisters:
      break;
  }
  return "4";
}

}  // namespace stepwright::modbus::map
