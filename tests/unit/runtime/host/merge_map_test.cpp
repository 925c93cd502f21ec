#include "runtime/host/merge_map.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/scan/scan_cycle.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

constexpr const char* kSource = R"(
CONFIGURATION c
  VAR_GLOBAL
    bit_a AT %QX0.0 : BOOL; bit_b AT %QX0.1 : BOOL;
    word_a AT %QW1 : WORD; input AT %IW0 : WORD;
    flag : BOOL; small : SINT; whole : INT; large : DINT; real : LREAL; span : TIME;
    list : ARRAY[0..299] OF DINT; text : STRING[20];
  END_VAR
  TASK t(INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM p WITH t : main;
END_CONFIGURATION
PROGRAM main
VAR_EXTERNAL large : DINT; END_VAR
large := large;
END_PROGRAM
)";

class MergeMapTest : public testing::Test {
 protected:
  MergeMapTest()
      : container(compiled(kSource)),
        loaded(*reader::LoadedProgram::load(container, "test")),
        info(*reader::ProgramInfo::read(container)),
        map(info, scan::layout_of(loaded.program())),
        before(loaded.program().image_size()) {
    for (std::byte& byte : before) byte = static_cast<std::byte>(random() & 0x7F);
  }
  std::uint32_t at(const char* name) const { return info.find(name)->address; }

  std::mt19937 random{7};
  std::vector<std::byte> container;
  reader::LoadedProgram loaded;
  reader::ProgramInfo info;
  MergeMap map;
  std::vector<std::byte> before;
};

template <typename T>
void put(std::vector<std::byte>& image, std::uint32_t address, T value) {
  std::memcpy(image.data() + address, &value, sizeof value);
}
template <typename T>
T get(const std::vector<std::byte>& image, std::uint32_t address) {
  T value;
  std::memcpy(&value, image.data() + address, sizeof value);
  return value;
}

TEST_F(MergeMapTest, WhenTwoTasksChangeOneValue_ThenTheLastOneWinsAsAWhole) {
  put<std::int32_t>(before, at("large"), 0x00'00'00'FF);
  std::vector<std::byte> shared = before, after = before;
  put<std::int32_t>(shared, at("large"), 0x00'00'01'00);  // by another task, meanwhile
  put<std::int32_t>(after, at("large"), 0x00'00'00'FE);
  map.merge(before, after, shared);
  EXPECT_EQ(get<std::int32_t>(shared, at("large")), 0xFE);
}

TEST_F(MergeMapTest, WhenTasksChangeBitsOfOneByte_ThenBothChangesStay) {
  std::vector<std::byte> shared = before, after = before;
  const std::uint32_t byte = at("bit_a");
  shared[byte] ^= std::byte{1};
  after[byte] ^= std::byte{2};
  map.merge(before, after, shared);
  EXPECT_EQ(shared[byte], before[byte] ^ std::byte{3});
}

TEST_F(MergeMapTest, WhenATaskLeavesAValueAlone_ThenWhatOthersWroteStays) {
  std::vector<std::byte> shared = before, after = before;
  for (std::byte& byte : shared) byte ^= std::byte{0x55};
  const std::vector<std::byte> others = shared;
  map.merge(before, after, shared);
  EXPECT_EQ(shared, others);
}

TEST_F(MergeMapTest, WhenATaskChangesItsCopyOfTheInputs_ThenTheDriversStay) {
  std::vector<std::byte> shared = before, after = before;
  after[at("input")] ^= std::byte{0xFF};
  map.merge(before, after, shared);
  EXPECT_EQ(shared, before);
}

// Every value of the merged image is one of: the task's, where the task changed it; else the shared one.
TEST_F(MergeMapTest, WhenBothChangeAnything_ThenEveryValueIsOneOfTheTwo) {
  for (int round = 0; round < 300; ++round) {
    std::vector<std::byte> shared = before, after = before;
    for (int change = 0; change < 40; ++change) {
      shared[random() % shared.size()] ^= static_cast<std::byte>(random());
      after[random() % after.size()] ^= static_cast<std::byte>(random());
    }
    const std::vector<std::byte> others = shared;
    map.merge(before, after, shared);
    for (const reader::Tag& tag : info.tags()) {
      const reader::Variable& v = tag.variable;
      if (v.bit != bytecode::kNoBit || bytecode::is_string(v.type) || tag.name == "input") continue;
      const std::size_t size = bytecode::size_of(bytecode::mem_type(v.type));
      if (size == 1) continue;
      const auto same = [&](const auto& a, const auto& b) {
        return std::memcmp(a.data() + v.address, b.data() + v.address, size) == 0;
      };
      ASSERT_TRUE(same(shared, same(after, before) ? others : after)) << tag.name;
    }
  }
}

}  // namespace
}  // namespace stepwright::host
