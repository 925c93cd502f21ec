#pragma once

// The recipes of a cell, each a file of its own in one folder (mode 0700, files 0600).
//
//   auto store = RecipeStore::open("cell-state/recipes");
//   (*store)->save(recipe);
//   for (const RecipeEntry& entry : (*store)->list()) ...
//
// Threads: every function from any. Invariants: what save or remove has confirmed is on the disk, whole or
// not at all; a file is believed only as far as recipe_from_json does, is at most kLargestFile long and has
// the name that its recipe has.
//
// Diagnostics: H0021 the disk, H0071 a name that is none, H0072 no such recipe, H0073 too many, H0078
// damaged.

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/recipes/recipe.h"
#include "runtime/ground/result/result.h"

namespace stepwright::recipes {

// A file of the folder: its recipe, or what is wrong with it.
struct RecipeEntry {
  std::string name;  // by its file
  result::Result<Recipe> recipe;
};

class RecipeStore {
 public:
  // Makes the folder if it is not there.
  [[nodiscard]] static result::Result<std::unique_ptr<RecipeStore>> open(std::filesystem::path folder);

  // By name, at most kMostRecipes; files whose name can be none of a recipe are left out.
  std::vector<RecipeEntry> list() const;
  [[nodiscard]] result::Result<Recipe> read(const std::string& name) const;
  // In place of the one of that name.
  [[nodiscard]] result::Result<void> save(const Recipe& recipe);
  // A damaged one, too.
  [[nodiscard]] result::Result<void> remove(const std::string& name);

 private:
  explicit RecipeStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path file_of(const std::string& name) const { return folder_ / (name + ".json"); }
  result::Result<Recipe> read_file(const std::string& name) const;
  std::vector<std::string> names() const;

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;  // one access to the folder at a time
};

}  // namespace stepwright::recipes
