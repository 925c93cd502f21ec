#include "hmi_web/recipes/recipe_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hmi_web/recipes/recipe_text.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::recipes {
namespace {

namespace fs = std::filesystem;

Recipe recipe(const std::string& name, const std::string& value = "1") {
  return {name, "", "ada", {}, {{"a", value}}};
}

class RecipeStoreTest : public testing::Test {
 protected:
  std::string code(const std::string& name) {
    const auto read = store_->read(name);
    return read ? "" : read.error()[0].code;
  }
  void write(const std::string& file, const std::string& text) { std::ofstream(dir_ / file) << text; }

  support::TemporaryFolder folder_;
  fs::path dir_ = folder_ / "recipes";
  std::unique_ptr<RecipeStore> store_ = *RecipeStore::open(dir_);
};

TEST_F(RecipeStoreTest, WhenARecipeIsSaved_ThenAnotherServerReadsItAndNobodyElse) {
  ASSERT_TRUE(store_->save(recipe("Blue 20 l")));
  ASSERT_TRUE(store_->save(recipe("Blue 20 l", "2"))) << "in place of the first";
  const auto other = *RecipeStore::open(dir_);
  const auto read = other->read("Blue 20 l");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->values.at("a"), "2");
  ASSERT_EQ(other->list().size(), 1u);
  struct stat file {};
  ASSERT_EQ(::stat((dir_ / "Blue 20 l.json").c_str(), &file), 0);
  EXPECT_EQ(file.st_mode & 0777, 0600u);
  ASSERT_EQ(::stat(dir_.c_str(), &file), 0);
  EXPECT_EQ(file.st_mode & 0777, 0700u);
}

TEST_F(RecipeStoreTest, WhenARecipeIsRemoved_ThenItIsGone) {
  ASSERT_TRUE(store_->save(recipe("a")));
  ASSERT_TRUE(store_->remove("a"));
  EXPECT_EQ(code("a"), "H0072");
  EXPECT_EQ(store_->remove("a").error()[0].code, "H0072");
  EXPECT_TRUE(store_->list().empty());
}

TEST_F(RecipeStoreTest, WhenANameLeadsElsewhere_ThenNothingIsTouched) {
  write("../secret.json", to_json(recipe("secret")));
  for (const char* name : {"../secret", "..", "recipes/../../secret", ""}) {
    EXPECT_EQ(code(name), "H0071") << name;
    EXPECT_EQ(store_->remove(name).error()[0].code, "H0071");
    EXPECT_EQ(store_->save(recipe(name)).error()[0].code, "H0071");
  }
  EXPECT_TRUE(fs::exists(folder_ / "secret.json"));
}

TEST_F(RecipeStoreTest, WhenAFileIsNotToBeBelieved_ThenItIsToldAndTheOthersAreThere) {
  ASSERT_TRUE(store_->save(recipe("good")));
  write("cut.json", to_json(recipe("cut")).substr(0, 30));
  write("other.json", to_json(recipe("good")));
  write("long.json", std::string(kLargestFile + 1, ' '));
  write("../outside.json", to_json(recipe("link")));
  fs::create_symlink(folder_ / "outside.json", dir_ / "link.json");
  fs::create_directory(dir_ / "folder.json");
  write("notes.txt", "no recipe");
  write(".hidden.json", "no recipe");
  ASSERT_EQ(::mkfifo((dir_ / "pipe.json").c_str(), 0600), 0);
  std::string told;
  for (const RecipeEntry& entry : store_->list())
    told += entry.name + (entry.recipe ? " " : " " + entry.recipe.error()[0].code + " ");
  EXPECT_EQ(told, "cut H0078 folder H0078 good link H0078 long H0078 other H0078 pipe H0078 ");
  ASSERT_TRUE(store_->remove("cut")) << "a damaged one can be removed";
  ASSERT_TRUE(store_->save(recipe("other"))) << "and written over";
  EXPECT_EQ(code("other"), "");
}

TEST_F(RecipeStoreTest, WhenThereAreAsManyAsMayBe_ThenOneMoreIsRefusedAndOldOnesAreReplaced) {
  for (std::size_t i = 0; i < kMostRecipes; ++i)
    write("r" + std::to_string(i) + ".json", to_json(recipe("r" + std::to_string(i))));
  EXPECT_EQ(store_->save(recipe("one more")).error()[0].code, "H0073");
  EXPECT_TRUE(store_->save(recipe("r7", "8")));
  EXPECT_EQ(store_->list().size(), kMostRecipes);
}

TEST_F(RecipeStoreTest, WhenTheFolderIsGone_ThenSavingSaysSo) {
  fs::remove_all(dir_);
  EXPECT_EQ(store_->save(recipe("a")).error()[0].code, "H0021");
  EXPECT_TRUE(store_->list().empty());
}

}  // namespace
}  // namespace stepwright::recipes
