#include "cell/gateway/hand_plan.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::gateway {
namespace {

class HandPlanTest : public testing::Test {
 protected:
  result::Result<HandPlan> read(const std::string& text) {
    std::ofstream(file()) << text;
    return read_hand_plan(file());
  }
  std::string refused(const std::string& text) {
    const auto plan = read(text);
    if (plan) return "";
    EXPECT_EQ(plan.error().front().code, "C0566");
    EXPECT_EQ(plan.error().front().where.file, file().string());
    return plan.error().front().message;
  }
  std::filesystem::path file() const { return folder_.path() / "table.json"; }

  service::TemporaryFolder folder_;
};

TEST_F(HandPlanTest, WhenTheTableIsWhole_ThenItIsThePlan) {
  const auto plan = read(R"json({"registers": 1024, "actions": [
      {"number": 1, "action": "(load v1)", "after": []}, {"number": 2, "action": "(go)", "after": [1]}]
})json");
  ASSERT_TRUE(plan) << result::to_string(plan.error());
  EXPECT_EQ(plan->registers, 1'024);
  ASSERT_EQ(plan->actions.size(), 2u);
  EXPECT_EQ(plan->actions[0].text, "(load v1)");
  EXPECT_EQ(plan->actions[1].before, std::vector<std::size_t>{1});
}

TEST_F(HandPlanTest, WhenTheFileIsNotThere_ThenThatIsSaid) {
  const auto plan = read_hand_plan(file());
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().front().message.find("cannot be read"), std::string::npos);
}

// Every kind of value where another one belongs: none of them may end the process.
TEST_F(HandPlanTest, WhenAValueIsOfAnotherKind_ThenItIsRefused) {
  for (const char* value : {"null", "true", "-1", "1.5", "\"1\"", "[]", "{}", "18446744073709551616"}) {
    const std::string text = value;
    EXPECT_NE(refused(text), "") << text;
    EXPECT_NE(refused("{\"registers\": " + text + ", \"actions\": [{\"number\": 1, \"after\": []}]}"), "")
        << text;
    EXPECT_NE(refused("{\"registers\": 1, \"actions\": " + text + "}"), "") << text;
    EXPECT_NE(refused("{\"registers\": 1, \"actions\": [" + text + "]}"), "") << text;
    EXPECT_NE(refused("{\"registers\": 1, \"actions\": [{\"number\": " + text + ", \"after\": []}]}"), "")
        << text;
    EXPECT_NE(refused("{\"registers\": 1, \"actions\": [{\"number\": 1, \"after\": [" + text + "]}]}"), "")
        << text;
    if (text == "\"1\"") continue;  // an action has a text
    EXPECT_NE(refused("{\"registers\": 1, \"actions\": [{\"number\": 1, \"action\": " + text +
                      ", \"after\": []}]}"),
              "")
        << text;
  }
}

TEST_F(HandPlanTest, WhenTheRegistersGoBeyondTheLast_ThenTheyAreRefused) {
  const std::string actions = ", \"actions\": [{\"number\": 1, \"after\": []}]}";
  EXPECT_EQ(refused("{\"registers\": 65531" + actions), "");
  EXPECT_NE(refused("{\"registers\": 65532" + actions), "");
  EXPECT_NE(refused("{\"registers\": 66560" + actions), "") << "it is not register 1024";
}

}  // namespace
}  // namespace stepwright::gateway
