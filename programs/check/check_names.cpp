#include "programs/check/check_names.h"

#include <algorithm>
#include <string>
#include <vector>

#include "cell/hmi/plant_picture.h"
#include "hmi_web/alarms/definition_file.h"
#include "hmi_web/drawing/drawing_file.h"
#include "hmi_web/recipes/definition_file.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::check {
namespace {

using result::Location;

// Of the cell itself: "cell.runtime_alive".
constexpr std::string_view kOfTheCell = "cell.";

class NameCheck {
 public:
  NameCheck(const config::CellConfig& config, const reader::ProgramInfo& info) : info_(info) {
    for (const reader::Tag& tag : info.tags()) names_.push_back(tag.name);
    if (const auto picture = hmi::picture_of(config.plant))
      for (const protocol::Point& point : picture->synoptic.points) points_.push_back(point.id);
  }

  // `points`: those of the plant's picture will do, too.
  void check(const std::string& name, const Location& where, const std::string& what, bool points) {
    if (name.empty() || name.starts_with('%') || info_.find(name) != nullptr) return;
    if (points && std::ranges::find(points_, name) != points_.end()) return;
    const std::string meant = nearest(name, points);
    problems_.push_back({"C0532", result::Severity::Error, where,
                         what + " names '" + name + "', which the program does not have",
                         meant.empty() ? "`stepwright snapshot` lists the variables of a running program"
                                       : "did you mean '" + meant + "'?"});
  }

  result::Diagnostics take() { return std::move(problems_); }

 private:
  // Upper and lower case are alike.
  std::string nearest(const std::string& name, bool points) const {
    std::vector<std::string> folded;
    for (const std::string& each : names_) folded.push_back(naming::upper(each));
    if (points)
      for (const std::string& each : points_) folded.push_back(naming::upper(each));
    const std::string meant = settings::closest(naming::upper(name), folded);
    const auto at = std::ranges::find(folded, meant);
    if (meant.empty() || at == folded.end()) return {};
    const auto index = static_cast<std::size_t>(at - folded.begin());
    return index < names_.size() ? names_[index] : points_[index - names_.size()];
  }

  const reader::ProgramInfo& info_;
  std::vector<std::string> names_;
  std::vector<std::string> points_;  // of the plant
  result::Diagnostics problems_;
};

void check_alarms(const config::CellConfig& config, NameCheck& names) {
  if (config.history.alarms.empty()) return;
  const auto alarms = alarms::load_alarms(config.history.alarms);
  if (!alarms) return;
  for (const alarms::AlarmDefinition& each : *alarms) {
    const std::string what = "the alarm '" + each.name + "'";
    if (!each.source.starts_with(kOfTheCell))
      names.check(each.source, each.source_where, what + " (source)", true);
    if (!each.suppress_when.starts_with(kOfTheCell))
      names.check(each.suppress_when, each.suppress_when_where, what + " (suppress_when)", true);
  }
}

void check_recipes(const config::CellConfig& config, NameCheck& names) {
  if (config.hmi.recipes.empty()) return;
  const auto tags = recipes::load_definitions(config.hmi.recipes);
  if (!tags) return;
  for (const recipes::RecipeTag& each : *tags)
    names.check(each.name, each.name_where, "a recipe's tag (name)", false);
}

void check_drawing(const config::CellConfig& config, NameCheck& names) {
  if (config.hmi.drawing.empty()) return;
  const auto drawn = drawing::load_drawing(config.hmi.drawing);
  if (!drawn) return;
  for (const drawing::BoundName& each : drawn->names) names.check(each.name, each.where, "the drawing", true);
}

}  // namespace

result::Diagnostics check_names(const config::CellConfig& config, const reader::ProgramInfo& info) {
  if (!info.complete()) return {};
  NameCheck names(config, info);
  check_alarms(config, names);
  check_recipes(config, names);
  check_drawing(config, names);
  return names.take();
}

}  // namespace stepwright::check
