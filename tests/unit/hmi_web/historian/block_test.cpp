#include "hmi_web/historian/block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "runtime/base/crc32c.h"

namespace stepwright::historian {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Sample> made(std::size_t count, const std::function<Sample(std::size_t)>& sample) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < count; ++i) samples.push_back(sample(i));
  return samples;
}

double bytes_per_sample(const std::vector<Sample>& samples) {
  return static_cast<double>(encode_block(samples).size()) / static_cast<double>(samples.size());
}

void expect_lossless(const std::vector<Sample>& samples) {
  std::vector<Sample> back;
  ASSERT_TRUE(decode_block(encode_block(samples), back));
  ASSERT_EQ(back.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_TRUE(back[i] == samples[i]) << i;
}

Sample at(std::size_t second, double value) {
  return {static_cast<std::int64_t>(second) * kSecond, value};
}

TEST(Block, WhenEncodedAndDecoded_ThenEveryBitIsTheSame) {
  std::mt19937_64 random(1);
  expect_lossless({at(5, 1.0)});
  expect_lossless(made(512, [](std::size_t i) { return at(i, static_cast<double>(i % 7)); }));
  expect_lossless(made(512, [](std::size_t i) {
    return at(i, std::round(std::sin(0.01 * static_cast<double>(i)) * 1e3) / 1e2);
  }));
  expect_lossless(made(512, [](std::size_t i) { return at(i, std::sin(0.01 * static_cast<double>(i))); }));
  expect_lossless(made(512, [](std::size_t i) { return at(i, 0.0123 * static_cast<double>(i * i % 100)); }));
  expect_lossless(made(
      512, [](std::size_t i) { return at(i, static_cast<float>(std::cos(0.1 * static_cast<double>(i)))); }));
  expect_lossless(made(512, [](std::size_t i) { return at(i, i % 2 == 0 ? 9007199254740991.0 : -4.0); }));
  expect_lossless(
      made(kMostInBlock, [&](std::size_t i) { return at(i, static_cast<double>(random() % 9)); }));
  for (int round = 0; round < 200; ++round) {
    std::int64_t time = static_cast<std::int64_t>(random());
    expect_lossless(made(1 + random() % 100, [&](std::size_t) {
      const auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() -
                                                   std::max<std::int64_t>(time, 0));
      time += static_cast<std::int64_t>(std::min(most, random() >> (random() % 64)));
      return Sample{time, std::bit_cast<double>(random()), static_cast<Quality>(random() % kQualities)};
    }));
  }
}

TEST(Block, WhenValuesAreNoNumbers_ThenTheyAreKept) {
  expect_lossless({at(0, 0.0), at(1, -0.0), at(2, kNan), at(3, -kNan), at(4, kInfinity), at(5, -kInfinity),
                   at(6, std::numeric_limits<double>::denorm_min()), at(6, 1e308)});
}

TEST(Block, WhenTimesAreExtreme_ThenTheyAreKept) {
  constexpr std::int64_t kLow = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kHigh = std::numeric_limits<std::int64_t>::max();
  expect_lossless({{kLow, 1.0}, {kLow, 2.0}, {-1, 3.0}, {0, 4.0}, {kHigh - 1, 5.0}, {kHigh, 6.0}});
  expect_lossless({{kLow, 1.0}, {kHigh, 2.0}});
}

TEST(Block, WhenSignalsAreSlow_ThenASampleTakesThreeBytesAtMost) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 1.0);
  double counts = 2000.0;
  const auto walk = [&] { return counts += std::round(noise(random)); };
  EXPECT_LE(bytes_per_sample(made(512, [&](std::size_t i) { return at(i, walk()); })), 0.6);
  // Raw counts times the factor of a sensor: no decimal numbers.
  EXPECT_LE(bytes_per_sample(made(512, [&](std::size_t i) { return at(i, walk() * 0.0071428571); })), 3.0);
  EXPECT_LE(bytes_per_sample(made(512, [&](std::size_t i) { return at(i, std::round(walk() * 7.1) / 100); })),
            1.0);
  // Changes only, at odd times of a scan of 10 ms.
  std::int64_t time = 0;
  EXPECT_LE(bytes_per_sample(made(512,
                                  [&](std::size_t) {
                                    time += 10'000'000 * (1 + static_cast<std::int64_t>(random() % 500));
                                    return Sample{time, walk()};
                                  })),
            2.0);
}

TEST(Block, WhenAnyBitIsWrong_ThenItIsNoSoundBlock) {
  const auto block =
      encode_block(made(40, [](std::size_t i) { return at(i, 0.1 * static_cast<double>(i)); }));
  std::vector<Sample> back = {at(1, 1.0)};
  for (std::size_t bit = 0; bit < 8 * block.size(); ++bit) {
    auto wrong = block;
    wrong[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_FALSE(decode_block(wrong, back)) << bit;
  }
  for (std::size_t size = 0; size < block.size(); ++size)
    EXPECT_FALSE(decode_block(std::span(block).first(size), back)) << size;
  EXPECT_EQ(back.size(), 1u) << "a damaged block leaves what was there";
}

// With a sum that is right, what is read is what somebody has written on purpose.
TEST(Block, WhenDamageHasTheRightSum_ThenDecodingEndsAndTimesAscend) {
  std::mt19937 random(3);
  const std::vector<std::vector<std::byte>> blocks = {
      encode_block(made(100, [](std::size_t i) { return at(i, static_cast<double>(i)); })),
      encode_block(made(100, [](std::size_t i) { return at(i, std::sin(0.01 * static_cast<double>(i))); })),
      encode_block(made(100, [](std::size_t i) { return at(i, 0.0123 * static_cast<double>(i % 5)); }))};
  int sound = 0;
  for (int round = 0; round < 30'000; ++round) {
    auto bytes = blocks[random() % blocks.size()];
    if (random() % 4 == 0) bytes.resize(18 + random() % (bytes.size() - 18));
    for (unsigned change = 1 + random() % 4; change > 0; --change)
      bytes[random() % (bytes.size() - 4)] = static_cast<std::byte>(random());
    const std::uint32_t sum = base::crc32c(std::span(bytes).first(bytes.size() - 4));
    std::memcpy(bytes.data() + bytes.size() - 4, &sum, 4);
    std::vector<Sample> back;
    if (!decode_block(bytes, back)) {
      EXPECT_TRUE(back.empty());
      continue;
    }
    ++sound;
    EXPECT_TRUE(std::ranges::is_sorted(back, {}, &Sample::time_ns));
    EXPECT_LE(back.size(), kMostInBlock);
  }
  EXPECT_GT(sound, 100) << "the mutations do not get beyond the header";
}

}  // namespace
}  // namespace stepwright::historian
