#pragma once

// The tags that a cell's recipes set, with their ranges, from TOML: [[tag]] tables of the file that [hmi]
// recipes names (hmi_web/doc/recipes.md has every key).
//
//   auto tags = load_definitions("recipes.toml");
//
// Every problem is told at once, with file, line, column and key: C0001 to C0006 as in every TOML file; C0620
// no tag, a tag twice, too many or a name that is none; C0621 a range that has nothing in it or that the type
// does not reach; C0622 a key that a BOOL does not have.
//
// Pure functions but for reading the file.

#include <filesystem>
#include <vector>

#include "hmi_web/recipes/recipe.h"
#include "runtime/ground/result/result.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::recipes {

// Problems go into the document of the table.
std::vector<RecipeTag> read_definitions(const settings::TomlTable& root);

[[nodiscard]] result::Result<std::vector<RecipeTag>> load_definitions(const std::filesystem::path& file);

}  // namespace stepwright::recipes
