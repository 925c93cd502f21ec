// Maps of one's own: ranges of variables and addresses.

#include "runtime/modbus/map/resolve_range.h"
#include "tests/unit/runtime/modbus/map/mapped_program.h"

namespace stepwright::modbus::map {
namespace {

using Words = std::vector<std::uint16_t>;
using Codes = std::vector<std::string>;

constexpr const char* kProgram = R"(
TYPE Mode : (Off, Manual, Auto); END_TYPE
PROGRAM Main
  VAR CONSTANT
    limit : INT := 7;
  END_VAR
  VAR
    run : BOOL;
    flags : ARRAY[0..11] OF BOOL;
    small : SINT;
    byte_value : BYTE;
    levels : ARRAY[1..4] OF REAL;
    grid : ARRAY[0..1, 0..2] OF INT;
    total : LREAL;
    word_value : WORD;
    text : STRING;
    mode : Mode;
    lamp AT %QX0.6 : BOOL;
    wish AT %IW0 : INT;
    marker AT %MW3 : INT;
  END_VAR
  run := TRUE;
END_PROGRAM)";

RangeConfig range(Table table, std::uint32_t first, const std::string& variable, std::uint32_t count = 0) {
  RangeConfig config;
  config.table = table;
  config.first = first;
  config.count = count;
  config.variable = variable;
  config.writable = may_be_written(table);
  config.where = {"cell.toml", 12, 3};
  return config;
}

MapConfig only(std::vector<RangeConfig> ranges) {
  MapConfig config;
  config.openplc = false;
  config.ranges = std::move(ranges);
  return config;
}

constexpr Table kHolding = Table::HoldingRegisters;

TEST(Ranges, WhenAnArrayOfReals_ThenTwoRegistersEach) {
  MappedProgram program(kProgram, only({range(kHolding, 100, "Main.levels")}));
  program.set<float>("Main.levels[4]", -2.0f);
  EXPECT_EQ(program.registers(kHolding, 100, 8), (Words{0, 0, 0, 0, 0, 0, 0xC000, 0}));
  program.registers(kHolding, 100, 9);
  EXPECT_EQ(program.exception, Exception::IllegalDataAddress);
  program.registers(kHolding, 99, 2);
  EXPECT_EQ(program.exception, Exception::IllegalDataAddress);
  EXPECT_EQ(program.write(102, {0x3F80, 0x0000}), Exception::None);
  EXPECT_FLOAT_EQ(program.get<float>("Main.levels[2]"), 1.0f);
}

TEST(Ranges, WhenFromAnElementOn_ThenThoseThatFollow) {
  MappedProgram program(kProgram, only({range(kHolding, 0, "main.GRID[0][2]", 3)}));
  EXPECT_EQ(program.codes(), Codes{});
  program.set<std::int16_t>("Main.grid[0, 2]", 11);
  program.set<std::int16_t>("Main.grid[1, 0]", 12);
  program.set<std::int16_t>("Main.grid[1, 1]", 13);
  EXPECT_EQ(program.registers(kHolding, 0, 3), (Words{11, 12, 13}));
}

TEST(Ranges, WhenOrdersAreTurned_ThenBytesAndWordsAre) {
  auto little = range(kHolding, 0, "Main.total");
  little.word_order = Order::LowFirst;
  auto both = range(kHolding, 10, "Main.total");
  both.word_order = Order::LowFirst;
  both.byte_order = Order::LowFirst;
  MappedProgram program(kProgram, only({little, both}));
  program.set<double>("Main.total", 1.0);
  EXPECT_EQ(program.registers(kHolding, 0, 4), (Words{0, 0, 0, 0x3FF0}));
  EXPECT_EQ(program.registers(kHolding, 10, 4), (Words{0, 0, 0, 0xF03F}));
  EXPECT_EQ(program.write(10, {0, 0, 0, 0x0040}), Exception::None);
  EXPECT_EQ(program.get<double>("Main.total"), 2.0);
  EXPECT_EQ(program.mask(13, 0xFFFF, 0), Exception::None);
  EXPECT_EQ(program.get<double>("Main.total"), 2.0);
}

TEST(Ranges, WhenBoolsOfAByteEach_ThenEveryOneIsABit) {
  MappedProgram program(kProgram, only({range(Table::Coils, 5, "Main.flags"),
                                        range(kHolding, 0, "Main.flags"), range(kHolding, 20, "Main.lamp")}));
  EXPECT_EQ(program.write_bits(6, "10000000001"), Exception::None);
  EXPECT_EQ(program.bits(Table::Coils, 5, 12), "010000000001");
  EXPECT_EQ(program.get<std::uint8_t>("Main.flags[11]"), 1);
  EXPECT_EQ(program.registers(kHolding, 0, 3), (Words{0, 1, 0}));
  EXPECT_EQ(program.write(2, {0x300}), Exception::None);
  EXPECT_EQ(program.get<std::uint8_t>("Main.flags[2]"), 1);
  EXPECT_EQ(program.mask(2, 0xFFFE, 0), Exception::None);
  EXPECT_EQ(program.get<std::uint8_t>("Main.flags[2]"), 0);
  EXPECT_EQ(program.write(20, {1}), Exception::None);
  EXPECT_EQ(program.registers(kHolding, 20, 1), Words{1});
  EXPECT_EQ(program.get<std::uint8_t>("%QB0"), 0x40);
}

TEST(Ranges, WhenBytes_ThenTheyAreWidenedAndMustFit) {
  MappedProgram program(kProgram,
                        only({range(kHolding, 0, "Main.small"), range(kHolding, 1, "Main.byte_value")}));
  program.set<std::int8_t>("Main.small", -1);
  program.set<std::uint8_t>("Main.byte_value", 0xFF);
  EXPECT_EQ(program.registers(kHolding, 0, 2), (Words{0xFFFF, 0x00FF}));
  EXPECT_EQ(program.write(0, {0xFF80, 0}), Exception::None);
  EXPECT_EQ(program.get<std::int8_t>("Main.small"), -128);
  EXPECT_EQ(program.write(0, {0x0080}), Exception::IllegalDataValue);
  EXPECT_EQ(program.write(1, {0x0100}), Exception::IllegalDataValue);
  EXPECT_EQ(program.write(1, {0x00FE}), Exception::None);
  EXPECT_EQ(program.mask(1, 0xFFF0, 0x0005), Exception::None);
  EXPECT_EQ(program.get<std::uint8_t>("Main.byte_value"), 0xF5);
}

TEST(Ranges, WhenWordsAsBits_ThenTheirBits) {
  MappedProgram program(kProgram, only({range(Table::Coils, 0, "Main.word_value"),
                                        range(Table::DiscreteInputs, 3, "%IX0.5", 4)}));
  program.set<std::uint16_t>("Main.word_value", 0x8001);
  EXPECT_EQ(program.bits(Table::Coils, 0, 16), "1000000000000001");
  program.set("%IX1.0", true);
  EXPECT_EQ(program.bits(Table::DiscreteInputs, 3, 4), "0001");
}

TEST(Ranges, WhenTheyTakeAddressesOfTheDefaultMap_ThenTheRestOfItStays) {
  MapConfig config;
  config.ranges = {range(kHolding, 2049, "Main.grid[0][0]", 2), range(Table::Coils, 3, "Main.run")};
  MappedProgram program(kProgram, config);
  program.set<std::int16_t>("Main.grid[0, 0]", 9);
  program.set<std::int16_t>("Main.marker", 0x0102);
  EXPECT_EQ(program.registers(kHolding, 2049, 2), (Words{9, 0}));
  program.registers(kHolding, 2048, 1);  // half of %MD0
  EXPECT_EQ(program.exception, Exception::IllegalDataAddress);
  program.registers(kHolding, 2051, 1);  // half of %MD1
  EXPECT_EQ(program.exception, Exception::IllegalDataAddress);
  EXPECT_EQ(program.registers(kHolding, 1027, 1), (Words{0x0102}));
  program.set<std::uint8_t>("Main.run", 1);
  program.set("%QX0.4", true);
  EXPECT_EQ(program.bits(Table::Coils, 0, 8), "00011000");
}

TEST(Ranges, WhenSomethingIsWrong_ThenItHasAPlaceAndTheRestIsServed) {
  auto constant = range(kHolding, 0, "Main.limit");
  auto beyond = range(kHolding, 65'535, "Main.total");
  auto input = range(kHolding, 10, "Main.wish");
  auto discrete = range(Table::DiscreteInputs, 0, "Main.run");
  discrete.writable = true;
  MappedProgram program(
      kProgram, only({range(kHolding, 5, "Main.levles"), range(kHolding, 5, "Main.text"), constant, beyond,
                      input, discrete, range(kHolding, 20, "Main.levels", 5), range(kHolding, 20, "%MW3", 9),
                      range(kHolding, 30, "Main.grid"), range(kHolding, 35, "Main.mode")}));
  EXPECT_EQ(program.codes(),
            (Codes{"C0501", "C0505", "C0504", "C0502", "C0504", "C0504", "C0502", "C0502", "C0503"}));
  for (const auto& problem : program.built.problems) {
    EXPECT_EQ(problem.where.file, "cell.toml");
    EXPECT_EQ(problem.where.line, 12u);
  }
  EXPECT_NE(program.built.problems.front().hint.find("Main.levels"), std::string::npos);
  EXPECT_EQ(program.registers(kHolding, 30, 6).size(), 6u);
}

TEST(Ranges, WhenTheImageIsShorterThanTheProgram_ThenDeviceFailure) {
  MappedProgram program(kProgram, only({range(kHolding, 0, "Main.levels")}));
  program.image.resize(4);
  program.registers(kHolding, 0, 8);
  EXPECT_EQ(program.exception, Exception::DeviceFailure);
}

}  // namespace
}  // namespace stepwright::modbus::map
