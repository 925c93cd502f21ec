#include "cell/hmi/supervisor_word.h"

#include <gtest/gtest.h>

#include <string>

namespace stepwright::hmi {
namespace {

std::string document(const std::string& phase, const std::string& digest = "aa") {
  return R"({"phase": ")" + phase + R"(", "program_digest": ")" + digest +
         R"(", "goal": [{"met": [[[1]]]}]})";
}

TEST(SupervisorWord, WhenItsRunGoesOn_ThenItIsAtWork) {
  for (const char* phase : {"planning", "observing", "executing", "replanning", "waiting", "holding"})
    EXPECT_NE(at_work(document(phase), true, "bb").find(phase), std::string::npos) << phase;
}

TEST(SupervisorWord, WhenItRests_ThenNobodyIsInTheWay) {
  for (const char* phase : {"ready", "held", "done", "safe"})
    EXPECT_EQ(at_work(document(phase), true, "aa"), "");
}

TEST(SupervisorWord, WhenItIsGone_ThenItCountsWhileItsPlanRuns) {
  EXPECT_NE(at_work(document("executing", "aa"), false, "aa"), "");
  EXPECT_EQ(at_work(document("executing", "aa"), false, "bb"), "");
  EXPECT_EQ(at_work(document("executing", ""), false, ""), "");
}

TEST(SupervisorWord, WhenTheDocumentIsAnything_ThenItIsNobodysWork) {
  for (const char* text : {"", "{", "[]", "3", R"({"phase": 3})", R"({"phase": ["executing"]})", "\xff\xfe"})
    EXPECT_EQ(at_work(text, true, "aa"), "") << text;
  EXPECT_EQ(at_work(std::string(100'000, '['), true, "aa"), "");
}

}  // namespace
}  // namespace stepwright::hmi
