#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "runtime/ground/files/durable_file.h"
#include "runtime/ground/files/files.h"
#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

constexpr const char* kBlue =
    R"({"values": {"mixer.level": "20", "mixer.stir": "TRUE"}, "comment": "small"})";

class RecipeRoutesTest : public testing::Test {
 protected:
  RecipeRoutesTest() {
    fixture_.cell.set("mixer.level", "12.5");
    fixture_.cell.set("mixer.stir", "FALSE");
  }
  Answer ask(const std::string& method, const std::string& target, const std::string& body = {},
             Role role = Role::Engineer) {
    return fixture_.ask(method, target, body, fixture_.session(role));
  }
  json get(const std::string& target) {
    const Answer answer = ask("GET", target, {}, Role::Viewer);
    EXPECT_EQ(answer.status, 200u) << answer.text;
    return json::parse(answer.text);
  }
  json last_of_trail() {
    std::istringstream lines(files::read_file(fixture_.audit->file()).value());
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    return json::parse(last);
  }
  RequestGuardFixture fixture_;
};

TEST_F(RecipeRoutesTest, WhenARecipeIsSaved_ThenItIsThereAndTheTrailHasBothSides) {
  EXPECT_EQ(ask("PUT", "/api/recipes/Blue%2020", kBlue).status, 200u);
  const json one = get("/api/recipes/Blue%2020");
  EXPECT_EQ(one["values"], (json{{"mixer.level", "20.0"}, {"mixer.stir", "TRUE"}}));
  EXPECT_EQ(one["comment"], "small");
  EXPECT_EQ(one["saved_by"], "engineer");
  EXPECT_EQ(get("/api/recipes")["recipes"][0]["name"], "Blue 20");
  EXPECT_EQ(ask("PUT", "/api/recipes/Blue%2020", R"({"values": {"mixer.level": "30", "mixer.stir": "TRUE"}})")
                .status,
            200u);
  const json entry = last_of_trail();
  EXPECT_EQ(entry["action"], "recipe.save");
  EXPECT_EQ(entry["target"], "Blue 20");
  EXPECT_EQ(entry["before"], "mixer.level = 20.0, mixer.stir = TRUE");
  EXPECT_EQ(entry["after"], "mixer.level = 30.0, mixer.stir = TRUE");
  EXPECT_EQ(entry["result"], "done");
}

TEST_F(RecipeRoutesTest, WhenAnOperatorLoads_ThenTheProgramHasTheValuesAndTheTrailTheOldOnes) {
  ASSERT_EQ(ask("PUT", "/api/recipes/Blue", kBlue).status, 200u);
  EXPECT_EQ(ask("POST", "/api/recipes/Blue/load", "{}", Role::Operator).status, 400u) << "without a reason";
  EXPECT_EQ(ask("POST", "/api/recipes/Blue/load", R"({"reason": "next batch"})", Role::Operator).status,
            200u);
  EXPECT_EQ(fixture_.cell.value("mixer.level"), "20.0");
  const json entry = last_of_trail();
  EXPECT_EQ(entry["action"], "recipe.load");
  EXPECT_EQ(entry["user"], "operator");
  EXPECT_EQ(entry["before"], "mixer.level = 12.5, mixer.stir = FALSE");
  EXPECT_EQ(entry["after"], "mixer.level = 20.0, mixer.stir = TRUE");
  EXPECT_EQ(entry["reason"], "next batch");
}

TEST_F(RecipeRoutesTest, WhenSomethingIsWrong_ThenTheStatusSaysWhat) {
  ASSERT_EQ(ask("PUT", "/api/recipes/Blue", kBlue).status, 200u);
  const auto save = [&](const std::string& values) {
    return ask("PUT", "/api/recipes/Blue", R"({"values": )" + values + "}");
  };
  const Answer two = save(R"({"mixer.level": "200", "mixer.stir": "often"})");
  EXPECT_EQ(two.status, 400u);
  EXPECT_EQ(json::parse(two.text)["problems"].size(), 2u) << "all at once: " << two.text;
  for (const char* values : {"{}", "[]", "\"x\"", R"({"mixer.level": 20, "mixer.stir": "TRUE"})",
                             R"({"mixer.level": {"a": "b"}})", R"({"mixer.level": "1", "mixer.level": "2"})"})
    EXPECT_EQ(save(values).status, 400u) << values;
  EXPECT_EQ(ask("PUT", "/api/recipes/..%2Fusers", kBlue).status, 400u);
  EXPECT_EQ(ask("GET", "/api/recipes/Green").status, 404u);
  EXPECT_EQ(ask("DELETE", "/api/recipes/Green").status, 404u);
  EXPECT_EQ(last_of_trail()["result"], "refused: H0072: there is no recipe 'Green'");
  fixture_.cell.writes_fail_with("D0002");
  EXPECT_EQ(ask("POST", "/api/recipes/Blue/load", R"({"reason": "next batch"})").status, 409u);
  EXPECT_EQ(ask("DELETE", "/api/recipes/Blue").status, 200u);
  EXPECT_EQ(last_of_trail()["before"], "mixer.level = 20.0, mixer.stir = TRUE");
  EXPECT_TRUE(get("/api/recipes")["recipes"].empty());
}

TEST_F(RecipeRoutesTest, WhenSidesAreCompared_ThenEachTagHasItsState) {
  ASSERT_EQ(ask("PUT", "/api/recipes/Blue", kBlue).status, 200u);
  ASSERT_EQ(ask("PUT", "/api/recipes/Red", R"({"values": {"mixer.level": "2E1", "mixer.stir": "0"}})").status,
            200u);
  const json other = get("/api/recipes/Blue/compare?with=Red");
  EXPECT_EQ(other["differing"], 1);
  EXPECT_EQ(other["rows"][0]["state"], "same");
  EXPECT_EQ(other["rows"][1],
            (json{{"tag", "mixer.stir"}, {"left", "TRUE"}, {"right", "FALSE"}, {"state", "differs"}}));
  const json now = get("/api/recipes/Blue/compare");
  EXPECT_EQ(now["rows"][0]["right"], "12.5");
  EXPECT_EQ(now["differing"], 2);
  const json tags = get("/api/recipe-tags")["tags"];
  EXPECT_EQ(tags[0], (json{{"name", "mixer.level"},
                           {"type", "REAL"},
                           {"unit", "%"},
                           {"comment", "how full"},
                           {"min", 0.0},
                           {"max", 100.0},
                           {"value", "12.5"}}));
  EXPECT_FALSE(tags[1].contains("min"));
}

TEST_F(RecipeRoutesTest, WhenAFileIsDamaged_ThenTheListSaysSo) {
  ASSERT_TRUE(files::replace_file(fixture_.folder / "recipes/Bad.json", "{", {"H0021"}));
  ASSERT_TRUE(fixture_.store->save({"Old", "", "", {}, {{"mixer.level", "500"}}}));
  const json list = get("/api/recipes")["recipes"];
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["name"], "Bad");
  EXPECT_EQ(list[0]["problems"].size(), 1u);
  EXPECT_EQ(list[1]["problems"].size(), 2u) << "out of range, and one is missing: " << list[1];
  EXPECT_EQ(ask("GET", "/api/recipes/Bad").status, 409u);
}

TEST_F(RecipeRoutesTest, WhenTheProgramWouldRefuseAValue_ThenTheListSaysSo) {
  ASSERT_EQ(ask("PUT", "/api/recipes/Blue", kBlue).status, 200u);
  EXPECT_EQ(get("/api/recipes/Blue")["problems"].size(), 0u);
  fixture_.cell.refuse("TRUE");
  EXPECT_EQ(get("/api/recipes/Blue")["problems"].size(), 1u);
  fixture_.cell.fail_with("D0001");
  EXPECT_EQ(get("/api/recipes/Blue")["problems"].size(), 0u) << "nobody knows while no runtime answers";
}

TEST(RecipeRoutes, WhenTheServerHasNone_ThenEveryRowSaysSo) {
  for (const Route& row : recipe_routes({})) {
    const Answer answer = row.handler({});
    EXPECT_EQ(answer.status, 404u) << row.name;
    EXPECT_EQ(json::parse(answer.text)["problems"][0]["code"], "H0070");
  }
}

}  // namespace
}  // namespace stepwright::api
