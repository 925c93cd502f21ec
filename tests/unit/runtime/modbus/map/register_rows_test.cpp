// The map as people read it.

#include "runtime/modbus/map/register_rows.h"

#include "tests/unit/runtime/modbus/map/mapped_program.h"

namespace stepwright::modbus::map {
namespace {

std::vector<std::string> lines(const std::vector<RegisterRow>& rows) {
  std::vector<std::string> out;
  for (const RegisterRow& row : rows) {
    out.push_back(std::string(name_of(row.table)) + " " + std::to_string(row.first) + "+" +
                  std::to_string(row.addresses) + " " + row.name + " " + row.type + " " + row.address +
                  (row.writable ? " rw" : " ro") + (row.word_order == Order::LowFirst ? " low first" : "") +
                  (row.comment.empty() ? "" : " (" + row.comment + ")"));
  }
  return out;
}

using Lines = std::vector<std::string>;

TEST(RegisterRows, WhenTheDefaultMap_ThenTheLocatedVariables) {
  const MappedProgram program(R"(
TYPE Mode : (Off, Auto); END_TYPE
PROGRAM Main
  VAR
    start AT %IX0.3 : BOOL;
    level AT %IW2 : INT;
    pump AT %QX1.2 : BOOL;
    both AT %QD2 : DINT;
    small AT %QB1 : BYTE;
    flag AT %MX1.2 : BOOL;
    part AT %MB3 : BYTE;
    count AT %MW5 : INT;
    mode AT %MW6 : Mode;
    real AT %MD7 : REAL;
    long AT %ML5 : LINT;
    hidden : INT;
  END_VAR
  pump := start;
END_PROGRAM)",
                              {});
  EXPECT_EQ(
      lines(register_rows(program.info, program.built.map)),
      (Lines{"coils 8+8 Main.small BYTE %QB1 ro", "coils 10+1 Main.pump BOOL %QX1.2 ro",
             "coils 64+32 Main.both DINT %QD2 ro", "discrete 3+1 Main.start BOOL %IX0.3 ro",
             "discrete 32+16 Main.level INT %IW2 ro", "holding 0+1 Main.pump BOOL %QX1.2 ro (bit 10)",
             "holding 0+1 Main.small BYTE %QB1 ro (bits 8 to 15)",
             "holding 4+2 Main.both DINT %QD2 ro low first",
             "holding 1024+1 Main.flag BOOL %MX1.2 ro (bit 10)",
             "holding 1025+1 Main.part BYTE %MB3 ro (bits 8 to 15)", "holding 1029+1 Main.count INT %MW5 ro",
             "holding 1030+1 Main.mode INT %MW6 ro (0 Off, 1 Auto)", "holding 2062+2 Main.real REAL %MD7 ro",
             "holding 4116+4 Main.long LINT %ML5 ro", "input 0+1 Main.start BOOL %IX0.3 ro (bit 3)",
             "input 2+1 Main.level INT %IW2 ro"}));
}

TEST(RegisterRows, WhenRanges_ThenEveryValueOfTheirs) {
  MapConfig config;
  config.openplc = false;
  RangeConfig range;
  range.first = 40;
  range.variable = "Main.levels";
  range.writable = true;
  config.ranges.push_back(range);
  const MappedProgram program(
      "PROGRAM Main VAR levels : ARRAY[1..2] OF REAL; other : INT; END_VAR other := 1; END_PROGRAM", config);
  EXPECT_EQ(lines(register_rows(program.info, program.built.map)),
            (Lines{"holding 40+2 Main.levels[1] REAL  rw", "holding 42+2 Main.levels[2] REAL  rw"}));
  EXPECT_EQ(function_codes(Table::HoldingRegisters, true), "3, 6, 16, 22, 23");
}

}  // namespace
}  // namespace stepwright::modbus::map
