// One supervisor at a time, and only that of this runtime: another one of its name is another one.

#include <gtest/gtest.h>

#include <atomic>

#include "runtime/dds/runtime_client.h"
#include "tests/support/patience.h"
#include "tests/unit/runtime/dds/fake_link.h"
#include "tests/unit/runtime/dds/test_runtime_id.h"

namespace stepwright::dds {
namespace {

using namespace std::chrono_literals;

using support::kPatience;

// Counts what reaches the runtime.
struct Counted {
  std::atomic<int> requests{0};
  FakeLink::Handler handler() {
    return [this](const service::Request&) {
      ++requests;
      return service::Reply{};
    };
  }
};

std::unique_ptr<RuntimeClient> join(std::uint32_t domain, ClientRole role, const std::string& name,
                                    const std::string& place = {}) {
  auto client = RuntimeClient::connect({domain, name, test_runtime_id(), {"127.0.0.1"}, {}, place}, role);
  EXPECT_TRUE(client);
  return client ? std::move(*client) : nullptr;
}

// The link publishes its beacon only when it is asked to.
bool told_of(FakeLink& link, FakeLink& other, const std::string& place) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    other.endpoint().announce();
    const auto places = link.endpoint().namesakes();
    if (places == std::vector<std::string>{place}) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(WhoDrives, WhenASupervisorHasTheRuntime_ThenAnotherIsRefusedByNameAndDisturbsNothing) {
  Counted counted;
  FakeLink link(47, counted.handler());
  const auto first = join(47, ClientRole::Supervisor, "first");
  ASSERT_TRUE(first->wait_for_runtime(kPatience));
  ASSERT_TRUE(first->claim());
  const auto second = join(47, ClientRole::Supervisor, "second");
  ASSERT_TRUE(second->wait_for_runtime(kPatience));
  const int before = counted.requests;
  for (const auto& refused : {second->claim(), second->stop("mine now"), second->start({})}) {
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().front().code, kHeldByAnother);
    EXPECT_NE(refused.error().front().message.find("'first'"), std::string::npos)
        << result::to_string(refused.error());
  }
  EXPECT_EQ(counted.requests, before);
  EXPECT_TRUE(first->start({}));
  EXPECT_TRUE(link.endpoint().supervisor_alive());
  // Who looks, or operates the page, is no supervisor.
  const auto viewer = join(47, ClientRole::Viewer, "viewer");
  EXPECT_TRUE(viewer->stop("a person says so"));
}

TEST(WhoDrives, WhenTheSupervisorIsGone_ThenTheNextOneHasTheRuntime) {
  Counted counted;
  FakeLink link(48, counted.handler());
  auto first = join(48, ClientRole::Supervisor, "first");
  ASSERT_TRUE(first->claim());
  const auto second = join(48, ClientRole::Supervisor, "second");
  ASSERT_TRUE(second->wait_for_runtime(kPatience));
  first.reset();
  EXPECT_TRUE(second->claim());  // asked again until the first one is known to be gone
  EXPECT_TRUE(link.endpoint().supervisor_alive());
}

TEST(WhoDrives, WhenTwoRuntimesHaveOneName_ThenEachIsReachedByItsOwnClientsAndKnowsOfTheOther) {
  Counted here;
  Counted there;
  FakeLink ours(49, here.handler(), test_runtime_id(), "host:/here");
  FakeLink theirs(49, there.handler(), test_runtime_id(), "host:/there");
  const auto supervisor = join(49, ClientRole::Supervisor, "ours", "host:/here");
  ASSERT_TRUE(supervisor->wait_for_runtime(kPatience));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(supervisor->start({}));
  EXPECT_EQ(here.requests, 20);
  EXPECT_EQ(there.requests, 0);
  EXPECT_FALSE(theirs.endpoint().supervisor_alive());
  EXPECT_TRUE(told_of(ours, theirs, "host:/there"));
  EXPECT_TRUE(told_of(theirs, ours, "host:/here"));
}

TEST(WhoDrives, WhenTheRuntimeOfTheNameLivesElsewhere_ThenTheClientIsToldWhere) {
  Counted counted;
  FakeLink link(50, counted.handler(), test_runtime_id(), "host:/there");
  const auto lost = join(50, ClientRole::Supervisor, "lost", "host:/here");
  const auto any = join(50, ClientRole::Viewer, "any");
  EXPECT_TRUE(any->wait_for_runtime(kPatience));
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  std::string told;
  while (told.find("host:/there") == std::string::npos && std::chrono::steady_clock::now() < deadline) {
    link.endpoint().announce();
    const auto refused = lost->start({});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().front().code, "D0001");
    told = refused.error().front().hint;
  }
  EXPECT_NE(told.find("host:/there"), std::string::npos) << told;
  EXPECT_EQ(counted.requests, 0);
}

}  // namespace
}  // namespace stepwright::dds
