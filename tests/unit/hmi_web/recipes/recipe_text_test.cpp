#include "hmi_web/recipes/recipe_text.h"

#include <gtest/gtest.h>

#include <string>

namespace stepwright::recipes {
namespace {

const std::string kGood = R"({"format": 1, "name": "Blue", "comment": "c", "saved_by": "ada", "saved_s": 5,
"values": {"a": "1"}})";

std::string with(std::string what, const std::string& by) {
  std::string text = kGood;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(RecipeText, WhenARecipeIsWrittenAndRead_ThenItIsTheSame) {
  const Recipe recipe{"Blue 20 l",
                      "für das kleine Fass \"x\"",
                      "ada",
                      std::chrono::system_clock::time_point(std::chrono::seconds(1'700'000'000)),
                      {{"mixer.level", "20.5"}, {"%QX0.1", "TRUE"}}};
  const auto again = recipe_from_json(to_json(recipe), "f");
  ASSERT_TRUE(again) << result::to_string(again.error());
  EXPECT_EQ(again->name, recipe.name);
  EXPECT_EQ(again->comment, recipe.comment);
  EXPECT_EQ(again->saved_by, recipe.saved_by);
  EXPECT_EQ(again->saved, recipe.saved);
  EXPECT_EQ(again->values, recipe.values);
}

TEST(RecipeText, WhenAFileIsNotWhatWasWritten_ThenItIsRefusedWithItsPlace) {
  ASSERT_TRUE(recipe_from_json(kGood, "f"));
  const std::vector<std::string> wrong = {"",
                                          "[]",
                                          "null",
                                          "{}",
                                          kGood + "x",
                                          kGood.substr(0, 40),
                                          with("\"format\": 1", "\"format\": 2"),
                                          with("\"Blue\"", "\"../Blue\""),
                                          with("\"Blue\"", "7"),
                                          with("\"c\"", "\"" + std::string(201, 'c') + "\""),
                                          with("\"ada\"", "null"),
                                          with("5", "-5"),
                                          with("5", "5.5"),
                                          with("5", "99999999999999999"),
                                          with("5", "1e999"),
                                          with("\"1\"", "1"),
                                          with("\"1\"", "\"" + std::string(65, '1') + "\""),
                                          with("{\"a\": \"1\"}", "[]"),
                                          with("{\"a\": \"1\"}", "{\"\": \"1\"}"),
                                          with("{\"a\": \"1\"}", "{\"a\": \"1\", \"a\": \"2\"}"),
                                          with("\"saved_s\"", "\"name\""),
                                          with("\"saved_s\": 5,", "\"saved_s\": 5, \"more\": 1,"),
                                          with("\"1\"", "\"\xff\"")};
  for (const std::string& text : wrong) {
    const auto read = recipe_from_json(text, "f");
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error()[0].code, "H0078") << text;
    EXPECT_EQ(read.error()[0].where.file, "f");
    EXPECT_GT(read.error()[0].where.line, 0u) << text;
    EXPECT_GT(read.error()[0].where.column, 0u) << text;
  }
  const auto value = recipe_from_json(with("{\"a\": \"1\"}", "[]"), "f");
  EXPECT_EQ(value.error()[0].where.line, 2u) << "where its key stands";
  EXPECT_EQ(value.error()[0].where.column, 1u);
}

TEST(RecipeText, WhenThereAreTooManyValuesOrTooDeepOnes_ThenTheFileIsRefused) {
  std::string many;
  for (std::size_t i = 0; i <= kMostTags; ++i)
    many += (i == 0 ? "\"a" : ", \"a") + std::to_string(i) + "\": \"1\"";
  EXPECT_FALSE(recipe_from_json(with("\"a\": \"1\"", many), "f"));
  EXPECT_FALSE(recipe_from_json(with("\"1\"", std::string(50'000, '[')), "f"));
  EXPECT_FALSE(recipe_from_json(with("\"1\"", std::string(20'000, '[') + std::string(20'000, ']')), "f"));
}

}  // namespace
}  // namespace stepwright::recipes
