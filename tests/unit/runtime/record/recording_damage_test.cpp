// Files that were cut, changed or made up.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/unit/runtime/record/recorded_run.h"

namespace stepwright::record {
namespace {

constexpr std::uint64_t kScans = 100;

class RecordingDamage : public ::testing::Test {
 protected:
  void SetUp() override {
    Recorder recorder;
    RecordedRun run;
    ASSERT_TRUE(run.begin(recorder, {.file = folder_ / "whole", .keyframe_every = 40}));
    run.scans(kScans);
    run.tap.end("test");
    finished(recorder);
    write_records(folder_ / "run", records_of(folder_ / "whole"), 25);
    std::ifstream file(folder_ / "run", std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
  }

  result::Result<ReplayReport> replay_of(std::string bytes) const {
    std::ofstream(folder_ / "broken", std::ios::binary) << bytes;
    return replay(folder_ / "broken", interpreted());
  }

  TemporaryFolder folder_;
  std::string bytes_;
};

TEST_F(RecordingDamage, WhenItIsCutAnywhere_ThenWhatIsLeftIsReplayed) {
  std::uint64_t before = 0;
  // Every byte around the chunks' borders comes up: the step has no factor in common with their sizes.
  for (std::size_t size = 0; size < bytes_.size(); size += 3) {
    const auto report = replay_of(bytes_.substr(0, size));
    if (!report) {
      EXPECT_LT(size, 16u + sizeof(ChunkHeader)) << result::to_string(report.error());
      continue;
    }
    ASSERT_FALSE(report->difference) << size;
    ASSERT_GE(report->scans, before) << size;
    before = report->scans;
    ASSERT_FALSE(report->problems.empty()) << size;
    EXPECT_NE(report->problems.back().where.file.find("broken"), std::string::npos);
    // A cut is what a kill leaves: no error.
    EXPECT_FALSE(result::has_errors(report->problems)) << size << result::to_string(report->problems);
  }
  EXPECT_GE(before, kScans - 25);
  const auto whole = replay_of(bytes_);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->scans, kScans);
  EXPECT_TRUE(whole->problems.empty());
}

TEST_F(RecordingDamage, WhenAnyByteIsChanged_ThenItIsNoticedAndNothingWrongIsReplayed) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    std::string changed = bytes_;
    changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
    const auto report = replay_of(changed);
    if (!report) continue;
    ASSERT_FALSE(report->difference) << "byte " << at;
    ASSERT_FALSE(report->problems.empty()) << "byte " << at;
    EXPECT_NE(report->problems.back().message.find("byte "), std::string::npos) << at;
    ASSERT_LE(report->scans, kScans) << "byte " << at;
  }
}

TEST_F(RecordingDamage, WhenAChunkInTheMiddleLosesItsLength_ThenItIsDamageAndNoEnd) {
  std::string changed = bytes_;
  const std::size_t chunk = changed.find("CHNK", changed.find("CHNK", 16) + 1);
  changed[chunk + 10] = 1;  // 64 KiB longer than it is: beyond the end of the file
  const auto report = replay_of(changed);
  ASSERT_TRUE(report);
  ASSERT_TRUE(result::has_errors(report->problems));
  EXPECT_EQ(report->problems[0].code, "R0053");
  EXPECT_NE(report->problems[0].message.find("byte " + std::to_string(chunk)), std::string::npos);
}

TEST_F(RecordingDamage, WhenTheFileIsSomethingElse_ThenItIsRefused) {
  const auto code_of = [](const auto& refused) { return refused ? "" : refused.error()[0].code; };
  EXPECT_EQ(code_of(replay_of("")), "R0054");
  EXPECT_EQ(code_of(replay_of("PLCimage and more of it")), "R0054");
  std::string newer = bytes_;
  newer[8] = 2;
  EXPECT_EQ(code_of(replay_of(newer)), "R0059");
  EXPECT_EQ(code_of(replay(folder_ / "missing", interpreted())), "R0051");
}

// Records with right checksums that no runtime writes.
TEST_F(RecordingDamage, WhenRecordsAreMadeUp_ThenTheyAreRefusedWithTheirPlace) {
  const auto records = records_of(folder_ / "run");
  std::mt19937 random(7);
  for (int trial = 0; trial < 1'000; ++trial) {
    auto made = records;
    auto& record = made[random() % made.size()];
    switch (random() % 4) {
      case 0:
        record.resize(1 + random() % record.size());
        break;
      case 1:
        record.push_back(static_cast<std::byte>(random()));
        break;
      case 2:
        made.erase(made.begin() + static_cast<std::ptrdiff_t>(random() % made.size()));
        break;
      default:
        record[random() % std::min<std::size_t>(record.size(), 64)] = static_cast<std::byte>(random());
    }
    std::error_code ignored;
    std::filesystem::remove(folder_ / "made", ignored);
    write_records(folder_ / "made", made, 500);
    // Whatever comes out: no crash, and no more scans than there are.
    const auto report = replay(folder_ / "made", interpreted());
    EXPECT_LE(report ? report->scans : 0, kScans);
  }
}

}  // namespace
}  // namespace stepwright::record
