#include <gtest/gtest.h>

#include "firmware/storage/program_store.h"
#include "firmware/storage/retain_store.h"
#include "tests/support/board/test_board.h"

namespace stepwright::test {
namespace {

using support::TestFlash;

using Bytes = std::vector<std::byte>;

Bytes filled(std::size_t size, int seed) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::byte>(i * 7 + static_cast<std::size_t>(seed));
  return bytes;
}

bool store(storage::ProgramStore& programs, const Bytes& program) {
  const int in_use = programs.newest();
  return programs.begin(in_use) && programs.append(std::span(program).first(program.size() / 2)) &&
         programs.append(std::span(program).subspan(program.size() / 2)) &&
         programs.finish(storage::sha256(program));
}

Bytes newest(const storage::ProgramStore& programs) {
  const int slot = programs.newest();
  if (slot < 0) return {};
  const auto container = programs.container(slot);
  return {container.begin(), container.end()};
}

TEST(RamFlash, Program_WhenABitWouldRise_ThenFails) {
  Bytes memory(8192);
  boards::RamFlash flash(memory);
  ASSERT_TRUE(flash.erase(4096));
  EXPECT_EQ(memory[4096], std::byte{0xFF});
  EXPECT_TRUE(flash.program(4096, Bytes{std::byte{0x0F}}));
  EXPECT_TRUE(flash.program(4096, Bytes{std::byte{0x05}}));
  EXPECT_FALSE(flash.program(4096, Bytes{std::byte{0x06}}));
  EXPECT_FALSE(flash.erase(100)) << "no beginning of a page";
}

class FlashTest : public testing::Test {
 protected:
  Bytes memory = Bytes(16 * 4096 * 2);
  TestFlash flash{memory};
};

TEST_F(FlashTest, Store_WhenFlashIsNew_ThenIsEmpty) {
  storage::ProgramStore programs(flash);
  EXPECT_EQ(programs.newest(), -1);
}

TEST_F(FlashTest, Store_WhenProgramsFollowEachOther_ThenTheNewestHoldsAndTheOneBeforeStays) {
  storage::ProgramStore programs(flash);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(store(programs, filled(9'000, i))) << i;
  EXPECT_EQ(newest(programs), filled(9'000, 4));
  const int slot = programs.newest();
  const int older = programs.newest(1u << slot);
  ASSERT_GE(older, 0);
  EXPECT_EQ(programs.container(older)[0], filled(9'000, 3)[0]);
}

// Where the power may go while two pages are erased, `data` bytes and the header programmed: every byte of
// the header, some of the rest.
std::vector<std::size_t> cuts(std::size_t data) {
  constexpr std::size_t kErased = 2 * 4096;
  std::vector<std::size_t> all;
  const std::size_t header = kErased + data;
  for (std::size_t left = 0; left <= header + 60; left += left + 20 < header ? 97 : 1) all.push_back(left);
  return all;
}

// The power goes while the third program is written.
TEST_F(FlashTest, Store_WhenPowerGoesAtAnyByte_ThenOneWholeProgramIsThere) {
  storage::ProgramStore programs(flash);
  ASSERT_TRUE(store(programs, filled(5'000, 1)));
  ASSERT_TRUE(store(programs, filled(5'000, 2)));
  const Bytes before = memory;
  std::size_t whole_new = 0;
  for (const std::size_t left : cuts(5'000)) {
    memory = before;
    TestFlash dying(memory);
    storage::ProgramStore store_at_work(dying);
    dying.bytes_left = left;
    static_cast<void>(store(store_at_work, filled(5'000, 3)));
    storage::ProgramStore after(flash);
    const Bytes found = newest(after);
    ASSERT_TRUE(found == filled(5'000, 2) || found == filled(5'000, 3)) << left;
    whole_new += found == filled(5'000, 3) ? 1 : 0;
  }
  EXPECT_GT(whole_new, 0u) << "the cut never came behind the header";
}

TEST_F(FlashTest, Store_WhenAStoredBitFlips_ThenTheOlderProgramHolds) {
  storage::ProgramStore programs(flash);
  ASSERT_TRUE(store(programs, filled(5'000, 1)));
  ASSERT_TRUE(store(programs, filled(5'000, 2)));
  const auto container = programs.container(programs.newest());
  memory[static_cast<std::size_t>(container.data() - memory.data()) + 1234] ^= std::byte{0x10};
  EXPECT_EQ(newest(programs), filled(5'000, 1));
}

TEST_F(FlashTest, Retain_WhenPowerGoesAtAnyByte_ThenValuesAreOldOrNew) {
  const storage::Digest program = storage::sha256(filled(3, 3));
  const auto write = [&](port::Flash& where, const Bytes& values) {
    storage::RetainStore retain(where);
    retain.write(program, values);
    while (retain.busy()) retain.step();
  };
  write(flash, filled(4'500, 1));
  write(flash, filled(4'500, 2));
  const Bytes before = memory;
  for (const std::size_t left : cuts(4'500)) {
    memory = before;
    TestFlash dying(memory);
    dying.bytes_left = left;
    write(dying, filled(4'500, 3));
    const auto found = storage::RetainStore(flash).values_of(program);
    ASSERT_EQ(found.size(), 4'500u) << left;
    ASSERT_TRUE(found[0] == filled(1, 2)[0] || found[0] == filled(1, 3)[0]) << left;
  }
  EXPECT_EQ(storage::RetainStore(flash).values_of(program)[0], filled(1, 3)[0]);
}

TEST_F(FlashTest, Retain_WhenProgramIsAnother_ThenHasNoValues) {
  storage::RetainStore retain(flash);
  const Bytes values = filled(10, 1);
  retain.write(storage::sha256(filled(3, 3)), values);
  while (retain.busy()) retain.step();
  EXPECT_EQ(retain.values_of(storage::sha256(filled(3, 3))).size(), 10u);
  EXPECT_TRUE(retain.values_of(storage::sha256(filled(3, 4))).empty());
  EXPECT_TRUE(retain.clear());
  EXPECT_TRUE(retain.values_of(storage::sha256(filled(3, 3))).empty());
}

}  // namespace
}  // namespace stepwright::test
