#pragma once

// A recipe as the JSON of its file, and back: `{"format": 1, "name", "comment", "saved_by", "saved_s",
// "values": {tag: literal}}` (hmi_web/doc/recipes.md).
//
//   auto recipe = recipe_from_json(text, "recipes/Blue 20 l.json");
//
// Pure; any thread. A file comes from anybody: other members, other types, other lengths, other numbers of
// values and a second of a name are refused with H0078, its place and its key. Whether the values fit the
// cell is not asked here (recipe_check.h).

#include <string>
#include <string_view>

#include "hmi_web/recipes/recipe.h"
#include "runtime/ground/result/result.h"

namespace stepwright::recipes {

std::string to_json(const Recipe& recipe);

[[nodiscard]] result::Result<Recipe> recipe_from_json(std::string_view text, const std::string& file);

}  // namespace stepwright::recipes
