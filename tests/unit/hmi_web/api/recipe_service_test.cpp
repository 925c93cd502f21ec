#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "ladder/driver/compile.h"
#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

class RecipeServiceTest : public testing::Test {
 protected:
  RecipeServiceTest() {
    fixture_.cell.set("mixer.level", "12.5");
    fixture_.cell.set("mixer.stir", "FALSE");
    EXPECT_TRUE(service().save("Blue", "", {{"mixer.level", "20"}, {"mixer.stir", "true"}}, "emil"));
  }
  RecipeService& service() { return *fixture_.service; }
  FakeCell& cell() { return fixture_.cell; }
  // The codes of why it could not be loaded; "" where it was.
  std::string load(const std::string& name = "Blue") {
    const auto loaded = service().load(name);
    std::string codes;
    if (loaded) return codes;
    for (const auto& problem : loaded.error()) codes += (codes.empty() ? "" : " ") + problem.code;
    return codes;
  }
  // As if the file of definitions had been another one when it was saved.
  void keep(const recipes::Values& values) {
    ASSERT_TRUE(fixture_.store->save({"Blue", "", "emil", {}, values}));
  }
  std::string now() { return cell().value("mixer.level") + " " + cell().value("mixer.stir"); }

  RequestGuardFixture fixture_;
};

TEST_F(RecipeServiceTest, WhenARecipeIsLoaded_ThenEveryValueIsWrittenAndBothSidesAreTold) {
  const auto loaded = service().load("Blue");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(now(), "20.0 TRUE");
  EXPECT_EQ(loaded->before, (recipes::Values{{"mixer.level", "12.5"}, {"mixer.stir", "FALSE"}}));
  EXPECT_EQ(loaded->after, (recipes::Values{{"mixer.level", "20.0"}, {"mixer.stir", "TRUE"}}));
}

TEST_F(RecipeServiceTest, WhenAnythingStandsInTheWay_ThenNothingIsWritten) {
  keep({{"mixer.level", "20"}, {"mixer.stir", "2000"}});
  EXPECT_EQ(load(), "H0076");
  keep({{"mixer.level", "100.5"}, {"mixer.stir", "TRUE"}});
  EXPECT_EQ(load(), "H0077");
  keep({{"mixer.level", "20"}});
  EXPECT_EQ(load(), "H0074");
  keep({{"mixer.level", "20"}, {"mixer.stir", "TRUE"}, {"mixer.heat", "1"}});
  EXPECT_EQ(load(), "H0075");
  keep({{"mixer.level", "20"}, {"mixer.stir", "TRUE"}});
  cell().refuse("TRUE");
  EXPECT_EQ(load(), "R0058") << "the program's variable is of another type";
  cell().refuse("none");
  ASSERT_TRUE(fixture_.forces->force({"MIXER.level", "3", std::chrono::minutes(5), "emil", "test"}));
  EXPECT_EQ(load(), "H0079");
  EXPECT_EQ(load("Green"), "H0072");
  EXPECT_EQ(load("../Blue"), "H0071");
  for (const std::string& asked : cell().asked()) EXPECT_FALSE(asked.starts_with("write")) << asked;
  EXPECT_EQ(now(), "12.5 FALSE");
}

TEST_F(RecipeServiceTest, WhenAVariableIsAnEnumeration_ThenItsNamesAreSavedAndLoaded) {
  cell().set("Main.mode", "Off");
  RecipeService modes({{"Main.mode", bytecode::ElementaryType::Int, 0, 9, "", "", {}}}, *fixture_.store,
                      cell(), *fixture_.forces, std::chrono::system_clock::now);
  EXPECT_TRUE(modes.save("Early", "", {{"Main.mode", "Auto"}}, "emil")) << "no program is known yet";
  const auto made =
      driver::compile({.texts = {{"main.st",
                                  "TYPE Mode : (Off, Hand, Auto); END_TYPE\n"
                                  "PROGRAM P VAR mode : Mode; END_VAR END_PROGRAM\n"
                                  "CONFIGURATION C RESOURCE R ON PLC TASK T(INTERVAL := T#10ms);\n"
                                  "PROGRAM Main WITH T : P; END_RESOURCE END_CONFIGURATION"}}});
  ASSERT_TRUE(made) << result::to_string(made.error());
  cell().run(std::make_shared<reader::ProgramInfo>(*reader::ProgramInfo::read(made->container)));
  const auto saved = modes.save("Late", "", {{"Main.mode", "mode#hand"}}, "emil");
  ASSERT_TRUE(saved) << result::to_string(saved.error());
  EXPECT_EQ(saved->after.at("Main.mode"), "Hand");
  EXPECT_FALSE(modes.save("Wrong", "", {{"Main.mode", "Autoo"}}, "emil"));
  ASSERT_TRUE(modes.load("Early"));
  EXPECT_EQ(cell().value("Main.mode"), "Auto");
}

TEST_F(RecipeServiceTest, WhenNobodyAnswers_ThenThatIsTheReason) {
  cell().fail_with("D0001");
  EXPECT_EQ(load(), "D0001");
}

TEST_F(RecipeServiceTest, WhenARecipeIsLoaded_ThenItIsOneWrite) {
  ASSERT_TRUE(service().load("Blue"));
  const auto asked = cell().asked();
  EXPECT_EQ(
      std::count_if(asked.begin(), asked.end(), [](const auto& each) { return each.starts_with("write"); }),
      1);
  EXPECT_EQ(asked.back(), "write mixer.level 20.0 mixer.stir TRUE");
}

TEST_F(RecipeServiceTest, WhenTheWriteIsRefused_ThenNothingIsWrittenAndTheAnswerSaysSo) {
  cell().writes_fail_with("D0004");
  const auto loaded = service().load("Blue");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error()[0].code, "H0080");
  EXPECT_EQ(loaded.error()[0].hint, "no value has been written");
  EXPECT_EQ(now(), "12.5 FALSE");
}

TEST_F(RecipeServiceTest, WhenNobodyAnswersTheWrite_ThenItIsNotSaidThatNothingWasWritten) {
  cell().writes_fail_with("D0001");
  const auto loaded = service().load("Blue");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error()[0].code, "H0080");
  EXPECT_TRUE(loaded.error()[0].hint.starts_with("either all values have been written or none"));
}

TEST_F(RecipeServiceTest, WhenSomebodyElseForcesATag_ThenNothingIsWritten) {
  cell().force_unseen("mixer.stir", "TRUE");
  fixture_.forces->look();
  EXPECT_EQ(load(), "H0079");
  EXPECT_EQ(now(), "12.5 FALSE");
}

TEST_F(RecipeServiceTest, WhenValuesAreWrong_ThenTheyAreNotSaved) {
  const auto saved = service().save("Red", "", {{"mixer.level", "101"}}, "emil");
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().size(), 2u) << "out of range, and one is missing";
  EXPECT_EQ(service().list().size(), 1u);
  EXPECT_FALSE(service().save("../Red", "", {{"mixer.level", "1"}, {"mixer.stir", "TRUE"}}, "emil"));
}

TEST_F(RecipeServiceTest, WhenRecipesAreCompared_ThenWhatMeansTheSameIsTheSame) {
  ASSERT_TRUE(fixture_.store->save({"Raw", "", "", {}, {{"mixer.level", "2E1"}}}));
  const auto rows = service().compare("Blue", "Raw");
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 2u);
  EXPECT_EQ(rows->at(0).left, "20.0");
  EXPECT_EQ(rows->at(0).right, "20.0");
  EXPECT_EQ(rows->at(1).left, "TRUE");
  EXPECT_FALSE(rows->at(1).right);
  EXPECT_EQ(service().compare("Blue", "None").error()[0].code, "H0072");
  const auto present = service().compare_with_present("Blue");
  ASSERT_TRUE(present);
  EXPECT_EQ(present->at(0).left, "20.0");
  EXPECT_EQ(present->at(0).right, "12.5");
}

}  // namespace
}  // namespace stepwright::api
