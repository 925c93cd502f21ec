#include "runtime/record/recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "tests/unit/runtime/record/recorded_run.h"

namespace stepwright::record {
namespace {

using Layout = support::SampleLayout;

ReplayReport replayed(const std::string& file, const ReplayOptions& options = interpreted()) {
  auto report = replay(file, options);
  EXPECT_TRUE(report) << (report ? "" : result::to_string(report.error()));
  return report ? std::move(*report) : ReplayReport{};
}

TEST(Recording, WhenAProgramWasRecorded_ThenEveryImageComesOutAgain) {
  TemporaryFolder folder;
  const std::string file = folder / "run";
  Recorder recorder;
  RecordedRun run;
  run.scans(7);  // before anything is recorded
  ASSERT_TRUE(run.begin(recorder, {.file = file, .keyframe_every = 100}));
  run.scans(5'000);
  run.tap.end("test");
  const RecordingStatus status = finished(recorder);
  EXPECT_EQ(status.state, RecordingState::Done) << status.problem;
  EXPECT_EQ(status.scans, 5'000u);
  EXPECT_EQ(status.bytes, std::filesystem::file_size(file));
  const ReplayReport report = replayed(file);
  EXPECT_EQ(report.first_scan, 8u);
  EXPECT_EQ(report.scans, 5'000u);
  EXPECT_EQ(report.hashes, 5'000u);
  EXPECT_EQ(report.keyframes, 50u);
  EXPECT_FALSE(report.difference);
  EXPECT_TRUE(report.ended);
  EXPECT_TRUE(report.problems.empty());
  EXPECT_EQ(report.trace_hash, run.cycle.trace_hash());
  EXPECT_LT(status.bytes, 5'000u * 25);  // hash, flags, length, chunk and a changed byte now and then
}

TEST(Recording, WhenCommandsComeBetweenScans_ThenTheReplayPerformsThemThere) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    TemporaryFolder folder;
    const std::string file = folder / "run";
    Recorder recorder;
    RecordedRun run(seed);
    std::mt19937 random(seed);
    ASSERT_TRUE(run.begin(recorder, {.file = file}));
    const image::Force start{Layout::kInputs, 0, 1, 1};
    const image::Force level{Layout::kMain + Layout::kLevel, image::kWholeBytes, 4, 0x41200000};
    bool forced = false;
    for (int i = 0; i < 300; ++i) {
      switch (random() % 20) {
        case 0:
          run.stop();
          run.start();
          forced = false;
          break;
        case 1:
          for (const image::Force& force : {start, level}) forced ? run.unforce(force) : run.force(force);
          forced = !forced;
          break;
        case 2:
          run.write(Layout::kMain + Layout::kCount, static_cast<std::byte>(random()));
          break;
        case 3:
          run.cycle.skip_to(run.cycle.next_time_ns() + static_cast<std::int64_t>(random() % 50'000'000));
          break;
        default:
          run.scan();
      }
    }
    run.tap.end("test");
    finished(recorder);
    const ReplayReport report = replayed(file);
    ASSERT_FALSE(report.difference) << "seed " << seed << " scan " << report.difference->scan;
    EXPECT_EQ(report.trace_hash, run.cycle.trace_hash());
    EXPECT_TRUE(report.problems.empty());
  }
}

TEST(Recording, WhenTheDriverIsLost_ThenTheReplayEndsInTheSameState) {
  for (const bool reading : {true, false}) {
    TemporaryFolder folder;
    const std::string file = folder / "run";
    Recorder recorder;
    RecordedRun run;
    ASSERT_TRUE(run.begin(recorder, {.file = file}));
    run.scans(10);
    (reading ? run.io.read_good : run.io.write_good) = false;
    run.scan();
    run.io.read_good = run.io.write_good = true;
    run.start();
    run.scans(10);
    run.tap.end("test");
    finished(recorder);
    const ReplayReport report = replayed(file);
    EXPECT_FALSE(report.difference);
    EXPECT_EQ(report.scans, 21u);
    EXPECT_EQ(report.starts, 1u);
    EXPECT_EQ(report.trace_hash, run.cycle.trace_hash());
  }
}

TEST(Recording, WhenAnInputIsChangedAfterwards_ThenTheReplayNamesTheScanAndTheVariables) {
  TemporaryFolder folder;
  Recorder recorder;
  RecordedRun run;
  ASSERT_TRUE(run.begin(recorder, {.file = folder / "run", .keyframe_every = 1}));
  run.scans(100);
  run.tap.end("test");
  finished(recorder);
  auto records = records_of(folder / "run");
  std::uint64_t scan = 0;
  for (auto& record : records) {
    if (kind_of(record) != RecordKind::Scan || ++scan < 20) continue;
    if ((std::to_integer<unsigned>(record[1]) & kScanInputs) == 0) continue;
    record.back() ^= std::byte{0x40};  // the last byte is one of the inputs
    break;
  }
  write_records(folder / "changed", records, 1'000);
  const ReplayReport report = replayed(folder / "changed");
  ASSERT_TRUE(report.difference);
  EXPECT_EQ(report.difference->scan, scan);
  EXPECT_EQ(report.difference->what, "image");
  EXPECT_EQ(report.difference->keyframe_scan, scan);
  EXPECT_FALSE(report.difference->variables.empty());
}

TEST(Recording, WhenItEndsWithAScan_ThenUntilStopsThere) {
  TemporaryFolder folder;
  Recorder recorder;
  RecordedRun run;
  ASSERT_TRUE(run.begin(recorder, {.file = folder / "run"}));
  run.scans(100);
  run.tap.end("test");
  finished(recorder);
  ReplayOptions options = interpreted();
  options.until = 42;
  std::uint64_t seen = 0;
  options.on_scan = [&](const scan::ScanReport& report, const image::ProcessImage&) { seen = report.scan; };
  const ReplayReport report = replayed(folder / "run", options);
  EXPECT_EQ(report.last_scan, 42u);
  EXPECT_EQ(seen, 42u);
  EXPECT_TRUE(report.problems.empty());
}

TEST(Recording, WhenItIsBounded_ThenTheNewestScansAreKeptInTwoFiles) {
  TemporaryFolder folder;
  const std::string file = folder / "run";
  Recorder recorder;
  RecordedRun run;
  ASSERT_TRUE(run.begin(recorder, {.file = file, .max_bytes = 100'000}));
  for (int i = 0; i < 200; ++i) {
    run.scans(200);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  run.tap.end("test");
  EXPECT_EQ(finished(recorder).state, RecordingState::Done);
  const ReplayReport newest = replayed(file);
  const ReplayReport before = replayed(file + ".1");
  EXPECT_FALSE(newest.difference);
  EXPECT_FALSE(before.difference);
  EXPECT_EQ(newest.last_scan, 40'000u);
  EXPECT_EQ(newest.trace_hash, run.cycle.trace_hash());
  EXPECT_EQ(before.last_scan + 1, newest.first_scan);  // nothing lies between the two
  EXPECT_GT(before.first_scan, 1u);
  EXPECT_FALSE(std::filesystem::exists(file + ".1.1"));
}

TEST(Recording, WhenTheFileExists_ThenItIsPutAside) {
  TemporaryFolder folder;
  const std::string file = folder / "run";
  for (int round = 0; round < 3; ++round) {
    Recorder recorder;
    RecordedRun run;
    ASSERT_TRUE(run.begin(recorder, {.file = file}));
    run.scans(10);
    run.tap.end("test");
    finished(recorder);
  }
  EXPECT_EQ(replayed(file + ".1").last_scan, 10u);
  EXPECT_EQ(replayed(file).last_scan, 10u);
}

TEST(Recording, WhenTheFileIsNoRecording_ThenItStaysAndIsRefused) {
  for (const char* name : {"run", "run.1"}) {
    TemporaryFolder folder;
    const std::string file = folder / "run";
    std::ofstream(file) << "";
    std::ofstream(folder / name) << "precious";
    Recorder recorder;
    RecordedRun run;
    const auto refused = run.begin(recorder, {.file = file});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error()[0].code, "R0051");
    EXPECT_EQ(refused.error()[0].where.file, folder / name);
    std::string kept;
    std::getline(std::ifstream(folder / name), kept);
    EXPECT_EQ(kept, "precious");
  }
}

TEST(Recording, WhenTheFileCannotBeMade_ThenItIsRefusedWithItsPlace) {
  TemporaryFolder folder;
  Recorder recorder;
  RecordedRun run;
  for (const std::string& file :
       {std::string(folder / "no/such/folder"), std::string(folder / ""), std::string("/dev/null")}) {
    const auto refused = run.begin(recorder, {.file = file});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error()[0].code, "R0051");
    EXPECT_EQ(refused.error()[0].where.file, file);
  }
  EXPECT_FALSE(recorder.active());
}

TEST(Recording, WhenThereIsOneAlready_ThenAnotherIsRefused) {
  TemporaryFolder folder;
  Recorder recorder;
  RecordedRun run;
  ASSERT_TRUE(run.begin(recorder, {.file = folder / "one"}));
  const auto refused = recorder.begin({.file = folder / "two"}, RecordedRun::facts());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "R0052");
  run.tap.end("test");
  finished(recorder);
  EXPECT_TRUE(run.begin(recorder, {.file = folder / "two"}));
  run.tap.end("test");
}

TEST(Recording, WhenTheDiskIsFull_ThenItFailsAndTheScansGoOn) {
  TemporaryFolder folder;
  const std::string file = folder / "run";
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  Recorder recorder;
  RecordedRun run;
  ASSERT_TRUE(run.begin(recorder, {.file = file}));
  const struct rlimit small { 200'000, before.rlim_max };
  setrlimit(RLIMIT_FSIZE, &small);
  for (int i = 0; i < 10'000 && recorder.active(); ++i) {
    run.scans(1'000);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  const RecordingStatus status = finished(recorder);
  EXPECT_EQ(status.state, RecordingState::Failed);
  EXPECT_NE(status.problem.find("R0051"), std::string::npos) << status.problem;
  run.scans(10);
  EXPECT_FALSE(run.tap.recording());
  // What reached the disk is good.
  const ReplayReport report = replayed(file);
  EXPECT_GT(report.scans, 1'000u);
  EXPECT_FALSE(report.difference);
  EXPECT_FALSE(result::has_errors(report.problems));
  // And another one may begin.
  ASSERT_TRUE(run.begin(recorder, {.file = file}));
  run.scans(10);
  run.tap.end("test");
  EXPECT_EQ(finished(recorder).state, RecordingState::Done);
}

TEST(Recording, WhenTheProcessEndsWithoutAWord_ThenOnlyTheEndIsMissing) {
  TemporaryFolder folder;
  const std::string file = folder / "run";
  RecordedRun run;
  {
    Recorder recorder;
    ASSERT_TRUE(run.begin(recorder, {.file = file}));
    run.scans(1'000);
  }
  const ReplayReport report = replayed(file);
  EXPECT_EQ(report.scans, 1'000u);
  EXPECT_FALSE(report.ended);
  ASSERT_EQ(report.problems.size(), 1u);
  EXPECT_EQ(report.problems[0].severity, result::Severity::Warning);
}

}  // namespace
}  // namespace stepwright::record
