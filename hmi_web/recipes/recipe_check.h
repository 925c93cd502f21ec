#pragma once

// Check whether values can be a recipe of a cell: exactly the defined tags, each with a literal of its type
// within its range. All problems are told at once.
//
//   auto checked = check(tags, {{"mixer.level", "20"}, {"mixer.stir", "t#1.5m"}});
//   checked->at("mixer.stir");                                            // "T#1m30s"
//
// Pure functions; any thread. Diagnostics: H0071 a name that is none, H0074 a tag is missing, H0075 a tag
// that no recipe sets, H0076 no literal of the type, H0077 out of range. Each message begins with the tag.

#include <string_view>
#include <vector>

#include "hmi_web/recipes/recipe.h"
#include "runtime/ground/result/result.h"

namespace stepwright::recipes {

// Letters, digits, blanks and ". _ -" of ASCII, the first and the last a letter or a digit: it is the name of
// a file, too.
[[nodiscard]] result::Result<void> check_name(std::string_view name);

// The values as IEC 61131-3 spells them: TRUE, 20.0, T#1m30s.
[[nodiscard]] result::Result<Values> check(const std::vector<RecipeTag>& tags, const Values& values);

// One value of one tag, spelt the same way.
[[nodiscard]] result::Result<std::string> check_value(const RecipeTag& tag, std::string_view literal);

// Where the value of a tag stands in a recipe: the place of what is wrong with it, as file
// "values.mixer.level".
result::Location value_place(const std::string& tag);

// "mixer.level = 20.0, mixer.stir = T#1m30s": for people and for the audit trail.
std::string text_of(const Values& values);

}  // namespace stepwright::recipes
