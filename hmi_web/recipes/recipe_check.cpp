#include "hmi_web/recipes/recipe_check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "runtime/bytecode/reader/parse_string.h"
#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/whole_number.h"
#include "runtime/ground/result/closest.h"

namespace stepwright::recipes {
namespace {

using bytecode::ElementaryType;

constexpr std::size_t kMostEdits = 3;

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string range_of(const RecipeTag& tag) {
  const std::string unit = tag.unit.empty() ? "" : " " + tag.unit;
  return short_number(tag.least) + " to " + short_number(tag.most) + unit;
}

// What a recipe has and the cell does not define.
result::Diagnostic unknown(const std::vector<RecipeTag>& tags, const std::string& name) {
  std::vector<std::string> names;
  for (const RecipeTag& tag : tags) names.push_back(tag.name);
  const std::string shown = name.substr(0, kLongestTag);
  const std::string* meant = result::closest(shown, names, kMostEdits);
  return {"H0075",
          result::Severity::Error,
          {},
          "'" + shown + "' is no tag that recipes set",
          meant != nullptr ? "did you mean '" + *meant + "'?" : "the cell's file of recipes defines them"};
}

void append(result::Diagnostics& problems, result::Diagnostics more) {
  problems.insert(problems.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// "Auto", "Mode#Hand".
bool is_word(std::string_view literal) {
  return !literal.empty() && !(literal.front() >= '0' && literal.front() <= '9') &&
         std::all_of(literal.begin(), literal.end(),
                     [](char c) { return is_letter_or_digit(c) || c == '_' || c == '#'; });
}

tl::unexpected<result::Diagnostics> wrong(const RecipeTag& tag, const result::Diagnostic& problem) {
  return result::fail("H0076", value_place(tag.name), tag.name + ": " + problem.message, problem.hint);
}

// How long it may be the program knows.
result::Result<std::string> check_text(const RecipeTag& tag, reader::Variable variable,
                                       std::string_view text) {
  variable.capacity = kLongestLiteral;
  if (const auto bytes = reader::parse_string(variable, text); !bytes)
    return wrong(tag, bytes.error().front());
  return std::string(text);
}

}  // namespace

result::Result<void> check_name(std::string_view name) {
  const bool fits = !name.empty() && name.size() <= kLongestName && is_letter_or_digit(name.front()) &&
                    is_letter_or_digit(name.back()) && std::all_of(name.begin(), name.end(), [](char c) {
                      return is_letter_or_digit(c) || c == ' ' || c == '.' || c == '_' || c == '-';
                    });
  if (fits) return {};
  return result::fail("H0071", {}, "this cannot be the name of a recipe",
                      "up to 64 letters, digits, blanks or . _ -, the first and the last a letter or digit");
}

result::Result<std::string> check_value(const RecipeTag& tag, std::string_view literal) {
  if (literal.size() > kLongestLiteral)
    return result::fail("H0076", value_place(tag.name), tag.name + ": the value is too long",
                        "at most 64 bytes");
  reader::Variable variable;
  variable.type = tag.type;
  variable.enumerators = tag.names;
  if (bytecode::is_string(tag.type)) return check_text(tag, variable, literal);
  const auto bits = reader::parse_value(variable, literal);
  if (!bits && tag.program_unknown && bytecode::is_whole_number(tag.type) && is_word(literal))
    return std::string(literal);
  if (!bits) return wrong(tag, bits.error().front());
  std::array<std::byte, sizeof *bits> image{};
  std::memcpy(image.data(), &*bits, sizeof *bits);
  const double number = reader::read_quantity(variable, image);
  std::string spelt = reader::read_text(variable, image);
  // Written so that what is no number is out of every range.
  if (has_range(tag.type) && !(number >= tag.least && number <= tag.most))
    return result::fail("H0077", value_place(tag.name), tag.name + ": " + spelt + " is out of range",
                        range_of(tag));
  return spelt;
}

result::Result<Values> check(const std::vector<RecipeTag>& tags, const Values& values) {
  Values spelt;
  result::Diagnostics problems;
  for (const RecipeTag& tag : tags) {
    const auto found = values.find(tag.name);
    if (found == values.end()) {
      problems.push_back({"H0074", result::Severity::Error, value_place(tag.name),
                          tag.name + ": the recipe has no value for it",
                          "save the recipe with a value for every tag"});
      continue;
    }
    if (auto value = check_value(tag, found->second))
      spelt.emplace(tag.name, std::move(*value));
    else
      append(problems, std::move(value.error()));
  }
  for (const auto& [name, literal] : values) {
    if (std::none_of(tags.begin(), tags.end(), [&](const RecipeTag& tag) { return tag.name == name; }))
      problems.push_back(unknown(tags, name));
  }
  if (!problems.empty()) return tl::unexpected<result::Diagnostics>(std::move(problems));
  return spelt;
}

result::Location value_place(const std::string& tag) {
  return {"values." + tag, 0, 0};
}

std::string text_of(const Values& values) {
  std::string text;
  for (const auto& [name, literal] : values) text += (text.empty() ? "" : ", ") + name + " = " + literal;
  return text;
}

}  // namespace stepwright::recipes
