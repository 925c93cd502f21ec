#include "runtime/dds/plan_channel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/patience.h"
#include "tests/unit/runtime/dds/test_runtime_id.h"

namespace stepwright::dds {
namespace {

using namespace std::chrono_literals;

using support::kPatience;

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

TEST(PlanChannel, WhenThereAreSeveralDocuments_ThenEachHasItsOwnPlace) {
  auto publisher = *PlanPublisher::create({59, "supervisor", test_runtime_id()});
  ASSERT_TRUE(publisher->publish_goal_form("form"));
  ASSERT_TRUE(publisher->publish_outlook("outlook"));
  ASSERT_TRUE(publisher->publish_pictures("pictures"));
  ASSERT_TRUE(publisher->publish("plan"));
  auto subscriber = *PlanSubscriber::create({59, "hmi", test_runtime_id()});
  EXPECT_EQ(subscriber->wait_newer(kPatience), "plan");
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  const auto complete = [&] {
    return subscriber->goal_form() && subscriber->outlook() && subscriber->pictures();
  };
  while (!complete() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(5ms);
  EXPECT_EQ(subscriber->goal_form(), "form");
  EXPECT_EQ(subscriber->outlook(), "outlook");
  EXPECT_EQ(subscriber->pictures(), "pictures");
  EXPECT_EQ(publisher->publish_pictures(std::string(kMaxPicturesBytes + 1, ' ')).error().front().code,
            "D0004");
  EXPECT_EQ(publisher->publish_outlook(std::string(kMaxGoalDocumentBytes + 1, ' ')).error().front().code,
            "D0004");
}

// A supervisor that answers as the text of a request wants it.
class Answering {
 public:
  explicit Answering(std::uint32_t domain)
      : publisher_(*PlanPublisher::create({domain, "supervisor", test_runtime_id()})),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  std::vector<std::string> stop() {
    thread_.request_stop();
    thread_.join();
    return asked_;
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto request = publisher_->wait_request(10ms);
      if (!request) continue;
      asked_.push_back(request->text);
      if (request->text == "silence") continue;
      result::Result<void> verdict;
      if (request->text.starts_with("no"))
        verdict = result::fail("X0003", {"goal", 3, 7}, "not " + request->text, "ask for something else");
      (void)publisher_->answer(*request, verdict);
    }
  }

  std::unique_ptr<PlanPublisher> publisher_;
  std::vector<std::string> asked_;
  std::jthread thread_;
};

std::unique_ptr<PlanSubscriber> matched_subscriber(std::uint32_t domain) {
  auto subscriber = *PlanSubscriber::create({domain, "hmi", test_runtime_id()});
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  // The first answer may come before both sides know each other.
  while (!subscriber->request("first", 200ms) && std::chrono::steady_clock::now() < deadline) {
  }
  return subscriber;
}

TEST(PlanChannel, WhenAViewerAsks_ThenTheSupervisorGetsEveryRequestInOrderAndAnswers) {
  Answering supervisor(53);
  auto subscriber = matched_subscriber(53);
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!subscriber->supervisor_alive() && std::chrono::steady_clock::now() < deadline) {
  }
  EXPECT_TRUE(subscriber->supervisor_alive());
  for (int i = 1; i < 10; ++i) EXPECT_TRUE(subscriber->request(std::to_string(i), kPatience));
  std::vector<std::string> asked = supervisor.stop();
  std::erase(asked, "first");
  EXPECT_EQ(asked, (std::vector<std::string>{"1", "2", "3", "4", "5", "6", "7", "8", "9"}));
}

TEST(PlanChannel, WhenARequestIsRefused_ThenTheReasonArrivesWithItsPlace) {
  Answering supervisor(56);
  auto subscriber = matched_subscriber(56);
  const auto refused = subscriber->request("no way", kPatience);
  ASSERT_FALSE(refused);
  ASSERT_EQ(refused.error().size(), 1u);
  const result::Diagnostic& problem = refused.error().front();
  EXPECT_EQ(problem.code, "X0003");
  EXPECT_EQ(problem.message, "not no way");
  EXPECT_EQ(problem.hint, "ask for something else");
  EXPECT_EQ(problem.where.line, 3u);
  EXPECT_EQ(problem.where.column, 7u);
  EXPECT_TRUE(subscriber->request("then this", kPatience));
}

// Who asked with a long goal does not need all of it back.
TEST(PlanChannel, WhenAnAnswerIsLong_ThenItsBeginningArrives) {
  const auto publisher = *PlanPublisher::create({60, "supervisor", test_runtime_id()});
  const std::jthread supervisor([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto request = publisher->wait_request(10ms);
      if (!request) continue;
      result::Result<void> verdict;
      if (request->text != "first") {
        const result::Diagnostic problem{"X0003", result::Severity::Error, {}, std::string(10'000, 'x'), ""};
        verdict = tl::unexpected(result::Diagnostics(100, problem));
      }
      (void)publisher->answer(*request, verdict);
    }
  });
  const auto refused = matched_subscriber(60)->request("no", kPatience);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().size(), 16u);
  EXPECT_EQ(refused.error().front().message, std::string(4'096, 'x'));
}

TEST(PlanChannel, WhenSeveralAskAtOnce_ThenEachGetsItsOwnAnswer) {
  Answering supervisor(57);
  auto one = matched_subscriber(57);
  auto other = matched_subscriber(57);
  std::atomic<int> wrong{0};
  const auto ask = [&](PlanSubscriber& by, const std::string& text) {
    for (int i = 0; i < 20; ++i) {
      const auto answer = by.request(text + std::to_string(i), kPatience);
      const bool refused = !answer && answer.error().front().message == "not " + text + std::to_string(i);
      if (text.starts_with("no") ? !refused : !answer) ++wrong;
    }
  };
  {
    const std::jthread a([&] { ask(*one, "yes"); });
    const std::jthread b([&] { ask(*one, "no"); });
    const std::jthread c([&] { ask(*other, "no, thank you"); });
  }
  EXPECT_EQ(wrong, 0);
}

TEST(PlanChannel, WhenTheSupervisorDoesNotAnswer_ThenItIsSaidThatItMayObeyAllTheSame) {
  Answering supervisor(58);
  auto subscriber = matched_subscriber(58);
  const auto refused = subscriber->request("silence", 100ms);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "D0007");
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
