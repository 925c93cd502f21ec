// The default map, address by address as OpenPLC has it.

#include "runtime/modbus/map/openplc_map.h"

#include "tests/unit/runtime/modbus/map/mapped_program.h"

namespace stepwright::modbus::map {
namespace {

using Words = std::vector<std::uint16_t>;

constexpr const char* kProgram = R"(
PROGRAM Main
  VAR
    start AT %IX0.3 : BOOL;
    level AT %IW2 : INT;
    pump AT %QX1.2 : BOOL;
    speed AT %QW3 : INT;
    count AT %MW5 : INT;
    big AT %MD6 : DINT;
    real AT %MD7 : REAL;
    long AT %ML5 : LINT;
  END_VAR
  pump := start;
END_PROGRAM)";

MapConfig writable() {
  MapConfig config;
  config.openplc_writable = true;
  return config;
}

TEST(OpenplcMap, WhenBits_ThenAddressIsEightTimesTheByte) {
  MappedProgram program(kProgram, {});
  program.set("%QX1.2", true);
  program.set("%IX0.3", true);
  EXPECT_EQ(program.bits(Table::Coils, 8, 8), "00100000");
  EXPECT_EQ(program.bits(Table::Coils, 10, 1), "1");
  EXPECT_EQ(program.bits(Table::DiscreteInputs, 0, 6), "000100");
}

TEST(OpenplcMap, WhenWords_ThenTheyAreThoseOfTheAreas) {
  MappedProgram program(kProgram, {});
  program.set<std::int16_t>("Main.level", -2);
  program.set<std::int16_t>("Main.speed", 0x1234);
  program.set<std::int16_t>("Main.count", 0x5678);
  EXPECT_EQ(program.registers(Table::InputRegisters, 1, 2), (Words{0, 0xFFFE}));
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 3, 1), (Words{0x1234}));
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 1024 + 5, 1), (Words{0x5678}));
}

TEST(OpenplcMap, WhenWideValues_ThenTheMostSignificantWordComesFirst) {
  MappedProgram program(kProgram, {});
  program.set<std::int32_t>("Main.big", 0x11223344);
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 2048 + 12, 2), (Words{0x1122, 0x3344}));
  program.set<float>("Main.real", 1.0f);
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 2048 + 14, 2), (Words{0x3F80, 0}));
  program.set<std::int64_t>("Main.long", 0x1122334455667788);
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 4096 + 20, 4),
            (Words{0x1122, 0x3344, 0x5566, 0x7788}));
  // the middle of a value, and over the border of two
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 4096 + 21, 2), (Words{0x3344, 0x5566}));
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 2048 + 13, 2), (Words{0x3344, 0x3F80}));
}

TEST(OpenplcMap, WhenTheProgramDoesNotHaveIt_ThenZeroAndNoWrites) {
  MappedProgram program(kProgram, writable());
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 1000, 30).size(), 30u);
  EXPECT_EQ(program.registers(Table::HoldingRegisters, 8191, 1), (Words{0}));
  EXPECT_EQ(program.bits(Table::Coils, 8191, 1), "0");
  EXPECT_EQ(program.registers(Table::InputRegisters, 1023, 1), (Words{0}));
  EXPECT_EQ(program.write(8191, {1}), Exception::IllegalDataAddress);
  EXPECT_EQ(program.write_bits(8191, "1"), Exception::IllegalDataAddress);
}

TEST(OpenplcMap, WhenBeyondIt_ThenException2) {
  MappedProgram program(kProgram, {});
  for (const auto& [table, end] :
       {std::pair{Table::HoldingRegisters, 8192}, std::pair{Table::InputRegisters, 1024}}) {
    program.registers(table, static_cast<std::uint16_t>(end - 1), 2);
    EXPECT_EQ(program.exception, Exception::IllegalDataAddress);
    program.registers(table, static_cast<std::uint16_t>(end), 1);
    EXPECT_EQ(program.exception, Exception::IllegalDataAddress);
  }
  for (const Table table : {Table::Coils, Table::DiscreteInputs}) {
    program.bits(table, 8191, 2);
    EXPECT_EQ(program.exception, Exception::IllegalDataAddress);
  }
}

TEST(OpenplcMap, WhenWritten_ThenTheValueIsThatOfTheVariable) {
  MappedProgram program(kProgram, writable());
  EXPECT_EQ(program.write(1024 + 5, {0x8001}), Exception::None);
  EXPECT_EQ(program.get<std::int16_t>("Main.count"), static_cast<std::int16_t>(0x8001));
  EXPECT_EQ(program.write(2048 + 12, {0x1122, 0x3344, 0x4049, 0x0FDB}), Exception::None);
  EXPECT_EQ(program.get<std::int32_t>("Main.big"), 0x11223344);
  EXPECT_FLOAT_EQ(program.get<float>("Main.real"), 3.14159274f);
  EXPECT_LE(program.parts_of_last_write, 3u) << "parts hold eight bytes";
  EXPECT_EQ(program.write(2048 + 13, {0x5566}), Exception::None);
  EXPECT_EQ(program.get<std::int32_t>("Main.big"), 0x11225566);
  EXPECT_EQ(program.write_bits(9, "101"), Exception::None);
  EXPECT_EQ(program.bits(Table::Coils, 8, 8), "01010000");
  EXPECT_EQ(program.mask(1024 + 5, 0xFF00, 0x00AB), Exception::None);
  EXPECT_EQ(program.get<std::uint16_t>("Main.count"), 0x80AB);
}

TEST(OpenplcMap, WhenNotWritable_ThenException2AndNothingChanges) {
  MappedProgram program(kProgram, {});
  const auto before = program.image;
  EXPECT_EQ(program.write(1024 + 5, {1}), Exception::IllegalDataAddress);
  EXPECT_EQ(program.write_bits(9, "1"), Exception::IllegalDataAddress);
  EXPECT_EQ(program.mask(1024 + 5, 0, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(program.image, before);
}

TEST(OpenplcMap, WhenEveryAddressIsWrittenAndRead_ThenItIsTheSame) {
  MappedProgram program(kProgram, writable());
  for (const Segment& segment : program.built.map.segments(Table::HoldingRegisters)) {
    if (segment.kind == Kind::Zero) continue;
    for (std::uint32_t at = segment.first; at < segment.end(); ++at) {
      const auto address = static_cast<std::uint16_t>(at);
      const auto value = static_cast<std::uint16_t>(at * 40'503u);
      ASSERT_EQ(program.write(address, {value}), Exception::None) << at;
      ASSERT_EQ(program.registers(Table::HoldingRegisters, address, 1), Words{value}) << at;
    }
  }
}

}  // namespace
}  // namespace stepwright::modbus::map
