#include "runtime/scan/safe_state.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <vector>

namespace stepwright::scan {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
using Bytes = std::vector<std::byte>;

Bytes bytes(std::initializer_list<int> values) {
  Bytes result;
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

template <typename T>
Bytes bytes_of(T value) {
  Bytes result(sizeof value);
  std::memcpy(result.data(), &value, sizeof value);
  return result;
}

template <typename T>
T number_in(std::span<const std::byte> outputs, std::size_t at = 0) {
  T value;
  std::memcpy(&value, outputs.data() + at, sizeof value);
  return value;
}

struct Case {
  SafeMatrix matrix;
  std::vector<SafeOutput> rules;
  std::vector<SafeRamp> ramps;
  Bytes memory;

  Case(std::vector<SafeOutput> r, std::vector<SafeRamp> p, Bytes outputs, SafeCause cause = SafeCause::Trap)
      : rules(std::move(r)), ramps(std::move(p)), memory(outputs.size()), state(fill(cause), memory) {
    state.driven(outputs);
    state.enter(cause, 10 * kSecond);
  }
  Case(const Case&) = delete;
  Case& operator=(const Case&) = delete;

  Bytes at(std::int64_t after_ns) {
    Bytes outputs(memory.size(), std::byte{0xEE});  // whatever the program left there
    state.apply(10 * kSecond + after_ns, outputs);
    return outputs;
  }

  SafeState state;

 private:
  const SafeMatrix& fill(SafeCause cause) {
    matrix[static_cast<std::size_t>(cause)] = {rules, ramps};
    return matrix;
  }
};

TEST(SafeState, WhenThereAreRules_ThenEachBitFollowsItsOwn) {
  Case c({{.byte = 0, .mask = 0x0C, .mode = SafeMode::Hold},
          {.byte = 1, .mask = 0xFF, .mode = SafeMode::Value, .value = 0x55},
          {.byte = 1, .mask = 0x01, .mode = SafeMode::Zero},
          {.byte = 9, .mask = 0xFF, .mode = SafeMode::Value, .value = 1}},
         {}, bytes({0xFF, 0xFF, 0xFF}));
  EXPECT_EQ(c.at(0), bytes({0x0C, 0x54, 0x00}));
  EXPECT_TRUE(c.state.settled());
}

// What is written into the image after the cause came is not held.
TEST(SafeState, WhenHeld_ThenLaterWritesChangeNothing) {
  Case c({{.byte = 0, .mask = 0xFF, .mode = SafeMode::Hold}}, {}, bytes({0x21}));
  EXPECT_EQ(c.at(0), bytes({0x21}));
  EXPECT_EQ(c.at(kSecond), bytes({0x21}));
}

TEST(SafeState, WhenTheMatrixHasColumns_ThenTheCauseChooses) {
  std::array<std::vector<SafeOutput>, kSafeCauses> rules;
  SafeMatrix matrix;
  for (std::size_t i = 0; i < kSafeCauses; ++i) {
    rules[i] = {{.byte = 0, .mode = SafeMode::Value, .value = static_cast<std::uint8_t>(i + 1)}};
    matrix[i].outputs = rules[i];
  }
  for (std::size_t i = 0; i < kSafeCauses; ++i) {
    Bytes memory(1);
    SafeState state(matrix, memory);
    state.enter(static_cast<SafeCause>(i), 0);
    Bytes outputs(1);
    state.apply(0, outputs);
    EXPECT_EQ(outputs, bytes({static_cast<int>(i) + 1}));
    EXPECT_EQ(state.cause(), static_cast<SafeCause>(i));
  }
}

TEST(SafeState, WhenAWordIsRamped_ThenItGoesAtItsRateAndStays) {
  Case c({}, {{.byte = 0, .type = RampType::I16, .target = -50, .per_second = 100}},
         bytes_of<std::int16_t>(200));
  EXPECT_EQ(number_in<std::int16_t>(c.at(0)), 200);
  EXPECT_FALSE(c.state.settled());
  EXPECT_EQ(number_in<std::int16_t>(c.at(kSecond / 100)), 199);
  EXPECT_EQ(number_in<std::int16_t>(c.at(kSecond)), 100);
  EXPECT_EQ(number_in<std::int16_t>(c.at(2 * kSecond)), 0);
  EXPECT_EQ(number_in<std::int16_t>(c.at(5 * kSecond / 2)), -50);
  EXPECT_TRUE(c.state.settled());
  EXPECT_EQ(number_in<std::int16_t>(c.at(100 * kSecond)), -50);
}

TEST(SafeState, WhenARampIsAskedOftenOrSeldom_ThenItIsAtTheSamePlace) {
  const SafeRamp ramp{.byte = 0, .type = RampType::U16, .target = 60'000, .per_second = 0.3};
  Case often({}, {ramp}, bytes_of<std::uint16_t>(7));
  Case seldom({}, {ramp}, bytes_of<std::uint16_t>(7));
  for (std::int64_t ms = 0; ms < 20'000; ms += 3) (void)often.at(ms * 1'000'000);
  EXPECT_EQ(often.at(20 * kSecond), seldom.at(20 * kSecond));
  EXPECT_EQ(number_in<std::uint16_t>(often.at(20 * kSecond)), 13);
}

template <typename T>
void expect_ramp(RampType type, T from, double target, double per_second, T after_1_s) {
  Case c({}, {{.byte = 1, .type = type, .target = target, .per_second = per_second}}, [&] {
    Bytes all = bytes({0xAA});
    const Bytes number = bytes_of(from);
    all.insert(all.end(), number.begin(), number.end());
    return all;
  }());
  EXPECT_EQ(number_in<T>(c.at(kSecond), 1), after_1_s);
  EXPECT_EQ(number_in<T>(c.at(1'000'000 * kSecond), 1), static_cast<T>(target));
  EXPECT_EQ(c.at(0)[0], std::byte{0});  // bits without a rule
}

TEST(SafeState, WhenNumbersOfEveryTypeAreRamped_ThenTheirSignsHold) {
  expect_ramp<std::uint8_t>(RampType::U8, 250, 0, 100, 150);
  expect_ramp<std::int8_t>(RampType::I8, -100, 100, 50, -50);
  expect_ramp<std::uint16_t>(RampType::U16, 65'000, 1'000, 10'000, 55'000);
  expect_ramp<std::int16_t>(RampType::I16, -30'000, 30'000, 1'000, -29'000);
  expect_ramp<std::uint32_t>(RampType::U32, 4'000'000'000u, 0, 1e6, 3'999'000'000u);
  expect_ramp<std::int32_t>(RampType::I32, -2'000'000'000, 5, 1e6, -1'999'000'000);
  expect_ramp<float>(RampType::F32, 1.5f, 0.25, 0.5, 1.0f);
}

TEST(SafeState, WhenARealIsNoNumber_ThenItIsAtItsTargetAtOnce) {
  for (const float odd : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Case c({}, {{.byte = 0, .type = RampType::F32, .target = 2.0, .per_second = 1}}, bytes_of(odd));
    EXPECT_EQ(number_in<float>(c.at(0)), 2.0f);
    EXPECT_TRUE(c.state.settled());
  }
}

TEST(SafeState, WhenARampLeadsOutOfTheArea_ThenItHasNoEffect) {
  Case c({}, {{.byte = 1, .type = RampType::I16, .target = 5, .per_second = 1}}, bytes({1, 2}));
  EXPECT_EQ(c.at(0), bytes({0, 0}));
  EXPECT_TRUE(c.state.settled());
}

// Another process goes on with the same outputs: the ramp begins where it was left.
TEST(SafeState, WhenTheCauseComesAgain_ThenTheRampGoesOnFromWhereItIs) {
  Case c({}, {{.byte = 0, .type = RampType::I16, .target = 0, .per_second = 100}},
         bytes_of<std::int16_t>(200));
  EXPECT_EQ(number_in<std::int16_t>(c.at(kSecond)), 100);
  c.state.enter(SafeCause::Trap, 50 * kSecond);
  Bytes outputs(2);
  c.state.apply(50 * kSecond + kSecond / 2, outputs);
  EXPECT_EQ(number_in<std::int16_t>(outputs), 50);
}

}  // namespace
}  // namespace stepwright::scan
