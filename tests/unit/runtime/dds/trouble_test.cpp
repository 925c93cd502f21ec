#include "runtime/dds/internal/trouble.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::dds::internal {
namespace {

using namespace std::chrono_literals;

result::Diagnostic refused(const std::string& topic, const char* code) {
  return {code, result::Severity::Error, {topic, 0, 0}, "refused", {}};
}

TEST(Trouble, WhenASenderIsWrongWithEverySample_ThenItIsToldOnceAMinute) {
  std::vector<std::string> told;
  Trouble trouble([&](const result::Diagnostic& d) { told.push_back(d.where.file + " " + d.code); });
  const Trouble::Clock::time_point begin{1'000s};
  for (int i = 0; i < 100; ++i) trouble.add(refused("a", "D0008"), 9, begin + i * 100ms);
  trouble.add(refused("b", "D0008"), 9, begin + 11s);
  trouble.add(refused("a", "R0005"), 9, begin + 12s);
  trouble.add(refused("a", "D0008"), 10, begin + 13s);
  EXPECT_EQ(told, (std::vector<std::string>{"a D0008", "b D0008", "a R0005", "a D0008"}));
  trouble.add(refused("a", "D0008"), 9, begin + 61s);
  EXPECT_EQ(told.size(), 5u);
}

TEST(Trouble, WhenVersionsAreMadeUp_ThenNoMoreThanSoManyAreTold) {
  std::size_t told = 0;
  Trouble trouble([&](const result::Diagnostic&) { ++told; });
  for (std::uint32_t version = 0; version < 10'000; ++version)
    trouble.add(refused("a", "D0008"), version, Trouble::Clock::time_point{1'000s});
  EXPECT_EQ(told, Trouble::kMostKinds);
}

TEST(Trouble, WhenNobodyWantsToKnow_ThenNothingHappens) {
  Trouble trouble({});
  trouble.add(refused("a", "D0008"), 9, {});
}

}  // namespace
}  // namespace stepwright::dds::internal
