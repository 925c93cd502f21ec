#include "supervisor/run/what_if_thread.h"

#include <gtest/gtest.h>

#include <future>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

namespace stepwright::run {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

// What has come of the question once it is no longer being planned.
json answer_of(const WhatIfThread& what_if) {
  for (int k = 0; k < 6'000; ++k) {
    json told = json::parse(what_if.answer());
    if (told.is_object() && told["state"] != "planning") return told;
    std::this_thread::sleep_for(milliseconds(10));
  }
  return json::parse(what_if.answer());
}

std::string code_of(const result::Result<void>& asked) {
  return asked ? "" : asked.error().front().code;
}

TEST(WhatIfThread, WhenNobodyHasAsked_ThenThereIsNothing) {
  WhatIfThread what_if;
  EXPECT_EQ(what_if.answer(), "null");
  EXPECT_EQ(code_of(what_if.cancel("")), "X0008");
}

TEST(WhatIfThread, WhenItIsPlannedFor_ThenTheAnswerHasTheQuestionAndWhatHasComeOfIt) {
  WhatIfThread what_if;
  const std::uint64_t before = what_if.revision();
  ASSERT_TRUE(what_if.ask({"7f", "(in cup1 tray)", true},
                          [](const std::atomic<bool>&) { return R"({"state": "planned", "plan": 3})"; }));
  const json told = answer_of(what_if);
  EXPECT_EQ(told["id"], "7f");
  EXPECT_EQ(told["goal"], "(in cup1 tray)");
  EXPECT_EQ(told["state"], "planned");
  EXPECT_EQ(told["ahead"], true);
  EXPECT_EQ(told["plan"], 3);
  EXPECT_GE(told["wall_ms"], 0.0);
  EXPECT_EQ(what_if.revision(), before + 2) << "once when it began, once when it ended";
}

TEST(WhatIfThread, WhenPlanningThrows_ThenTheQuestionHasFailedAndTheNextOneMayCome) {
  WhatIfThread what_if;
  ASSERT_TRUE(what_if.ask(
      {"a", ""}, [](const std::atomic<bool>&) -> std::string { throw std::runtime_error("too much"); }));
  json told = answer_of(what_if);
  EXPECT_EQ(told["state"], "failed");
  EXPECT_EQ(told["reason"], "too much");
  ASSERT_TRUE(what_if.ask({"b", ""}, [](const std::atomic<bool>&) { return R"({"state": "no_plan"})"; }));
  EXPECT_EQ(answer_of(what_if)["state"], "no_plan");
}

TEST(WhatIfThread, WhenOneIsPlannedFor_ThenAnotherIsRefusedUntilItIsCancelled) {
  WhatIfThread what_if;
  EXPECT_EQ(code_of(what_if.ask({std::string(kMaxWhatIfId + 1, 'x'), ""}, {})), "X0005");
  ASSERT_TRUE(what_if.ask({"one", ""}, [](const std::atomic<bool>& cancel) {
    while (!cancel) std::this_thread::sleep_for(milliseconds(1));
    return R"({"state": "cancelled"})";
  }));
  EXPECT_EQ(code_of(what_if.ask({"two", ""}, {})), "X0008");
  EXPECT_EQ(code_of(what_if.cancel("two")), "X0008") << "that is somebody else's";
  EXPECT_TRUE(what_if.cancel("one"));
  EXPECT_EQ(answer_of(what_if)["id"], "one");
}

TEST(WhatIfThread, WhenItEnds_ThenWhatIsPlannedForIsCancelledAndWaitedFor) {
  std::promise<void> begun;
  bool ended = false;
  {
    WhatIfThread what_if;
    ASSERT_TRUE(what_if.ask({"a", ""}, [&](const std::atomic<bool>& cancel) {
      begun.set_value();
      while (!cancel) std::this_thread::sleep_for(milliseconds(1));
      ended = true;
      return R"({"state": "cancelled"})";
    }));
    begun.get_future().wait();
  }
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace stepwright::run
