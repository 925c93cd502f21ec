#include "runtime/modbus/client/poll/read_plan.h"

#include <gtest/gtest.h>

#include <random>

namespace stepwright::modbus::client {
namespace {

Tag at(Table table, std::uint16_t first, WireType wire = WireType::Uint16) {
  Tag tag;
  tag.table = table;
  tag.first = first;
  tag.wire = wire;
  return tag;
}
Tag holding(std::uint16_t first, WireType wire = WireType::Uint16) {
  return at(Table::HoldingRegisters, first, wire);
}

TEST(ReadPlan, WhenTagsAreNearEachOther_ThenOneRequestReadsThem) {
  const std::vector<Tag> tags = {holding(30), holding(10, WireType::Real), holding(20)};
  const auto requests = plan_reads(tags, {.max_gap = 9});
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_EQ(requests[0].first, 10);
  EXPECT_EQ(requests[0].count, 21);
  EXPECT_EQ(requests[0].tags, (std::vector<std::uint32_t>{1, 2, 0}));
}

TEST(ReadPlan, WhenTheGapIsLargerThanAllowed_ThenThereAreTwo) {
  const std::vector<Tag> tags = {holding(10), holding(20)};
  EXPECT_EQ(plan_reads(tags, {.max_gap = 8}).size(), 2u);
  EXPECT_EQ(plan_reads(tags, {.max_gap = 9}).size(), 1u);
  const std::vector<Tag> bits = {at(Table::Coils, 0), at(Table::Coils, 17)};
  EXPECT_EQ(plan_reads(bits, {.max_gap = 0}).size(), 2u);
  EXPECT_EQ(plan_reads(bits, {.max_gap = 1}).size(), 1u);
}

TEST(ReadPlan, WhenTheTableIsAnother_ThenTheRequestIsToo) {
  const std::vector<Tag> tags = {holding(0), at(Table::InputRegisters, 1), at(Table::Coils, 2),
                                 at(Table::DiscreteInputs, 3)};
  EXPECT_EQ(plan_reads(tags, {}).size(), 4u);
}

TEST(ReadPlan, WhenARequestWouldBeTooLong_ThenNoNumberIsDivided) {
  std::vector<Tag> tags;
  for (std::uint16_t i = 0; i < 100; ++i)
    tags.push_back(holding(static_cast<std::uint16_t>(2 * i), WireType::Real));
  const auto requests = plan_reads(tags, {});
  ASSERT_EQ(requests.size(), 2u);
  EXPECT_EQ(requests[0].count, 124);  // 62 numbers, not 62.5
  EXPECT_EQ(requests[1].first, 124);
}

// Every tag in one request, whole; no request beyond its limits; the last address reached.
TEST(ReadPlan, WhenTagsAreRandom_ThenEachIsReadOnceAndTheLimitsHold) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<Tag> tags = {holding(65'532, WireType::Lreal)};
    for (int i = 0; i < 60; ++i) {
      tags.push_back(at(static_cast<Table>(random() % 4), static_cast<std::uint16_t>(random() % 600),
                        static_cast<WireType>(random() % 9)));
    }
    const ReadLimits limits{static_cast<std::uint16_t>(random() % 20),
                            static_cast<std::uint16_t>(4 + random() % 122),
                            static_cast<std::uint16_t>(1 + random() % 2'000)};
    std::vector<int> seen(tags.size());
    for (const ReadRequest& request : plan_reads(tags, limits)) {
      ASSERT_LE(request.count, is_bits(request.table) ? limits.max_bits : limits.max_registers);
      for (const std::uint32_t index : request.tags) {
        ++seen[index];
        ASSERT_EQ(tags[index].table, request.table);
        ASSERT_GE(tags[index].first, request.first);
        ASSERT_LE(tags[index].end(), std::uint32_t{request.first} + request.count);
      }
    }
    ASSERT_EQ(seen, std::vector<int>(tags.size(), 1));
  }
}

TEST(ReadPlan, WhenARequestIsHalved_ThenBothHalvesHoldTheTags) {
  const std::vector<Tag> tags = {holding(0), holding(5, WireType::Real), holding(8)};
  const auto whole = plan_reads(tags, {});
  ASSERT_EQ(whole.size(), 1u);
  const auto halves = halves_of(whole[0], tags);
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_EQ(halves[0].count, 1);
  EXPECT_EQ(halves[1].first, 5);
  EXPECT_EQ(halves[1].count, 4);
  EXPECT_TRUE(halves_of(halves[0], tags).empty());
}

}  // namespace
}  // namespace stepwright::modbus::client
