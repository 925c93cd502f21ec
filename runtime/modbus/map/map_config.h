#pragma once

// Settings of the register map, which address of the tables is which variable, as a user says it. Plain data;
// any thread.

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/modbus/map/table.h"

namespace stepwright::modbus::map {

enum class Order : std::uint8_t { HighFirst, LowFirst };

// Values that follow each other, at addresses that follow each other.
struct RangeConfig {
  Table table = Table::HoldingRegisters;
  std::uint32_t first = 0;  // 0 to 65535
  std::uint32_t count = 0;  // of values, not of registers; 0: the one that is named, or the whole array
  std::string variable;     // "%MW0", "MAIN.level", "MAIN.levels[3]" (and on), "MAIN.levels"
  bool writable = false;    // by clients whose window allows it; tables that clients can write only
  Order byte_order = Order::HighFirst;  // within a register; the standard's is HighFirst
  Order word_order = Order::HighFirst;  // of values wider than a register
  result::Location where;    // of the range; what is wrong with a key is said at the key, where it is known:
  result::Location at_name;  // variable or address
  result::Location at_first;
  result::Location at_count;
  result::Location at_writable;
};

struct MapConfig {
  bool openplc = true;            // the default map, without what `ranges` takes of its addresses
  bool openplc_writable = false;  // its coils and holding registers
  std::vector<RangeConfig> ranges;
};

}  // namespace stepwright::modbus::map
