// A download is answered when its program is kept for the next start, or with the reason why it is not.

#include <gtest/gtest.h>

#include <mutex>
#include <vector>

#include "runtime/host/notifier.h"
#include "runtime/service/digest.h"
#include "runtime/service/server.h"
#include "tests/support/step_program.h"
#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::service {
namespace {

using support::step_program;

// A disk of the test's own: it decides when the test says so.
class SlowPersistence final : public ProgramPersistence {
 public:
  void keep(std::span<const std::byte> container) override {
    const std::lock_guard lock(mutex_);
    kept_.assign(container.begin(), container.end());
    outcome_.reset();
    asked_.notify();
  }
  std::optional<result::Diagnostics> outcome() override {
    decided_.clear();
    const std::lock_guard lock(mutex_);
    return outcome_;
  }
  int descriptor() const override { return decided_.descriptor(); }

  void decide(result::Diagnostics outcome) {
    const std::lock_guard lock(mutex_);
    outcome_ = std::move(outcome);
    decided_.notify();
  }
  void wait_until_asked() { asked_.wait(-1); }
  std::vector<std::byte> kept() {
    const std::lock_guard lock(mutex_);
    return kept_;
  }

 private:
  std::mutex mutex_;
  host::Notifier asked_;
  host::Notifier decided_;
  std::vector<std::byte> kept_;
  std::optional<result::Diagnostics> outcome_ = result::Diagnostics{};
};

result::Diagnostics no_room() {
  return {{"R0027", result::Severity::Warning, {}, "no room", ""}};
}

struct Keeping : testing::Test {
  SlowPersistence persistence;
  ServiceHarness harness{{}, std::chrono::seconds(60), {.persistence = &persistence}};
  std::unique_ptr<Connection> client = harness.connect();
};

TEST_F(Keeping, WhenTheProgramIsKept_ThenTheDownloadIsAnsweredAndNotBefore) {
  std::thread disk([&] {
    persistence.wait_until_asked();
    EXPECT_EQ(persistence.kept(), step_program());
    persistence.decide({});
  });
  const auto reply = client->download(step_program(), host::DownloadMode::Replace, kPatience);
  disk.join();
  ASSERT_TRUE(reply) << result::to_string(reply.error());
  EXPECT_TRUE(reply->problems.empty());
  EXPECT_EQ(reply->digest, to_hex(sha256(step_program())));
}

TEST_F(Keeping, WhenTheDiskRefusesIt_ThenTheProgramIsLoadedAndTheAnswerWarns) {
  std::thread disk([&] {
    persistence.wait_until_asked();
    persistence.decide(no_room());
  });
  const auto reply = client->download(step_program(), host::DownloadMode::Replace, kPatience);
  disk.join();
  ASSERT_TRUE(reply);
  ASSERT_EQ(reply->problems.size(), 1u);
  EXPECT_EQ(reply->problems[0].code, "R0027");
  EXPECT_TRUE(client->call(Start{}, kPatience));
}

TEST_F(Keeping, WhenTheSameProgramIsDownloadedAgain_ThenItsAnswerSaysWhetherItIsKeptByNow) {
  std::thread disk([&] {
    persistence.wait_until_asked();
    persistence.decide(no_room());
  });
  ASSERT_TRUE(client->download(step_program(), host::DownloadMode::Replace, kPatience));
  disk.join();
  EXPECT_EQ(client->download(step_program(), host::DownloadMode::Replace, kPatience)->problems.size(), 1u);
  persistence.decide({});
  EXPECT_TRUE(client->download(step_program(), host::DownloadMode::Replace, kPatience)->problems.empty());
}

TEST_F(Keeping, WhenTheDiskTakesItsTime_ThenOthersAreAnsweredMeanwhileAndTheWaitHasAnEnd) {
  std::thread download([&] {
    const auto reply = client->download(step_program(), host::DownloadMode::Replace, kPatience);
    ASSERT_TRUE(reply);
    ASSERT_EQ(reply->problems.size(), 1u);
    EXPECT_EQ(reply->problems[0].code, "R0027");
  });
  persistence.wait_until_asked();
  const auto other = harness.connect();
  EXPECT_TRUE(other->call(Start{}, kPatience));
  EXPECT_TRUE(other->call(Stop{"done"}, kPatience));
  download.join();
}

}  // namespace
}  // namespace stepwright::service
