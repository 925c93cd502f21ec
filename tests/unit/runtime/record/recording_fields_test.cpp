// Records with right checksums whose fields have values that no runtime writes: instants, counts, budgets and
// ramps that an honest reader would divide by, add to or cast.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "ladder/driver/compile.h"
#include "tests/unit/runtime/record/recorded_run.h"

namespace stepwright::record {
namespace {

constexpr std::uint64_t kRecorded = 30;
constexpr std::int64_t kLeastInt = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMostInt = std::numeric_limits<std::int64_t>::max();

// One task is cyclic, the other one runs on its trigger only.
std::vector<std::byte> with_an_event() {
  driver::CompileInput input;
  input.texts.push_back({"test.st", R"(
CONFIGURATION c
  VAR_GLOBAL go AT %IX0.0 : BOOL; n AT %QW0 : INT; events : DINT; END_VAR
  TASK cyclic(INTERVAL := T#10ms, PRIORITY := 0);
  TASK event(SINGLE := go, PRIORITY := 1);
  PROGRAM pc WITH cyclic : counter;
  PROGRAM pe WITH event : on_event;
END_CONFIGURATION
PROGRAM counter
VAR_EXTERNAL n : INT; END_VAR
n := n + 1;
END_PROGRAM
PROGRAM on_event
VAR_EXTERNAL events : DINT; END_VAR
events := events + 1;
END_PROGRAM
)"});
  auto output = driver::compile(input);
  EXPECT_TRUE(output) << (output ? "" : result::to_string(output.error()));
  return output ? std::move(output->container) : std::vector<std::byte>();
}

class RecordingFields : public ::testing::Test {
 protected:
  // Where the fields of a State of this program stand: behind kind, cause, and the digest "sample".
  static constexpr std::size_t kTime = 10 + 8;
  static constexpr std::size_t kTasks = kTime + 8 + 8 + 1;
  static constexpr std::size_t kTaskBytes = 10;
  static constexpr std::size_t kDue = kTasks + 1;

  void SetUp() override {
    Recorder recorder;
    RecordedRun run(1, with_an_event());
    ASSERT_TRUE(run.begin(recorder, {.file = folder_ / "whole", .keyframe_every = 10}));
    run.force({3, image::kWholeBytes, 1, 0});
    run.scans(kRecorded);
    run.tap.end("test");
    finished(recorder);
    records_ = records_of(folder_ / "whole");
    ASSERT_EQ(replay_of(records_)->scans, kRecorded);
    ASSERT_FALSE(replay_of(records_)->difference);
  }

  std::vector<std::byte>& first(RecordKind kind) {
    for (std::vector<std::byte>& record : records_) {
      if (kind_of(record) == kind) return record;
    }
    ADD_FAILURE() << "there is no such record";
    return records_.front();
  }
  template <typename T>
  static void put(std::vector<std::byte>& record, std::size_t at, T value) {
    ASSERT_LE(at + sizeof value, record.size());
    std::memcpy(record.data() + at, &value, sizeof value);
  }
  template <typename T>
  static T get(const std::vector<std::byte>& record, std::size_t at) {
    T value;
    std::memcpy(&value, record.data() + at, sizeof value);
    return value;
  }

  result::Result<ReplayReport> replay_of(const std::vector<std::vector<std::byte>>& records) const {
    std::error_code ignored;
    std::filesystem::remove(folder_ / "made", ignored);
    write_records(folder_ / "made", records, 500);
    return replay(folder_ / "made", interpreted());
  }
  // What is told of the records as they are now: a code and a word of the message.
  void expect_nonsense(const std::string& word) const {
    const auto report = replay_of(records_);
    const auto& problems = report ? report->problems : report.error();
    ASSERT_FALSE(problems.empty()) << word;
    EXPECT_EQ(problems[0].code, "R0054");
    EXPECT_NE(problems[0].message.find(word), std::string::npos) << problems[0].message;
    EXPECT_NE(problems[0].message.find("at byte "), std::string::npos) << problems[0].message;
  }

  TemporaryFolder folder_;
  std::vector<std::vector<std::byte>> records_;
};

TEST_F(RecordingFields, WhenAnEventHasADueTime_ThenTheStateIsRefused) {
  std::vector<std::byte>& state = first(RecordKind::State);
  ASSERT_EQ(get<std::int64_t>(state, kDue + kTaskBytes), scan::kNever);
  for (const std::int64_t due_ns : {std::int64_t{0}, std::int64_t{1}, kLeastInt, kMostInt - 1}) {
    put(state, kDue + kTaskBytes, due_ns);
    expect_nonsense("state");
  }
}

TEST_F(RecordingFields, WhenATaskIsDueAtNoInstant_ThenTheStateIsRefused) {
  for (const std::int64_t due_ns : {std::int64_t{-1}, kLeastInt, kMostInt, kMostInt - 1, kMostInt / 2}) {
    put(first(RecordKind::State), kDue, due_ns);
    expect_nonsense("state");
  }
}

TEST_F(RecordingFields, WhenTheTimeIsNoInstant_ThenTheStateIsRefused) {
  for (const std::int64_t time_ns : {std::int64_t{-1}, kLeastInt, kMostInt}) {
    put(first(RecordKind::State), kTime, time_ns);
    expect_nonsense("state");
  }
}

TEST_F(RecordingFields, WhenTasksAreInAnotherOrder_ThenTheStateIsRefused) {
  std::vector<std::byte>& state = first(RecordKind::State);
  put(state, kTasks, std::uint8_t{1});
  put(state, kTasks + kTaskBytes, std::uint8_t{0});
  expect_nonsense("state");
}

TEST_F(RecordingFields, WhenAScanIsAtNoInstant_ThenItIsRefused) {
  for (const std::int64_t step_ns : {kLeastInt, kLeastInt + 1, kMostInt, std::int64_t{-1'000'000'000}}) {
    std::array<std::byte, 32> buffer;
    Encoder scan(buffer);
    scan.put(RecordKind::Scan).put(static_cast<std::uint8_t>(kScanStep | 1 << kScanStateShift));
    scan.put_varint(zigzag(step_ns));
    first(RecordKind::Scan).assign(scan.bytes().begin(), scan.bytes().end());
    expect_nonsense("scan at a time");
  }
}

TEST_F(RecordingFields, WhenASecondSessionComes_ThenItIsRefused) {
  records_.insert(records_.begin() + 5, records_.front());
  expect_nonsense("second session");
}

TEST_F(RecordingFields, WhenTheBudgetIsEndless_ThenTheSessionIsRefused) {
  put(first(RecordKind::Session), 10, std::numeric_limits<std::uint64_t>::max());
  expect_nonsense("budget");
}

TEST_F(RecordingFields, WhenARampLeadsToNoNumber_ThenTheSessionIsRefused) {
  const auto session_with = [&](scan::RampType type, double target, double per_second) {
    std::array<std::byte, 256> buffer;
    Encoder session(buffer);
    session.put_bytes(std::span(records_.front()).first(1 + 1 + 8 + 8 + 12));
    for (std::size_t cause = 0; cause < scan::kSafeCauses; ++cause) {
      session.put_varint(0).put_varint(1).put(std::uint32_t{0}).put(type).put(target).put(per_second);
    }
    return std::vector<std::byte>(session.bytes().begin(), session.bytes().end());
  };
  const double endless = std::numeric_limits<double>::infinity();
  using scan::RampType;
  struct Case {
    RampType type;
    double target, per_second;
  };
  for (const Case& each :
       {Case{RampType::I16, std::nan(""), 1}, Case{RampType::I32, endless, 1}, Case{RampType::U8, 256, 1},
        Case{RampType::F32, 1e39, 1}, Case{RampType::I16, 0, 0}, Case{RampType::I16, 0, -1},
        Case{RampType::I16, 0, endless}, Case{static_cast<RampType>(7), 0, 1}}) {
    records_.front() = session_with(each.type, each.target, each.per_second);
    expect_nonsense("safe state");
  }
  records_.front() = session_with(RampType::I16, 32'767, 1);
  EXPECT_EQ(replay_of(records_)->scans, kRecorded);
}

// Whatever stands in the fields: no crash, no hang, and no more scans than there are.
TEST_F(RecordingFields, WhenAnyFieldIsExtreme_ThenTheReplayEnds) {
  constexpr std::size_t kFront = 64;
  const std::vector<std::vector<std::byte>> records = records_;
  for (std::size_t i = 0; i < std::min<std::size_t>(records.size(), 8); ++i) {
    if (kind_of(records[i]) == RecordKind::Program) continue;  // has a checksum of its own
    for (std::size_t at = 0; at < std::min(records[i].size(), kFront); ++at) {
      for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0},
                                        std::uint64_t{1} << 63, static_cast<std::uint64_t>(kMostInt),
                                        std::uint64_t{1} << 62, std::bit_cast<std::uint64_t>(std::nan(""))}) {
        auto made = records;
        const std::size_t size = std::min(sizeof value, made[i].size() - at);
        std::memcpy(made[i].data() + at, &value, size);
        const auto report = replay_of(made);
        ASSERT_LE(report ? report->scans : 0, kRecorded);
      }
    }
  }
}

}  // namespace
}  // namespace stepwright::record
