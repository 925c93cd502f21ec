// What people ask of a runtime over its socket: forces, steps, recordings.

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "runtime/service/monitor_answers.h"
#include "tests/support/step_program.h"
#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::service {
namespace {

using Layout = support::StepProgramLayout;

TEST(Monitoring, WhenVariablesAreForced_ThenObserversReadTheList) {
  ServiceHarness harness;
  const auto client = harness.connect();
  const auto digest = client->download(support::step_program(), kPatience);
  ASSERT_TRUE(digest);
  ASSERT_TRUE(client->call(Force{{{*digest, {Layout::kCount, 0xFFFFFFFF, 5}}}}, kPatience));
  ASSERT_TRUE(client->call(Force{{{*digest, {Layout::kOutput, 4, 4}}, 60'000}}, kPatience));
  const auto observer = harness.connect(Role::Observer);
  const auto reply = observer->call(ReadForces{}, kPatience);
  ASSERT_TRUE(reply);
  const auto forces = decode_forces(reply->data);
  ASSERT_TRUE(forces);
  ASSERT_EQ(forces->size(), 2u);
  EXPECT_EQ((*forces)[0].address, Layout::kCount);
  EXPECT_EQ((*forces)[0].value, 5u);
  EXPECT_EQ((*forces)[1].bit, 2);
  EXPECT_EQ((*forces)[0].end_ns, image::kNoEnd);
  EXPECT_LE((*forces)[1].end_ns, 60'000'000'000) << "the time that is left";
  EXPECT_EQ(reply->digest, *digest);
}

std::vector<host::PlantFault> many_faults(std::size_t count) {
  std::vector<host::PlantFault> faults;
  for (std::size_t i = 0; i < count; ++i)
    faults.push_back({"t" + std::to_string(i) + ".leak", "percent/s", std::string(200, 'x'), -1.0, 5.0,
                      i % 2 == 0, i % 3 == 0, i % 3 == 0 ? 0.5 : 0.0});
  return faults;
}

TEST(Monitoring, WhenFaultsAreManyMore_ThenPartsOfThemComeWhole) {
  const auto faults = many_faults(500);
  std::vector<host::PlantFault> read;
  while (read.size() < faults.size()) {
    const auto data = encode_faults(std::span(faults).subspan(read.size()));
    EXPECT_LE(data.size(), host::kMaxChunkBytes);
    const auto part = decode_faults(data);
    ASSERT_TRUE(part);
    ASSERT_FALSE(part->empty());
    read.insert(read.end(), part->begin(), part->end());
  }
  EXPECT_EQ(read, faults);
}

TEST(Monitoring, WhenAnAnswerOfFaultsIsCutOrNoNumber_ThenItIsRefused) {
  auto data = encode_faults(many_faults(2));
  for (std::size_t size = 1; size < data.size(); ++size) {
    const auto read = decode_faults(std::span(data).first(size));
    EXPECT_TRUE(!read || read->size() == 1) << size;
  }
  const host::PlantFault endless{"leak", "", "", 0.0, std::numeric_limits<double>::infinity()};
  EXPECT_FALSE(decode_faults(encode_faults({&endless, 1})));
}

TEST(Monitoring, WhenThereIsNoSimulatedPlant_ThenObserversReadNoFaults) {
  ServiceHarness harness;
  const auto observer = harness.connect(Role::Observer);
  const auto reply = observer->call(ReadFaults{7}, kPatience);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->total_bytes, 0u);
  EXPECT_TRUE(reply->data.empty());
}

TEST(Monitoring, WhenAForceHasATime_ThenItEndsAlthoughItsClientIsGone) {
  ServiceHarness harness;
  auto client = harness.connect();
  const auto digest = client->download(support::step_program(), kPatience);
  ASSERT_TRUE(digest);
  const Force force{{{*digest, {Layout::kCount, 0xFFFFFFFF, 5}}, 50}};
  ASSERT_TRUE(client->call(force, kPatience));
  client.reset();
  const auto observer = harness.connect(Role::Observer);
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  std::size_t left = 1;
  while (left > 0 && std::chrono::steady_clock::now() < deadline)
    left = decode_forces(observer->call(ReadForces{}, kPatience)->data)->size();
  EXPECT_EQ(left, 0u);
}

TEST(Monitoring, WhenARequestIsOfAnotherProgram_ThenTheRefusalNamesBothAndNothingIsForced) {
  ServiceHarness harness;
  const auto client = harness.connect();
  const auto meant = client->download(support::step_program({.steps = 3}), kPatience);
  const auto loaded = client->download(support::step_program({.steps = 4}), kPatience);
  ASSERT_TRUE(meant && loaded);
  const host::ImageBits bits{Layout::kFree, 0xFF, 5};
  for (const std::string& digest : {*meant, std::string()}) {
    const RequestBody bodies[] = {Force{{{digest, bits}}}, Unforce{{digest, bits}}, Write{{digest, bits}},
                                  WriteBlock{{digest, {bits}}}};
    for (const RequestBody& body : bodies) {
      const auto refused = client->call(body, kPatience);
      ASSERT_FALSE(refused);
      const result::Diagnostic& problem = refused.error().front();
      EXPECT_EQ(problem.code, kOtherProgram);
      EXPECT_NE(problem.message.find(loaded->substr(0, 12)), std::string::npos) << problem.message;
      EXPECT_NE(problem.message.find(digest.empty() ? "does not say" : digest.substr(0, 12)),
                std::string::npos)
          << problem.message;
    }
  }
  EXPECT_EQ(client->call(Write{{*loaded + "0", bits}}, kPatience).error().front().code, "R0004");
  EXPECT_EQ(client->call(Force{{{*loaded, bits}, host::kMaxForceMs + 1}}, kPatience).error().front().code,
            "R0004");
  EXPECT_TRUE(decode_forces(client->call(ReadForces{}, kPatience)->data)->empty());
}

// The same request, sent again after a change: its answer is remembered, and it is not carried out again.
TEST(Monitoring, WhenARequestIsRepeatedBehindADownload_ThenItDoesNotReachTheNextProgram) {
  ServiceHarness harness;
  const auto client = harness.connect();
  const auto digest = client->download(support::step_program({.steps = 3}), kPatience);
  ASSERT_TRUE(digest);
  const Request request{77, 1, Force{{{*digest, {Layout::kFree, 0xFF, 5}}}}};
  client->send(request);
  ASSERT_TRUE(next<Reply>(*client)->accepted());
  ASSERT_TRUE(client->download(support::step_program({.steps = 4}), kPatience));
  client->send(request);
  EXPECT_TRUE(next<Reply>(*client)->accepted());
  EXPECT_TRUE(decode_forces(client->call(ReadForces{}, kPatience)->data)->empty());
}

TEST(Monitoring, WhenItIsStepped_ThenTheReplyNamesTheLastScan) {
  ServiceHarness harness;
  const auto client = harness.connect();
  EXPECT_EQ(client->call(Step{1}, kPatience).error()[0].code, "R0002");  // nothing is loaded
  ASSERT_TRUE(client->download(support::step_program(), kPatience));
  ASSERT_TRUE(client->call(Step{0}, kPatience));
  ASSERT_TRUE(client->call(Start{}, kPatience));
  for (const std::uint64_t target : {3u, 6u, 9u}) {
    const auto reply = client->call(Step{3}, kPatience);
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->offset, target);
    while (client->snapshot()->scan < target) std::this_thread::yield();
    EXPECT_EQ(client->snapshot()->scan, target);
  }
  EXPECT_TRUE(client->call(Continue{}, kPatience));
}

TEST(Monitoring, WhenTheClockIsReal_ThenAStepIsRefusedWithTheReason) {
  host::HostConfig config;
  config.clock = host::ClockMode::Real;
  ServiceHarness harness(config);
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(support::step_program(), kPatience));
  const auto refused = client->call(Step{1}, kPatience);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "R0002");
  EXPECT_NE(refused.error()[0].message.find("real time"), std::string::npos);
}

TEST(Monitoring, WhenARecordingIsAskedFor_ThenItsStatusFollows) {
  ServiceHarness harness;
  TemporaryFolder folder;
  const auto client = harness.connect();
  const std::string file = folder.path() / "run";
  const auto status = [&] {
    return decode_recording(client->call(ReadRecording{}, kPatience)->data).value();
  };
  EXPECT_EQ(status().state, record::RecordingState::Off);
  EXPECT_EQ(client->call(BeginRecording{"relative", 0, 1, 0}, kPatience).error()[0].code, "R0004");
  EXPECT_EQ(client->call(BeginRecording{"/no/such/folder", 0, 1, 0}, kPatience).error()[0].code, "R0051");
  ASSERT_TRUE(client->call(BeginRecording{file, 0, 1, 10}, kPatience));
  EXPECT_EQ(status().state, record::RecordingState::Recording);
  EXPECT_EQ(client->call(BeginRecording{file, 0, 1, 10}, kPatience).error()[0].code, "R0052");
  ASSERT_TRUE(client->download(support::step_program(), kPatience));
  ASSERT_TRUE(client->call(Start{}, kPatience));
  while (status().scans < 100) std::this_thread::yield();
  ASSERT_TRUE(client->call(EndRecording{}, kPatience));
  while (status().state == record::RecordingState::Recording) std::this_thread::yield();
  EXPECT_EQ(status().state, record::RecordingState::Done);
  EXPECT_EQ(status().file, file);
  EXPECT_GT(std::filesystem::file_size(file), 1'000u);
}

TEST(Monitoring, WhenAnObserverWantsToStepOrRecord_ThenItIsRefused) {
  ServiceHarness harness;
  const auto observer = harness.connect(Role::Observer);
  EXPECT_FALSE(observer->call(Step{1}, kPatience));
  EXPECT_FALSE(observer->call(BeginRecording{"/tmp/x", 0, 1, 0}, kPatience));
  EXPECT_TRUE(observer->call(ReadRecording{}, kPatience));
}

TEST(MonitorAnswers, WhenBytesAreCutOrRandom_ThenTheyAreRefusedOrDecoded) {
  record::RecordingStatus status;
  status.state = record::RecordingState::Failed;
  status.file = "/tmp/run";
  status.problem = "no room";
  status.scans = 1'000;
  const auto bytes = encode_recording(status);
  const auto decoded = decode_recording(bytes);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->problem, status.problem);
  EXPECT_EQ(decoded->scans, status.scans);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_recording(std::span(bytes).first(size))) << size;
  }
  std::mt19937 random(1);
  for (int i = 0; i < 10'000; ++i) {
    std::vector<std::byte> noise(random() % 100);
    for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
    static_cast<void>(decode_recording(noise));
    static_cast<void>(decode_forces(noise));
  }
}

}  // namespace
}  // namespace stepwright::service
