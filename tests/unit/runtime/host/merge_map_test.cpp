#include "runtime/host/merge_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/record/state_layout.h"
#include "tests/support/test_program.h"
#include "tests/unit/runtime/host/every_type.h"
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
    frame : STRUCT count AT %B0 : INT; left AT %X2.0 : BOOL; right AT %X2.5 : BOOL; END_STRUCT;
    over : STRUCT OVERLAP low AT %B0 : BYTE; word AT %W0 : WORD; flag AT %X1.1 : BOOL; END_STRUCT;
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
        map(MergeMap::of(loaded.program(), "test").value()),
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

TEST_F(MergeMapTest, WhenTasksChangeBitsOfAStructure_ThenBothChangesStay) {
  std::vector<std::byte> shared = before, after = before;
  const std::uint32_t byte = at("frame.left");
  ASSERT_EQ(byte, at("frame.count") + 2);
  ASSERT_EQ(info.find("frame.right")->bit, 5);
  shared[byte] ^= std::byte{1};
  after[byte] ^= std::byte{1 << 5};
  map.merge(before, after, shared);
  EXPECT_EQ(shared[byte], before[byte] ^ std::byte{0x21});
}

TEST_F(MergeMapTest, WhenMembersShareMemory_ThenTheSmallestAreTheValues) {
  std::vector<std::byte> shared = before, after = before;
  const std::uint32_t low = at("over.low");
  ASSERT_EQ(at("over.word"), low);
  shared[low] ^= std::byte{0x0F};
  after[low] ^= std::byte{0x70};
  shared[low + 1] ^= std::byte{1};
  after[low + 1] ^= std::byte{2};
  map.merge(before, after, shared);
  EXPECT_EQ(shared[low], before[low] ^ std::byte{0x70}) << "a byte, as a whole";
  EXPECT_EQ(shared[low + 1], before[low + 1] ^ std::byte{3}) << "bits";
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
      if (size == 1 || tag.name.starts_with("over.")) continue;
      const auto same = [&](const auto& a, const auto& b) {
        return std::memcmp(a.data() + v.address, b.data() + v.address, size) == 0;
      };
      ASSERT_TRUE(same(shared, same(after, before) ? others : after)) << tag.name;
    }
  }
}

TEST_F(MergeMapTest, WhenAStringIsChanged_ThenItIsTakenAsAWhole) {
  const auto text_at = [&](const std::vector<std::byte>& image) {
    return reader::read_text(*info.find("text"), image);
  };
  const auto write = [&](std::vector<std::byte>& image, const std::string& text) {
    put<std::uint16_t>(image, at("text"), 20);
    put<std::uint16_t>(image, at("text") + 2, static_cast<std::uint16_t>(text.size()));
    std::memcpy(image.data() + at("text") + 4, text.data(), text.size());
  };
  write(before, "AAAAA");
  std::vector<std::byte> shared = before, after = before;
  write(shared, "WORLDS");
  write(after, "HELLA");  // its last character is that of before, and so is its length
  map.merge(before, after, shared);
  EXPECT_EQ(text_at(shared), "HELLA");
}

TEST_F(MergeMapTest, WhenAValueHasOneByte_ThenItsBitsStayTogether) {
  before[at("small")] = std::byte{0x00};
  std::vector<std::byte> shared = before, after = before;
  shared[at("small")] = std::byte{0x0F};
  after[at("small")] = std::byte{0x70};
  map.merge(before, after, shared);
  EXPECT_EQ(shared[at("small")], std::byte{0x70});
}

// Both tasks change bytes anywhere; every value of the merged image is then that of one of them: of the task,
// where it changed it, else of the others. What the values are is said by the layout of the state, which
// expands the types by itself.
void expect_whole_values(const std::vector<std::byte>& container, std::uint32_t seed, int rounds) {
  const auto loaded = reader::LoadedProgram::load(container, "test").value();
  const MergeMap map = MergeMap::of(loaded.program(), "test").value();
  const auto layout = record::StateLayout::of(loaded.program()).value();
  const std::uint32_t first = loaded.program().sizes().input_bytes;
  std::mt19937 random(seed);
  std::vector<std::byte> before(loaded.program().image_size());
  for (std::byte& byte : before) byte = static_cast<std::byte>(random());
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> shared = before, after = before;
    for (std::size_t change = 0; change < before.size() / 4 + 1; ++change) {
      shared[random() % shared.size()] ^= static_cast<std::byte>(random());
      after[random() % after.size()] ^= static_cast<std::byte>(random());
    }
    const std::vector<std::byte> others = shared;
    map.merge(before, after, shared);
    for (const record::StateVariable& variable : layout.variables()) {
      if (variable.address < first || variable.bit != bytecode::kNoBit) continue;
      const std::uint32_t size = layout.type_of(variable).size;
      for (std::uint32_t i = 0; i < variable.count; ++i) {
        const auto part = [&](const std::vector<std::byte>& image) {
          return std::span(image).subspan(variable.address + i * size, size);
        };
        const bool changed = !std::ranges::equal(part(before), part(after));
        ASSERT_TRUE(std::ranges::equal(part(shared), part(changed ? after : others)))
            << variable.path << "[" << i << "]";
      }
    }
  }
}

TEST(MergeMap, WhenAProgramHasEveryTypeAtEveryPosition_ThenEachValueIsOneOfTheTwo) {
  for (int pad = 0; pad < 8; ++pad) {
    SCOPED_TRACE(pad);
    expect_whole_values(compiled(every_type_nested(pad)), static_cast<std::uint32_t>(pad), 20);
  }
}

// Nothing that has a value between two scans is left to be merged by its bits: only what the two inputs with
// R_EDGE sense, which every call computes anew.
TEST(MergeMap, WhenAProgramHasEveryType_ThenTheLayoutNamesEveryByte) {
  const auto loaded = reader::LoadedProgram::load(compiled(every_type_nested(3)), "test").value();
  const auto layout = record::StateLayout::of(loaded.program()).value();
  std::vector<int> named(loaded.program().image_size(), 0);
  for (const record::StateVariable& variable : layout.variables()) {
    for (std::uint32_t i = 0; i < variable.count * layout.type_of(variable).size; ++i)
      ++named[variable.address + i];
  }
  const auto& sizes = loaded.program().sizes();
  const std::size_t data = sizes.input_bytes + sizes.output_bytes + sizes.marker_bytes;
  EXPECT_EQ(std::count(named.begin() + static_cast<std::ptrdiff_t>(data), named.end(), 0), 2);
}

TEST(MergeMap, WhenValuesLieBehindAnyNumberOfOthers_ThenTheyAreWholeToo) {
  expect_whole_values(compiled(R"(
CONFIGURATION c
  VAR_GLOBAL pad : ARRAY[0..250000] OF BYTE; x : DINT; r : REF_TO DINT; w : WSTRING[5]; b : USINT; END_VAR
  TASK t(INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM p WITH t : main;
END_CONFIGURATION
PROGRAM main
VAR_EXTERNAL x : DINT; r : REF_TO DINT; END_VAR
r := REF(x);
END_PROGRAM
)"),
                      1, 3);
}

TEST(MergeMap, WhenAStringIsLongerThanABlock_ThenItIsTakenAsAWhole) {
  const std::vector<std::byte> container = compiled(R"(
PROGRAM main
VAR a : BYTE; long : WSTRING[2000]; list : ARRAY[0..3] OF STRING[300]; z : INT; END_VAR
a := 1;
END_PROGRAM
)");
  expect_whole_values(container, 2, 20);
}

// Programs drive bits of a byte that another variable has as a whole.
TEST(MergeMap, WhenVariablesLieOverEachOther_ThenTheSmallestAreTheValues) {
  const std::vector<std::byte> container = compiled(R"(
CONFIGURATION c
  VAR_GLOBAL word AT %QW0 : WORD; bit AT %QX0.3 : BOOL; double AT %QD1 : DWORD; half AT %QW3 : WORD; END_VAR
  TASK t(INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM p WITH t : main;
END_CONFIGURATION
PROGRAM main
VAR_EXTERNAL bit : BOOL; END_VAR
bit := TRUE;
END_PROGRAM
)");
  const auto loaded = reader::LoadedProgram::load(container, "test").value();
  const MergeMap map = MergeMap::of(loaded.program(), "test").value();
  const std::vector<std::byte> before(loaded.program().image_size());
  std::vector<std::byte> shared = before, after = before;
  after[0] = std::byte{0x08};
  shared[0] = std::byte{0x01};
  after[1] = std::byte{0x11};
  put<std::uint16_t>(shared, 4, 0x2222);  // the first half of `double`
  put<std::uint16_t>(after, 6, 0x3333);
  map.merge(before, after, shared);
  EXPECT_EQ(shared[0], std::byte{0x09});
  EXPECT_EQ(shared[1], std::byte{0x11});
  EXPECT_EQ(get<std::uint32_t>(shared, 4), 0x3333'2222u);
}

// Types that lay parts over each other without end: who cannot know all values refuses the program.
TEST(MergeMap, WhenTheValuesCannotAllBeKnown_ThenTheProgramIsRefused) {
  writer::ContainerModel model = support::one_program(8, [](auto&) {});
  std::uint32_t type = model.add_type(writer::elementary(bytecode::ElementaryType::Bool));
  for (int level = 0; level < 8; ++level) {
    writer::Type many{
        .name = "T" + std::to_string(level), .kind = bytecode::TypeKind::Struct, .size = 1, .members = {}};
    for (int i = 0; i < 10; ++i) many.members.push_back({"m" + std::to_string(i), type, 0});
    type = model.add_type(many);
  }
  model.symbols.push_back({.name = "endless", .type = type, .address = 0, .direct_address = {}});
  const auto loaded = reader::LoadedProgram::load(writer::write_container(model).value(), "test").value();
  const auto map = MergeMap::of(loaded.program(), "test");
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error()[0].code, "R0021");
  EXPECT_EQ(map.error()[0].where.file, "test");
}

}  // namespace
}  // namespace stepwright::host
