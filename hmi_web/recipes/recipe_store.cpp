#include "hmi_web/recipes/recipe_store.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "hmi_web/recipes/codes.h"
#include "hmi_web/recipes/recipe_check.h"
#include "hmi_web/recipes/recipe_text.h"
#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::recipes {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".json";

auto damaged(const fs::path& file, const std::string& what) {
  return result::fail(kRecipeDamaged, {file.string(), 0, 0}, "the file of the recipe is damaged: " + what,
                      "save the recipe anew, or restore its file from a copy");
}

auto unknown(const std::string& name) {
  return result::fail(kNoSuchRecipe, {}, "there is no recipe '" + name + "'",
                      "somebody may have removed it meanwhile");
}

}  // namespace

result::Result<std::unique_ptr<RecipeStore>> RecipeStore::open(fs::path folder) {
  if (auto made = files::make_private_folder(folder, storage::kPrivateFile); !made)
    return result::forward(made);
  return std::unique_ptr<RecipeStore>(new RecipeStore(std::move(folder)));
}

std::vector<std::string> RecipeStore::names() const {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const std::string file = at->path().filename().string();
    if (!file.ends_with(kEnding)) continue;
    std::string name = file.substr(0, file.size() - kEnding.size());
    if (check_name(name)) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

result::Result<Recipe> RecipeStore::read_file(const std::string& name) const {
  const fs::path file = file_of(name);
  std::error_code error;
  const fs::file_status status = fs::symlink_status(file, error);
  if (!fs::exists(status)) return unknown(name);
  // A link would lead out of the folder, a pipe would never end.
  if (!fs::is_regular_file(status)) return damaged(file, "it is no plain file");
  const auto text = files::read_bounded(file, kLargestFile);
  if (!text) return damaged(file, "it cannot be read");
  if (text->size() > kLargestFile)
    return damaged(file, "it is longer than " + std::to_string(kLargestFile) + " bytes");
  auto recipe = recipe_from_json(*text, file.string());
  if (recipe && recipe->name != name) return damaged(file, "it is the recipe '" + recipe->name + "'");
  return recipe;
}

std::vector<RecipeEntry> RecipeStore::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<RecipeEntry> entries;
  for (std::string& name : names()) {
    if (entries.size() == kMostRecipes) break;
    auto recipe = read_file(name);
    entries.push_back({std::move(name), std::move(recipe)});
  }
  return entries;
}

result::Result<Recipe> RecipeStore::read(const std::string& name) const {
  if (auto fits = check_name(name); !fits) return result::forward(fits);
  const std::lock_guard lock(mutex_);
  return read_file(name);
}

result::Result<void> RecipeStore::save(const Recipe& recipe) {
  if (auto fits = check_name(recipe.name); !fits) return fits;
  const std::string text = to_json(recipe);
  // What could not be read again is not written.
  if (auto again = recipe_from_json(text, recipe.name); !again) return result::forward(again);
  if (text.size() > kLargestFile)
    return result::fail(kNoRoomForRecipe, {}, "the recipe is too large", "shorter names of tags");
  const std::lock_guard lock(mutex_);
  const std::vector<std::string> known = names();
  const bool fresh = std::find(known.begin(), known.end(), recipe.name) == known.end();
  if (fresh && known.size() >= kMostRecipes) {
    return result::fail(kNoRoomForRecipe, {},
                        "there are " + std::to_string(known.size()) + " recipes already",
                        "remove one that nobody needs");
  }
  return files::replace_file(file_of(recipe.name), text, storage::kPrivateFile);
}

result::Result<void> RecipeStore::remove(const std::string& name) {
  if (auto fits = check_name(name); !fits) return fits;
  const std::lock_guard lock(mutex_);
  auto removed = files::remove_file(file_of(name), storage::kPrivateFile);
  if (!removed) return result::forward(removed);
  if (!*removed) return unknown(name);
  return {};
}

}  // namespace stepwright::recipes
