#include "runtime/scan/task_watchdog.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::scan {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// The execution that expires, 1-based; 0: none.
std::size_t expires(const WatchdogLimits& limits, const std::vector<std::int64_t>& took_ms) {
  TaskWatchdog watchdog(limits);
  for (std::size_t i = 0; i < took_ms.size(); ++i) {
    if (watchdog.executed(took_ms[i] * kMs)) return i + 1;
  }
  return 0;
}

struct Row {
  std::int64_t time_ms;
  std::uint32_t sensitivity;
  std::vector<std::int64_t> took_ms;
  std::size_t expires;
};

// The documented table of CODESYS: sensitivity 0 and 1: exception in cycle 1; 2: in cycle 2; n: in cycle n;
// a single cycle: exception if it is longer than sensitivity x time.
TEST(TaskWatchdog, WhenExecutionsAreTooLong_ThenItExpiresAsCodesysDocumentsIt) {
  const std::vector<Row> rows = {
      {0, 1, {1'000, 1'000}, 0},         // off
      {10, 1, {10, 10, 10}, 0},          // as long as the time is not too long
      {10, 1, {9, 11}, 2},               // at once
      {10, 0, {11}, 1},                  // 0 means 1
      {10, 2, {11, 11}, 2},              // two in a row
      {10, 2, {11, 9, 11, 9, 11}, 0},    // never two in a row
      {10, 2, {11, 10, 11, 11}, 4},      // begins to count again
      {10, 2, {20, 20}, 2},              // exactly n x time is not beyond it
      {10, 2, {21}, 1},                  // one of more than n x time
      {10, 3, {11, 12, 13}, 3},          // three in a row
      {10, 3, {11, 12, 30, 11}, 3},      // the third in a row, whatever its length
      {10, 5, {49, 1, 51}, 3},           // the example of the manuals: 10 ms, 5: beyond 50 ms at once
      {10, 5, {50, 50, 50, 50, 9}, 0},   // four in a row
      {10, 5, {50, 50, 50, 50, 11}, 5},  // five in a row
  };
  for (const Row& row : rows) {
    EXPECT_EQ(expires({row.time_ms * kMs, row.sensitivity}, row.took_ms), row.expires)
        << row.time_ms << " ms x " << row.sensitivity << ", line " << &row - rows.data();
  }
}

TEST(TaskWatchdog, WhenItIsReset_ThenItCountsFromTheBeginning) {
  TaskWatchdog watchdog({10 * kMs, 2});
  EXPECT_FALSE(watchdog.executed(11 * kMs));
  watchdog.reset();
  EXPECT_FALSE(watchdog.executed(11 * kMs));
  EXPECT_TRUE(watchdog.executed(11 * kMs));
}

TEST(TaskWatchdog, WhenTheLimitIsAskedFor_ThenItIsTheTimeTimesTheSensitivity) {
  EXPECT_EQ(TaskWatchdog().longest_ns(), TaskWatchdog::kNoLimit);
  EXPECT_EQ(TaskWatchdog({10 * kMs, 0}).longest_ns(), 10 * kMs);
  EXPECT_EQ(TaskWatchdog({10 * kMs, 3}).longest_ns(), 30 * kMs);
  EXPECT_EQ(TaskWatchdog({TaskWatchdog::kNoLimit / 2, 3}).longest_ns(), TaskWatchdog::kNoLimit);
}

}  // namespace
}  // namespace stepwright::scan
