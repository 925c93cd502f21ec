#include "runtime/record/scan_tap.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "tests/support/malloc_guard.h"
#include "tests/unit/runtime/record/recorded_run.h"

namespace stepwright::record {
namespace {

using Layout = support::SampleLayout;

std::vector<RecordKind> drained(Session& session) {
  std::vector<RecordKind> kinds;
  std::vector<std::byte> record;
  while (session.ring.pop(record)) kinds.push_back(static_cast<RecordKind>(record[0]));
  return kinds;
}

TEST(ScanTap, WhenTheRingIsFull_ThenAGapIsToldAndItGoesOnWithAState) {
  Session session(16'000, 1, 0);
  RecordedRun run;
  run.tap.begin(&session);
  run.tap.state(StateCause::Begin, run.running());
  while (session.gaps == 0) run.scan();
  const std::uint64_t lost = run.cycle.scan();
  EXPECT_EQ(session.first_gap, lost);
  run.scans(10);
  auto kinds = drained(session);
  EXPECT_EQ(kinds.front(), RecordKind::State);
  EXPECT_EQ(kinds.size(), lost);  // the state, and every scan before the one that was lost
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), RecordKind::Scan), static_cast<long>(lost - 1));

  run.force({0, 0, 1, 1});  // within the gap: the state will hold it
  run.scan();
  run.scan();
  kinds = drained(session);
  EXPECT_EQ(kinds, (std::vector{RecordKind::Gap, RecordKind::State, RecordKind::Scan}));
  EXPECT_EQ(session.gaps, 1u);
  EXPECT_EQ(session.scans, lost);
}

TEST(ScanTap, WhenScansAreLost_ThenTheReplaySaysSoAndTheRestIsEqual) {
  TemporaryFolder folder;
  Recorder recorder;
  RecordedRun run;
  ASSERT_TRUE(run.begin(recorder, {.file = folder / "run", .keyframe_every = 0, .ring_bytes = 16'000}));
  std::uint64_t scans = 0;
  for (std::uint64_t gaps = 1; gaps <= 5; ++gaps) {
    // Writes fill a ring faster than any writer empties it, also where scans are slow.
    while (run.session->gaps < gaps)
      run.write(Layout::kMain + Layout::kCount, std::byte{static_cast<unsigned char>(gaps)});
    const std::uint64_t recorded = run.session->scans;
    for (; run.session->scans == recorded; ++scans) {
      run.scan();
      std::this_thread::sleep_for(Recorder::kPollPeriod);
    }
  }
  run.tap.end("test");
  EXPECT_GT(finished(recorder).gaps, 0u);
  const auto report = replay(folder / "run", interpreted());
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->difference);
  ASSERT_FALSE(report->gaps.empty());
  ASSERT_FALSE(report->problems.empty());
  EXPECT_EQ(report->problems[0].code, "R0056");
  EXPECT_EQ(report->trace_hash, run.cycle.trace_hash());
  EXPECT_LT(report->scans, scans);
}

TEST(ScanTap, WhenTheHostAsks_ThenThereIsRoomForAScanOrItSaysNo) {
  Session session(2u << 20, 1, 1);
  RecordedRun run;
  run.tap.begin(&session);
  run.tap.state(StateCause::Begin, run.running());
  std::uint64_t scans = 0;
  for (; run.tap.has_room(run.running().image.bytes().size()); ++scans) run.scan();
  EXPECT_GT(scans, 1'000u);
  EXPECT_EQ(session.gaps, 0u);
  run.tap.end("test");
  EXPECT_TRUE(run.tap.has_room(1));
}

TEST(ScanTap, WhenItRecords_ThenItNeitherAllocatesNorLocks) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  TemporaryFolder folder;
  Recorder recorder;
  RecordedRun run;
  ASSERT_TRUE(run.begin(recorder, {.file = folder / "run", .max_bytes = 100'000, .keyframe_every = 10}));
  run.scan();  // the driver of the test allocates once
  const support::GuardCounts before = support::guard_counts();
  for (int i = 0; i < 2'000; ++i) {
    run.scan();
    run.tap.forced({0, 0, 1, 1});
    run.tap.wrote(0, {});
    run.tap.unforced(0, 0);
    if (i % 100 == 0) run.tap.state(StateCause::Change, run.running());
  }
  run.tap.stopped("test");
  run.tap.end("test");
  EXPECT_EQ(support::guard_counts(), before);
}

// Beside the same scans without a recording, in the same minute.
TEST(ScanTap, WhenItRecords_ThenItsCostIsSmall) {
  TemporaryFolder folder;
  Recorder recorder;
  RecordedRun run;
  const auto nanoseconds = [&] {
    constexpr int kScans = 20'000;
    const auto begin = std::chrono::steady_clock::now();
    run.scans(kScans);
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() /
           kScans;
  };
  nanoseconds();
  const double plain = nanoseconds();
  ASSERT_TRUE(run.begin(recorder, {.file = folder / "run"}));
  const double recorded = nanoseconds();
  run.tap.end("test");
  std::printf("a scan takes %.0f ns, recorded %.0f ns\n", plain, recorded);
  RecordProperty("scan_ns", std::to_string(plain));
  RecordProperty("recorded_scan_ns", std::to_string(recorded));
  EXPECT_LT(recorded, 20.0 * plain + 20'000.0);  // no system call, whatever the machine does beside it
}

TEST(ScanTap, WhenNothingIsRecorded_ThenEveryCallReturns) {
  RecordedRun run;
  run.scans(10);
  run.stop();
  run.start();
  run.force({0, 0, 1, 1});
  run.tap.end("test");
  EXPECT_FALSE(run.tap.recording());
}

}  // namespace
}  // namespace stepwright::record
