#include <nlohmann/json.hpp>

#include "hmi_web/api/internal/service_row.h"
#include "hmi_web/api/recipe_service.h"
#include "hmi_web/api/routes.h"
#include "hmi_web/recipes/recipe_check.h"

namespace stepwright::api {
namespace {

using nlohmann::json;
using recipes::Recipe;

const Field kValues{.name = "values",
                    .kind = Kind::Texts,
                    .least = 1,
                    .most = static_cast<double>(recipes::kMostTags),
                    .description = "a literal of IEC 61131-3 for every tag that recipes set"};
const Field kComment{.name = "comment",
                     .required = false,
                     .most = static_cast<double>(recipes::kLongestComment),
                     .description = "what the recipe is for"};
const Field kReason{.name = "reason", .least = 3, .most = 200, .description = "why, for the audit trail"};

constexpr const char* kTagList = R"({"type": "object", "required": ["tags"], "properties": {"tags":
  {"type": "array", "items": {"type": "object", "required": ["name", "type", "unit", "comment"], "properties": {
    "name": {"type": "string"}, "type": {"type": "string"}, "unit": {"type": "string"},
    "comment": {"type": "string"}, "min": {"type": "number"}, "max": {"type": "number"},
    "value": {"type": "string"}, "problem": {"type": "string"}}}}}})";
constexpr const char* kRecipeList = R"({"type": "object", "required": ["recipes"], "properties": {"recipes":
  {"type": "array", "items": {"type": "object", "required": ["name", "problems"]}}}})";
constexpr const char* kRecipe = R"({"type": "object", "required": ["name", "comment", "values", "problems"],
  "properties": {"name": {"type": "string"}, "comment": {"type": "string"}, "saved_by": {"type": "string"},
    "saved_ms": {"type": "integer"}, "problems": {"type": "array", "items": {"type": "string"}},
    "values": {"type": "object", "additionalProperties": {"type": "string"}}}})";
constexpr const char* kRows = R"({"type": "object", "required": ["rows", "differing"], "properties": {
  "differing": {"type": "integer"}, "rows": {"type": "array", "items": {"type": "object",
    "required": ["tag", "left", "right", "state"], "properties": {"tag": {"type": "string"},
      "left": {"type": ["string", "null"]}, "right": {"type": ["string", "null"]},
      "state": {"enum": ["same", "differs", "missing"]}, "problem": {"type": "string"}}}}}})";
constexpr const char* kChange = R"({"type": "object", "required": ["name", "values"], "properties": {
  "name": {"type": "string"}, "values": {"type": "object", "additionalProperties": {"type": "string"}}}})";

Answer no_recipes() {
  return refused(404, "H0070", "this server has no recipes",
                 "[hmi] recipes = \"recipes.toml\" in the cell's configuration");
}

Answer answer_of(const json& document) {
  return Answer{.text = document.dump(-1, ' ', false, json::error_handler_t::replace)};
}

json sentences(const result::Diagnostics& problems) {
  json list = json::array();
  for (const auto& problem : problems)
    list.push_back(problem.hint.empty() ? problem.message : problem.message + ": " + problem.hint);
  return list;
}

json described(const Recipe& recipe, const result::Diagnostics& problems) {
  const auto saved =
      std::chrono::duration_cast<std::chrono::milliseconds>(recipe.saved.time_since_epoch()).count();
  return {{"name", recipe.name},
          {"comment", recipe.comment},
          {"saved_by", recipe.saved_by},
          {"saved_ms", saved},
          {"problems", sentences(problems)}};
}

Answer tags_of(const RecipeService& service) {
  json list = json::array();
  const auto notes = service.notes();
  for (const PresentTag& each : service.present()) {
    const recipes::RecipeTag& tag = *each.tag;
    // The file of the definitions first, then the cell, then the declaration.
    const protocol::TagNote note = notes ? notes->of(tag.name) : protocol::TagNote();
    const bool has_unit = !tag.unit.empty() || !recipes::has_range(tag.type);
    json entry = {{"name", tag.name},
                  {"type", bytecode::name_of(tag.type)},
                  {"unit", has_unit ? tag.unit : note.unit},
                  {"comment", tag.comment.empty() ? note.description : tag.comment}};
    if (recipes::has_range(tag.type)) {
      entry["min"] = tag.least;
      entry["max"] = tag.most;
    }
    if (each.value)
      entry["value"] = *each.value;
    else
      entry["problem"] = each.value.error().front().message;
    list.push_back(std::move(entry));
  }
  return answer_of({{"tags", std::move(list)}});
}

Answer list_of(const RecipeService& service) {
  json list = json::array();
  for (const recipes::RecipeEntry& entry : service.list()) {
    list.push_back(entry.recipe ? described(*entry.recipe, service.problems_of(*entry.recipe))
                                : json{{"name", entry.name}, {"problems", sentences(entry.recipe.error())}});
  }
  return answer_of({{"recipes", std::move(list)}});
}

Answer one_of(const RecipeService& service, const Call& call) {
  const auto recipe = service.read(call.parameter("name"));
  if (!recipe) return refused(recipe.error());
  json document = described(*recipe, service.problems_of(*recipe));
  document["values"] = recipe->values;
  return answer_of(document);
}

json side(const std::optional<std::string>& value) {
  return value ? json(*value) : json();
}

Answer comparison_of(const RecipeService& service, const Call& call) {
  const std::string& with = call.parameter("with");
  const auto rows = with.empty() ? service.compare_with_present(call.parameter("name"))
                                 : service.compare(call.parameter("name"), with);
  if (!rows) return refused(rows.error());
  json list = json::array();
  std::size_t differing = 0;
  for (const RecipeRow& row : *rows) {
    const bool missing = !row.left || !row.right;
    const bool same = !missing && *row.left == *row.right;
    differing += same ? 0 : 1;
    json entry = {{"tag", row.tag},
                  {"left", side(row.left)},
                  {"right", side(row.right)},
                  {"state", missing ? "missing"
                            : same  ? "same"
                                    : "differs"}};
    if (!row.problem.empty()) entry["problem"] = row.problem;
    list.push_back(std::move(entry));
  }
  return answer_of({{"rows", std::move(list)}, {"differing", differing}});
}

// The answer to what was done, with both sides for the audit trail.
Answer changed(const result::Result<RecipeChange>& done, const std::string& name,
               const recipes::Values& asked = {}) {
  Answer answer = done ? answer_of({{"name", name}, {"values", done->after}}) : refused(done.error());
  answer.target = name;
  answer.before = done ? recipes::text_of(done->before) : "";
  answer.after = recipes::text_of(done ? done->after : asked);
  return answer;
}

template <typename Handler>
Route with(RecipeService* service, Route route, Handler handler) {
  return with_service(service, std::move(route), no_recipes, std::move(handler));
}

Route acting(Route route, Role least, Lane lane, Shape body = {}) {
  route.least = least;
  route.lane = lane;
  route.body = std::move(body);
  return route;
}

}  // namespace

std::vector<Route> recipe_routes(const Services& services) {
  RecipeService* service = services.recipes;
  Route compare =
      reading_row("/api/recipes/{name}/compare", "recipe.compare",
                  "A recipe beside another one, or beside the values of the running program", kRows);
  compare.query = {{"with", "the other recipe; without it: the running program"}};
  return {
      with(service,
           reading_row("/api/recipe-tags", "recipe.tags",
                       "The tags that recipes set, their ranges and their values now", kTagList),
           [](RecipeService& at, const Call&) { return tags_of(at); }),
      with(
          service,
          reading_row("/api/recipes", "recipe.list", "All recipes, and what is wrong with each", kRecipeList),
          [](RecipeService& at, const Call&) { return list_of(at); }),
      with(service, reading_row("/api/recipes/{name}", "recipe.read", "One recipe with its values", kRecipe),
           [](RecipeService& at, const Call& call) { return one_of(at, call); }),
      with(service, std::move(compare),
           [](RecipeService& at, const Call& call) { return comparison_of(at, call); }),
      with(service,
           acting(acting_row("PUT", "/api/recipes/{name}", "recipe.save", "Saves a recipe, or replaces it",
                             kChange),
                  Role::Engineer, Lane::Quick, {"SaveRecipe", {kValues, kComment}}),
           [](RecipeService& at, const Call& call) {
             const std::string& name = call.parameter("name");
             const auto& values = call.body.texts("values");
             return changed(at.save(name, call.body.text("comment"), values, call.who.user), name, values);
           }),
      with(service,
           acting(acting_row("DELETE", "/api/recipes/{name}", "recipe.remove", "Removes a recipe", kChange),
                  Role::Engineer, Lane::Quick),
           [](RecipeService& at, const Call& call) {
             const std::string& name = call.parameter("name");
             return changed(at.remove(name), name);
           }),
      with(service,
           acting(acting_row("POST", "/api/recipes/{name}/load", "recipe.load",
                             "Writes all values of a recipe into the running program, or none", kChange),
                  Role::Operator, Lane::Runtime, {"LoadRecipe", {kReason}}),
           [](RecipeService& at, const Call& call) {
             const std::string& name = call.parameter("name");
             return changed(at.load(name), name);
           }),
  };
}

}  // namespace stepwright::api
