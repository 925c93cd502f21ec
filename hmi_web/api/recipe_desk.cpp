#include "hmi_web/api/recipe_desk.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "hmi_web/recipes/recipe_check.h"
#include "runtime/naming/ascii_names.h"

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

bool nobody_answers(const result::Diagnostics& problems) {
  return problems.front().code == "D0001";
}

// "the values before it have been put back", or which could not be.
std::string fate_of(const std::vector<std::string>& lost) {
  if (lost.empty()) return "what had been written before it has been put back";
  std::string names;
  for (const std::string& each : lost) names += (names.empty() ? "" : ", ") + each;
  return "these could not be put back: " + names;
}

}  // namespace

RecipeDesk::RecipeDesk(std::vector<RecipeTag> tags, recipes::RecipeStore& store, CellControl& cell,
                       const ForceDesk& forces, access::WallClock clock)
    : tags_(std::move(tags)), store_(store), cell_(cell), forces_(forces), clock_(std::move(clock)) {}

result::Diagnostics RecipeDesk::problems_of(const Recipe& recipe) const {
  auto checked = recipes::check(tags_, recipe.values);
  return checked ? result::Diagnostics{} : std::move(checked.error());
}

std::vector<PresentTag> RecipeDesk::present() const {
  std::vector<PresentTag> all;
  for (const RecipeTag& tag : tags_) all.push_back({&tag, cell_.read(tag.name)});
  return all;
}

Result<std::vector<RecipeRow>> RecipeDesk::compare(const std::string& left, const std::string& right) const {
  auto one = store_.read(left);
  if (!one) return result::forward(one);
  auto other = store_.read(right);
  if (!other) return result::forward(other);
  std::vector<RecipeRow> rows;
  for (const RecipeTag& tag : tags_) rows.push_back({tag.name, value_in(*one, tag), value_in(*other, tag)});
  return rows;
}

Result<std::vector<RecipeRow>> RecipeDesk::compare_with_present(const std::string& left) const {
  auto one = store_.read(left);
  if (!one) return result::forward(one);
  std::vector<RecipeRow> rows;
  for (const RecipeTag& tag : tags_) {
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

Result<RecipeChange> RecipeDesk::save(const std::string& name, const std::string& comment,
                                      const Values& values, const std::string& user) {
  if (auto fits = recipes::check_name(name); !fits) return result::forward(fits);
  auto checked = recipes::check(tags_, values);
  if (!checked) return result::forward(checked);
  RecipeChange change;
  // A damaged one is written over, with no values to tell of.
  if (auto old = store_.read(name)) change.before = std::move(old->values);
  change.after = std::move(*checked);
  if (auto kept = store_.save({name, comment, user, clock_(), change.after}); !kept)
    return result::forward(kept);
  return change;
}

Result<RecipeChange> RecipeDesk::remove(const std::string& name) {
  RecipeChange change;
  if (auto old = store_.read(name)) change.before = std::move(old->values);
  if (auto gone = store_.remove(name); !gone) return result::forward(gone);
  return change;
}

Result<RecipeChange> RecipeDesk::load(const std::string& name) {
  auto recipe = store_.read(name);
  if (!recipe) return result::forward(recipe);
  auto checked = recipes::check(tags_, recipe->values);
  if (!checked) return result::forward(checked);
  auto after = checked_by_program(std::move(*checked));
  if (!after) return result::forward(after);
  auto before = read_all(*after);
  if (!before) return result::forward(before);
  RecipeChange change{std::move(*before), std::move(*after)};
  if (auto written = write_all(change); !written) return result::forward(written);
  return change;
}

// The values as the running program spells them, or everything that stands in the way.
Result<Values> RecipeDesk::checked_by_program(Values values) const {
  result::Diagnostics problems;
  const std::vector<std::string> forced = forces_.names();
  for (auto& [name, value] : values) {
    const std::string& tag = name;
    if (std::any_of(forced.begin(), forced.end(),
                    [&](const std::string& each) { return naming::same_name(each, tag); }))
      problems.push_back({"H0079", result::Severity::Error, {}, tag + ": it is forced", "release it first"});
    auto spelt = cell_.spell(tag, value);
    if (spelt) {
      value = std::move(*spelt);
      continue;
    }
    if (nobody_answers(spelt.error())) return result::forward(spelt);
    for (auto& problem : spelt.error()) {
      problem.message.insert(0, tag + ": ");
      problems.push_back(std::move(problem));
    }
  }
  if (!problems.empty()) return tl::unexpected<result::Diagnostics>(std::move(problems));
  return values;
}

Result<Values> RecipeDesk::read_all(const Values& values) const {
  Values now;
  for (const auto& [name, value] : values) {
    auto read = cell_.read(name);
    if (!read) return result::forward(read);
    now.emplace(name, std::move(*read));
  }
  return now;
}

// Writes the former values of all tags before `end`, the last one too: whoever has not answered may have
// written it all the same. The names of those that could not be put back.
std::vector<std::string> RecipeDesk::put_back(const RecipeChange& change, Values::const_iterator end) {
  std::vector<std::string> lost;
  bool silent = false;
  for (auto at = std::make_reverse_iterator(end); at != change.after.rend(); ++at) {
    // Nobody waits for the silence of each.
    if (!silent) {
      const auto written = cell_.write(at->first, change.before.at(at->first));
      if (written) continue;
      silent = nobody_answers(written.error());
    }
    lost.push_back(at->first);
  }
  return lost;
}

Result<void> RecipeDesk::write_all(const RecipeChange& change) {
  for (auto at = change.after.begin(); at != change.after.end(); ++at) {
    const auto written = cell_.write(at->first, at->second);
    if (written) continue;
    const auto lost = put_back(change, std::next(at));
    return result::fail("H0080", {}, at->first + ": " + written.error().front().message, fate_of(lost));
  }
  return {};
}

}  // namespace stepwright::api
