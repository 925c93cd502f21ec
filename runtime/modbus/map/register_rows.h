#pragma once

// The map as a person reads it: a row for every value that a client can reach by a name.
// Pure; any thread.

#include <string>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/modbus/map/register_map.h"

namespace stepwright::modbus::map {

struct RegisterRow {
  Table table = Table::HoldingRegisters;
  std::uint32_t first = 0;
  std::uint32_t addresses = 1;
  std::string name;     // "MAIN.level", or the direct address where no variable is declared
  std::string address;  // "%MW3"; empty: it has none
  std::string type;     // "INT"; the bits of a register: "BOOL"
  bool writable = false;
  Order byte_order = Order::HighFirst;
  Order word_order = Order::HighFirst;
  std::string comment;  // "bit 3 of the register", "0 Off, 1 Auto"
};

// By table, then address, then name. Of the default map: located variables. Of ranges: every value of theirs.
std::vector<RegisterRow> register_rows(const reader::ProgramInfo& info, const RegisterMap& map);

// The function codes that reach it: "1, 5, 15".
std::string function_codes(Table table, bool writable);

}  // namespace stepwright::modbus::map
