#include "runtime/record/retain_store.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "runtime/ground/files/durable_file.h"
#include "tests/unit/runtime/record/retained_machine.h"

namespace stepwright::record {
namespace {

using Bytes = std::vector<std::byte>;

// Two values that belong together.
StateLayout pair_layout() {
  std::vector<StateType> types(1);
  types[0].elementary = bytecode::ElementaryType::Lint;
  types[0].size = 8;
  StateVariable first;
  first.path = "MAIN.first";
  StateVariable second;
  second.path = "MAIN.second";
  second.address = 8;
  return {types, {first, second}, 16};
}

Bytes pair_of(std::int64_t value) {
  Bytes payload(16);
  std::memcpy(payload.data(), &value, 8);
  std::memcpy(payload.data() + 8, &value, 8);
  return payload;
}

Bytes content(const std::filesystem::path& path) {
  return files::read_bytes(path, 1u << 20, {"R0024"}).value().value();
}

void put(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// A store that was made with 1 and into which 2 was written, and then 3.
class Written : public testing::Test {
 protected:
  Written() {
    auto store = RetainStore::create(folder.store(), pair_layout(), pair_of(1), 7);
    EXPECT_TRUE(store);
    EXPECT_TRUE(store->write(pair_of(2)));
    before = content(folder.store());
    EXPECT_TRUE(store->write(pair_of(3)));
    after = content(folder.store());
  }

  // What is read is the value of one write, whole, or refused with a place: R0023.
  enum class Read { Old, New, Refused };
  Read read(const Bytes& bytes) {
    put(folder.store(), bytes);
    auto found = RetainStore::read(folder.store());
    if (!found) {
      EXPECT_EQ(found.error()[0].code, "R0023");
      EXPECT_EQ(found.error()[0].where.file, folder.store().string());
      EXPECT_FALSE(found.error()[0].message.empty());
      return Read::Refused;
    }
    EXPECT_TRUE(*found);
    EXPECT_EQ((*found)->layout, pair_layout());
    if ((*found)->payload == pair_of(3)) return Read::New;
    EXPECT_EQ((*found)->payload, pair_of(2));
    return Read::Old;
  }

  TestFolder folder{true};
  Bytes before;
  Bytes after;
};
using RetainStoreWritten = Written;

TEST(RetainStore, WhenThereIsNoFile_ThenThereAreNoValues) {
  const TestFolder folder;
  const auto found = RetainStore::read(folder.store());
  ASSERT_TRUE(found);
  EXPECT_FALSE(*found);
}

TEST_F(RetainStoreWritten, WhenWhole_ThenTheNewestValuesAreRead) {
  EXPECT_EQ(read(before), Read::Old);
  EXPECT_EQ(read(after), Read::New);
}

// A write that ends at any byte: the values before it, until all of it is there.
TEST_F(RetainStoreWritten, WhenAWriteIsTorn_ThenTheValuesBeforeItHold) {
  ASSERT_EQ(before.size(), after.size());
  std::size_t last = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] != after[i]) last = i;
  }
  Bytes torn = before;
  for (std::size_t i = 0; i <= last; ++i) {
    torn[i] = after[i];
    ASSERT_EQ(read(torn), i == last ? Read::New : Read::Old) << i;
  }
}

// The blocks of a write reach the disk in any order.
TEST_F(RetainStoreWritten, WhenAWriteIsTornFromBehind_ThenTheValuesBeforeItHold) {
  std::size_t first = after.size();
  for (std::size_t i = after.size(); i-- > 0;) {
    if (before[i] != after[i]) first = i;
  }
  Bytes torn = before;
  for (std::size_t i = after.size(); i-- > first;) {
    torn[i] = after[i];
    ASSERT_EQ(read(torn), i == first ? Read::New : Read::Old) << i;
  }
}

TEST_F(RetainStoreWritten, WhenItIsCutAnywhere_ThenWhatIsReadIsWholeOrRefused) {
  std::size_t refused = 0;
  std::size_t old = 0;
  for (std::size_t size = 0; size < after.size(); ++size) {
    const Read found = read(Bytes(after.begin(), after.begin() + static_cast<std::ptrdiff_t>(size)));
    refused += found == Read::Refused ? 1u : 0u;
    old += found == Read::Old ? 1u : 0u;
  }
  EXPECT_GT(refused, 4096u);  // without names and a slot there is nothing
  EXPECT_GT(refused + old, 4096u);
}

TEST_F(RetainStoreWritten, WhenAnyByteIsWrong_ThenWhatIsReadIsWholeOrRefused) {
  std::array<std::size_t, 3> seen{};
  for (std::size_t at = 0; at < after.size(); ++at) {
    for (const int flip : {0xFF, 1 << (at % 8)}) {
      Bytes bytes = after;
      bytes[at] ^= static_cast<std::byte>(flip);
      ++seen[static_cast<std::size_t>(read(bytes))];
    }
  }
  for (const std::size_t each : seen) EXPECT_GT(each, 0u);
}

TEST_F(RetainStoreWritten, WhenOneCopyIsDamaged_ThenTheOtherIsReadAndTheDamageIsSaid) {
  Bytes bytes = after;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] != after[i]) bytes[i] ^= std::byte{1};
  }
  EXPECT_EQ(read(bytes), Read::Old);
  EXPECT_NE(RetainStore::read(folder.store()).value()->damage.find("damaged"), std::string::npos);
}

TEST_F(RetainStoreWritten, WhenItGoesOnAfterTheDamage_ThenTheDamagedCopyIsWritten) {
  Bytes bytes = after;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] != after[i]) bytes[i] ^= std::byte{1};
  }
  put(folder.store(), bytes);
  auto store = RetainStore::resume(folder.store(), *RetainStore::read(folder.store()).value());
  ASSERT_TRUE(store);
  ASSERT_TRUE(store->write(pair_of(4)));
  const auto found = RetainStore::read(folder.store()).value();
  EXPECT_EQ(found->payload, pair_of(4));
  EXPECT_EQ(found->damage, "");
}

TEST_F(RetainStoreWritten, WhenItIsForeignOrOfAnotherVersion_ThenItIsRefusedWithItsPlace) {
  put(folder.store(), Bytes(20'000, std::byte{'x'}));
  auto found = RetainStore::read(folder.store());
  ASSERT_FALSE(found);
  EXPECT_NE(found.error()[0].message.find("byte 0"), std::string::npos);
  Bytes bytes = after;
  bytes[8] = std::byte{9};
  put(folder.store(), bytes);
  found = RetainStore::read(folder.store());
  ASSERT_FALSE(found);
  EXPECT_NE(found.error()[0].message.find("version 9"), std::string::npos);
  std::filesystem::remove(folder.store());
  std::filesystem::create_directory(folder.store());
  found = RetainStore::read(folder.store());
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error()[0].code, "R0024");
}

TEST_F(RetainStoreWritten, WhenItsHeaderIsDamaged_ThenItIsStillAStore) {
  Bytes bytes = after;
  bytes[0] = std::byte{'x'};
  put(folder.store(), bytes);
  EXPECT_TRUE(RetainStore::check_place(folder.store()));
  put(folder.store(), Bytes(after.size(), std::byte{'x'}));
  const auto refused = RetainStore::check_place(folder.store());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "R0024");
  EXPECT_NE(refused.error()[0].hint.find("[retain] file"), std::string::npos);
  EXPECT_FALSE(RetainStore::check_place("/dev/null"));
  EXPECT_FALSE(RetainStore::set_aside("/dev/null"));
}

// A BOOL, two numbers of 0..10, a number of 1..18446744073709551615 and a STRING[3].
StateLayout typed_layout() {
  std::vector<StateType> types(4);
  types[1] = {.kind = bytecode::TypeKind::Subrange,
              .elementary = bytecode::ElementaryType::Int,
              .size = 2,
              .lower = 0,
              .upper = 10,
              .text = {}};
  types[2] = {.kind = bytecode::TypeKind::Subrange,
              .elementary = bytecode::ElementaryType::Ulint,
              .size = 8,
              .lower = 1,
              .upper = -1,
              .text = {}};
  types[3] = {.kind = bytecode::TypeKind::String,
              .elementary = bytecode::ElementaryType::String,
              .size = static_cast<std::uint32_t>(bytecode::string_bytes(bytecode::ElementaryType::String, 3)),
              .capacity = 3,
              .text = {}};
  return {types,
          {{.path = "MAIN.on", .type = 0, .address = 0},
           {.path = "MAIN.few", .type = 1, .address = 2, .count = 2, .lower = 5, .is_array = true},
           {.path = "MAIN.many", .type = 2, .address = 8},
           {.path = "MAIN.name", .type = 3, .address = 16}},
          16 + types[3].size};
}

template <typename Value>
void put_value(Bytes& payload, std::size_t at, Value value) {
  std::memcpy(payload.data() + at, &value, sizeof value);
}

Bytes typed_values() {
  Bytes payload(typed_layout().size());
  put_value(payload, 0, std::uint8_t{1});
  put_value(payload, 2, std::int16_t{10});
  put_value(payload, 8, std::uint64_t{1} << 63);
  put_value(payload, 16, std::uint16_t{3});
  put_value(payload, 18, std::uint16_t{3});
  return payload;
}

// What a store with a right checksum of these values is refused for; empty: it is taken.
std::string refused_for(const Bytes& payload) {
  const TestFolder folder;
  if (!RetainStore::create(folder.store(), typed_layout(), payload, 7)) return "there is no store";
  const auto found = RetainStore::read(folder.store());
  if (found) return {};
  EXPECT_EQ(found.error()[0].code, "R0023");
  return found.error()[0].message;
}

TEST(RetainStore, WhenAValueIsNoneOfItsType_ThenItIsRefusedByName) {
  const Bytes good = typed_values();
  EXPECT_EQ(refused_for(good), "");
  const auto with = [&](std::size_t at, auto value) {
    Bytes bad = good;
    put_value(bad, at, value);
    const std::string why = refused_for(bad);
    return why.substr(std::min(why.size(), why.find("; ")));
  };
  EXPECT_EQ(with(0, std::uint8_t{2}), "; MAIN.on: it is neither TRUE nor FALSE");
  EXPECT_EQ(with(2, std::int16_t{11}), "; MAIN.few[5]: 11 is outside of 0..10");
  EXPECT_EQ(with(4, std::int16_t{-1}), "; MAIN.few[6]: -1 is outside of 0..10");
  EXPECT_EQ(with(8, std::uint64_t{0}), "; MAIN.many: 0 is outside of 1..18446744073709551615");
  EXPECT_EQ(with(16, std::uint16_t{4}), "; MAIN.name: 3 of 4 characters, in a string of 3");
  EXPECT_EQ(with(18, std::uint16_t{4}), "; MAIN.name: 4 of 3 characters, in a string of 3");
}

TEST(RetainStore, WhenOnlyTheNewestCopyHasAWrongValue_ThenTheOtherIsUsedAndItIsSaid) {
  const TestFolder folder;
  auto store = RetainStore::create(folder.store(), typed_layout(), typed_values(), 7);
  ASSERT_TRUE(store);
  Bytes wrong = typed_values();
  put_value(wrong, 2, std::int16_t{30});
  ASSERT_TRUE(store->write(wrong));
  const auto found = RetainStore::read(folder.store());
  ASSERT_TRUE(found && *found);
  EXPECT_EQ((*found)->payload, typed_values());
  EXPECT_NE((*found)->damage.find("MAIN.few[5]: 30 is outside of 0..10"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::record
