#include "runtime/bytecode/opcode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/bytecode/trap.h"

namespace stepwright::bytecode {
namespace {

std::string format_document() {
  std::ifstream file(STEPWRIGHT_SOURCE_DIR "/runtime/doc/bytecode_format.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

const char* operand_text(Operands operands) {
  switch (operands) {
    case Operands::None:
      return "";
    case Operands::U8:
      return "u8";
    case Operands::U32:
      return "u32";
    case Operands::I32:
      return "i32";
    case Operands::ByteBit:
      return "u32 u8";
    case Operands::FunctionAddress:
      return "u32 u32";
    case Operands::Range:
      return "i32 i32 u32";
    case Operands::Bounds:
      return "i32 i32";
    case Operands::Constants:
    case Operands::TwoU32:
      return "u32 u32";
  }
  return "?";
}

// The document is the format: a changed number, operand or effect must be changed there too.
TEST(Opcode, Document_WhenReadBesideTheList_ThenHasEveryOpcodeWithItsNumberAndEffect) {
  const std::string document = format_document();
  for (std::uint32_t number = 0; number < kOpcodeCount; ++number) {
    const OpcodeInfo& opcode = kOpcodes[number];
    char row[160];
    std::snprintf(row, sizeof(row), "| 0x%02X | %s | %s | %s | %s |", number, opcode.name,
                  operand_text(opcode.operands), opcode.pops, opcode.pushes);
    EXPECT_NE(document.find(row), std::string::npos) << "missing: " << row;
  }
}

TEST(Opcode, Document_WhenReadBesideTheSecondLevelLists_ThenHasEveryOperation) {
  const std::string document = format_document();
  const auto expect_rows = [&](std::span<const OperationInfo> operations) {
    for (std::size_t number = 0; number < operations.size(); ++number) {
      const OperationInfo& each = operations[number];
      const std::string row =
          "| " + std::to_string(number) + " | " + each.name + " | " + each.pops + " | " + each.pushes + " |";
      EXPECT_NE(document.find(row), std::string::npos) << "missing: " << row;
    }
  };
  expect_rows(kIntrinsics);
  expect_rows(kStringOps);
}

TEST(Opcode, Document_WhenReadBesideTheTraps_ThenNamesEachWithItsNumber) {
  const std::string document = format_document();
  for (std::uint8_t code = 1; code < kTrapCodeCount; ++code) {
    const std::string row = "| " + std::to_string(code) + " | " + name_of(static_cast<TrapCode>(code)) + " |";
    EXPECT_NE(document.find(row), std::string::npos) << "missing: " << row;
  }
}

TEST(Opcode, LoadAndStore_WhenComposedFromTypeAndMode_ThenAreTheNamedOpcodes) {
  EXPECT_STREQ(info(load_opcode(MemType::Bool, AddressMode::Abs)).name, "LoadBoolAbs");
  EXPECT_STREQ(info(load_opcode(MemType::U16, AddressMode::This)).name, "LoadU16This");
  EXPECT_STREQ(info(store_opcode(MemType::F64, AddressMode::Ind)).name, "StoreF64Ind");
  EXPECT_STREQ(info(store_opcode(MemType::Ref, AddressMode::Abs)).name, "StoreRefAbs");
}

TEST(Opcode, ElementaryTypes_WhenAskedForMemory_ThenHaveTheSizesOfTheStandard) {
  EXPECT_EQ(size_of(mem_type(ElementaryType::Bool)), 1u);
  EXPECT_EQ(size_of(mem_type(ElementaryType::Uint)), 2u);
  EXPECT_EQ(size_of(mem_type(ElementaryType::Real)), 4u);
  EXPECT_EQ(size_of(mem_type(ElementaryType::Time)), 8u);
  EXPECT_EQ(mem_type(ElementaryType::Dword), MemType::I32);
  EXPECT_TRUE(is_unsigned(ElementaryType::Usint));
  EXPECT_TRUE(is_unsigned(ElementaryType::Lword));
  EXPECT_FALSE(is_unsigned(ElementaryType::Lint));
  EXPECT_STREQ(name_of(ElementaryType::Lreal), "LREAL");
}

}  // namespace
}  // namespace stepwright::bytecode
