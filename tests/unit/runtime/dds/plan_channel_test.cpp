#include "runtime/dds/plan_channel.h"

#include <gtest/gtest.h>

#include "tests/unit/runtime/dds/test_runtime_id.h"

namespace stepwright::dds {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 20s;

TEST(PlanChannel, WhenAViewerJoinsLate_ThenItGetsTheNewestDocument) {
  auto publisher = *PlanPublisher::create({51, "supervisor", test_runtime_id()});
  ASSERT_TRUE(publisher->publish(R"({"revision":1})"));
  const std::string large = "{\"text\":\"" + std::string(300'000, 'x') + "\"}";
  ASSERT_TRUE(publisher->publish(large));
  auto subscriber = *PlanSubscriber::create({51, "hmi", test_runtime_id()});
  const auto document = subscriber->wait_newer(kPatience);
  ASSERT_TRUE(document);
  EXPECT_EQ(*document, large);
  EXPECT_EQ(subscriber->latest(), large);
  EXPECT_FALSE(subscriber->wait_newer(1ms));
}

TEST(PlanChannel, WhenADocumentIsReplaced_ThenViewersSeeTheNewOne) {
  auto publisher = *PlanPublisher::create({52, "supervisor", test_runtime_id()});
  auto subscriber = *PlanSubscriber::create({52, "hmi", test_runtime_id()});
  ASSERT_TRUE(publisher->publish("first"));
  ASSERT_EQ(subscriber->wait_newer(kPatience), "first");
  ASSERT_TRUE(publisher->publish("second"));
  EXPECT_EQ(subscriber->wait_newer(kPatience), "second");
}

TEST(PlanChannel, WhenAViewerAsks_ThenTheSupervisorGetsEveryRequestInOrder) {
  auto publisher = *PlanPublisher::create({53, "supervisor", test_runtime_id()});
  auto subscriber = *PlanSubscriber::create({53, "hmi", test_runtime_id()});
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!subscriber->request("0") && std::chrono::steady_clock::now() < deadline) {
  }
  while (!subscriber->supervisor_alive() && std::chrono::steady_clock::now() < deadline) {
  }
  EXPECT_TRUE(subscriber->supervisor_alive());
  for (int i = 1; i < 10; ++i) ASSERT_TRUE(subscriber->request(std::to_string(i)));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(publisher->wait_request(kPatience), std::to_string(i));
  EXPECT_FALSE(publisher->wait_request(1ms));
}

TEST(PlanChannel, WhenNoSupervisorIsThere_ThenARequestFails) {
  auto subscriber = *PlanSubscriber::create({54, "hmi", test_runtime_id()});
  const auto refused = subscriber->request("{}");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "D0001");
  EXPECT_FALSE(subscriber->supervisor_alive());
}

TEST(PlanChannel, WhenATextIsTooLong_ThenItIsRefused) {
  auto publisher = *PlanPublisher::create({55, "supervisor", test_runtime_id()});
  auto subscriber = *PlanSubscriber::create({55, "hmi", test_runtime_id()});
  EXPECT_EQ(publisher->publish(std::string(kMaxPlanDocumentBytes + 1, ' ')).error().front().code, "D0004");
  EXPECT_EQ(subscriber->request(std::string(kMaxOperatorRequestBytes + 1, ' ')).error().front().code,
            "D0004");
}

}  // namespace
}  // namespace stepwright::dds
