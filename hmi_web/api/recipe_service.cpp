#include "hmi_web/api/recipe_service.h"

#include <algorithm>
#include <utility>

#include "hmi_web/api/cell_codes.h"
#include "hmi_web/recipes/recipe_check.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::api {
namespace {

using recipes::Recipe;
using recipes::RecipeTag;
using recipes::Values;
using result::Result;

// Spelt as the definitions do, so that 20 and 20.0 are the same; what is wrong stays as it is.
std::optional<std::string> value_in(const Recipe& recipe, const RecipeTag& tag) {
  const auto found = recipe.values.find(tag.name);
  if (found == recipe.values.end()) return std::nullopt;
  auto spelt = recipes::check_value(tag, found->second);
  return spelt ? *std::move(spelt) : found->second;
}

}  // namespace

RecipeService::RecipeService(std::vector<RecipeTag> tags, recipes::RecipeStore& store, CellControl& cell,
                             const ForceService& forces, access::WallClock clock)
    : tags_(std::move(tags)), store_(store), cell_(cell), forces_(forces), clock_(std::move(clock)) {}

std::vector<RecipeTag> RecipeService::known_tags() const {
  std::vector<RecipeTag> known = tags_;
  const auto program = cell_.program();
  for (RecipeTag& tag : known) {
    tag.program_unknown = program == nullptr;
    if (!program) continue;
    if (const auto found = reader::resolve_name(*program, tag.name);
        found && found->variable.type == tag.type)
      tag.names = found->variable.enumerators;
  }
  return known;
}

result::Diagnostics RecipeService::problems_of(const Recipe& recipe) const {
  auto checked = recipes::check(known_tags(), recipe.values);
  if (!checked) return std::move(checked.error());
  // What the program that runs would refuse; a variable that is forced can be released.
  auto spelt = checked_by_program(std::move(*checked));
  if (spelt || nobody_answers(spelt.error())) return {};
  std::erase_if(spelt.error(), [](const result::Diagnostic& each) { return each.code == kTagForced; });
  return std::move(spelt.error());
}

std::vector<PresentTag> RecipeService::present() const {
  std::vector<PresentTag> all;
  for (const RecipeTag& tag : tags_) all.push_back({&tag, cell_.read(tag.name)});
  return all;
}

Result<std::vector<RecipeRow>> RecipeService::compare(const std::string& left,
                                                      const std::string& right) const {
  auto one = store_.read(left);
  if (!one) return result::forward(one);
  auto other = store_.read(right);
  if (!other) return result::forward(other);
  std::vector<RecipeRow> rows;
  for (const RecipeTag& tag : known_tags())
    rows.push_back({tag.name, value_in(*one, tag), value_in(*other, tag)});
  return rows;
}

Result<std::vector<RecipeRow>> RecipeService::compare_with_present(const std::string& left) const {
  auto one = store_.read(left);
  if (!one) return result::forward(one);
  std::vector<RecipeRow> rows;
  for (const RecipeTag& tag : known_tags()) {
    RecipeRow row{tag.name, value_in(*one, tag), std::nullopt};
    // As the program would spell it: its variable may be of another type than the definition.
    if (row.left) {
      if (auto spelt = cell_.spell(tag.name, *row.left)) row.left = std::move(*spelt);
    }
    auto now = cell_.read(tag.name);
    if (now)
      row.right = std::move(*now);
    else
      row.problem = now.error().front().message;
    rows.push_back(std::move(row));
  }
  return rows;
}

Result<RecipeChange> RecipeService::save(const std::string& name, const std::string& comment,
                                         const Values& values, const std::string& user) {
  if (auto fits = recipes::check_name(name); !fits) return result::forward(fits);
  auto checked = recipes::check(known_tags(), values);
  if (!checked) return result::forward(checked);
  RecipeChange change;
  // A damaged one is written over, with no values to tell of.
  if (auto old = store_.read(name)) change.before = std::move(old->values);
  change.after = std::move(*checked);
  if (auto kept = store_.save({name, comment, user, clock_(), change.after}); !kept)
    return result::forward(kept);
  return change;
}

Result<RecipeChange> RecipeService::remove(const std::string& name) {
  RecipeChange change;
  if (auto old = store_.read(name)) change.before = std::move(old->values);
  if (auto gone = store_.remove(name); !gone) return result::forward(gone);
  return change;
}

Result<RecipeChange> RecipeService::load(const std::string& name) {
  auto recipe = store_.read(name);
  if (!recipe) return result::forward(recipe);
  auto checked = recipes::check(known_tags(), recipe->values);
  if (!checked) return result::forward(checked);
  if (auto there = cell_.reach(); !there) return result::forward(there);
  auto after = checked_by_program(std::move(*checked));
  if (!after) return result::forward(after);
  auto before = read_all(*after);
  if (!before) return result::forward(before);
  RecipeChange change{std::move(*before), std::move(*after)};
  if (auto written = write_all(change); !written) return result::forward(written);
  return change;
}

// The values as the running program spells them, or everything that stands in the way.
Result<Values> RecipeService::checked_by_program(Values values) const {
  result::Diagnostics problems;
  const std::vector<std::string> forced = forces_.names();
  // By its own name, or by the one under which the program has its place.
  const auto is_forced = [&](const std::string& tag, const std::string& value) {
    const auto place = cell_.as_forced(tag, value);
    return std::any_of(forced.begin(), forced.end(), [&](const std::string& each) {
      return naming::same_name(each, tag) || (place && naming::same_name(each, place->name));
    });
  };
  for (auto& [name, value] : values) {
    const std::string& tag = name;
    if (is_forced(tag, value))
      problems.push_back({kTagForced, result::Severity::Error, recipes::value_place(tag),
                          tag + ": it is forced", "release it first"});
    auto spelt = cell_.spell(tag, value);
    if (spelt) {
      value = std::move(*spelt);
      continue;
    }
    if (nobody_answers(spelt.error())) return result::forward(spelt);
    for (auto& problem : spelt.error()) {
      problem.message.insert(0, tag + ": ");
      problem.where = recipes::value_place(tag);
      problems.push_back(std::move(problem));
    }
  }
  if (!problems.empty()) return tl::unexpected<result::Diagnostics>(std::move(problems));
  return values;
}

Result<Values> RecipeService::read_all(const Values& values) const {
  Values now;
  for (const auto& [name, value] : values) {
    auto read = cell_.read(name);
    if (!read) return result::forward(read);
    now.emplace(name, std::move(*read));
  }
  return now;
}

// Who does not answer may have written them all the same: all of them then.
Result<void> RecipeService::write_all(const RecipeChange& change) {
  const auto written = cell_.write_together(change.after);
  if (written) return {};
  const bool unknown = nobody_answers(written.error());
  return result::fail(kWriteFailed, {}, written.error().front().message,
                      unknown
                          ? "either all values have been written or none: compare with the running program"
                          : "no value has been written");
}

}  // namespace stepwright::api
