// Online change as a client of the service meets it.

#include <gtest/gtest.h>

#include "runtime/service/digest.h"
#include "runtime/service/server.h"
#include "tests/support/step_program.h"
#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::service {
namespace {

using host::DownloadMode;
using host::EventKind;
using host::RuntimeStatus;
using host::StepEvent;
using support::step_program;

TEST(ChangeService, WhenAProgramRuns_ThenADownloadCanTakeOverFromIt) {
  ServiceHarness harness;
  const auto client = harness.connect();
  const auto first = step_program();
  const auto second = step_program({.steps = 5});
  ASSERT_TRUE(client->download(first, kPatience));
  ASSERT_TRUE(client->call(Start{true}, kPatience));
  EXPECT_EQ(next<StepEvent>(*client)->kind, EventKind::Started);
  EXPECT_EQ(next<StepEvent>(*client)->kind, EventKind::StepChange);
  const auto reply = client->download(second, DownloadMode::Change, kPatience);
  ASSERT_TRUE(reply) << result::to_string(reply.error());
  EXPECT_EQ(reply->digest, to_hex(sha256(second)));
  EXPECT_GT(reply->change.pause_us, 0.0);
  ASSERT_FALSE(reply->problems.empty());
  EXPECT_EQ(reply->problems[0].code, "R0037");
  const auto changed = next<StepEvent>(*client);
  EXPECT_EQ(changed->kind, EventKind::Changed);
  EXPECT_EQ(changed->program_digest, reply->digest);
  EXPECT_EQ(changed->detail, "from " + to_hex(sha256(first)) + " to " + reply->digest);
  const auto part = client->call(ReadProgram{0}, kPatience);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->data, second);
  EXPECT_EQ(part->digest, reply->digest);
  const auto status = status_when(*client, [](const RuntimeStatus& s) { return s.changes == 1; });
  ASSERT_TRUE(status);
  EXPECT_EQ(status->state, host::RuntimeState::Running);
  EXPECT_EQ(status->last_change_pause_us, reply->change.pause_us);
}

TEST(ChangeService, WhenNothingRuns_ThenTheReplySaysSoAndADownloadIsPossible) {
  ServiceHarness harness;
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program(), kPatience));
  const auto refused = client->download(step_program(), DownloadMode::Change, kPatience);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "R0031");
  EXPECT_TRUE(client->download(step_program(), DownloadMode::Replace, kPatience));
}

TEST(ChangeService, WhenTheContainerIsDamaged_ThenTheRunningProgramGoesOn) {
  ServiceHarness harness;
  const auto client = harness.connect();
  const auto first = step_program();
  ASSERT_TRUE(client->download(first, kPatience));
  ASSERT_TRUE(client->call(Start{false}, kPatience));
  auto damaged = step_program({.steps = 5});
  damaged[damaged.size() / 2] ^= std::byte{1};
  EXPECT_FALSE(client->download(damaged, DownloadMode::ChangeRestartCharts, kPatience));
  const auto part = client->call(ReadProgram{0}, kPatience);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->data, first);
}

}  // namespace
}  // namespace stepwright::service
