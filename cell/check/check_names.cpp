#include "cell/check/check_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cell/hmi/plant_picture.h"
#include "hmi_web/alarms/definition_file.h"
#include "hmi_web/drawing/drawing_file.h"
#include "hmi_web/recipes/definition_file.h"
#include "hmi_web/screens/part_check.h"
#include "hmi_web/screens/screen_store.h"
#include "runtime/ground/files/durable_file.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::check {
namespace {

using result::Location;

// Of the cell itself: "cell.runtime_alive".
constexpr std::string_view kOfTheCell = "cell.";
// Of a point in the history.
constexpr std::string_view kPointPrefix = "points/";
constexpr std::size_t kLargestKept = 4 << 20;  // bytes

std::string text_of(const nlohmann::json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// The same of a name; what is too long or has other signs than ASCII is none.
std::string plain_text_of(const nlohmann::json& object, const char* key) {
  constexpr std::size_t kLongest = 64;
  std::string text = text_of(object, key);
  const bool is_plain = text.size() <= kLongest &&
                        std::ranges::all_of(text, [](unsigned char c) { return c >= ' ' && c < 0x7f; });
  return is_plain ? text : std::string();
}

// "pump" of "{pump}.running".
std::vector<std::string> fields_in(std::string_view name) {
  std::vector<std::string> fields;
  for (std::size_t at = name.find('{'); at != std::string_view::npos; at = name.find('{', at + 1)) {
    const std::size_t end = name.find('}', at);
    if (end == std::string_view::npos) break;
    const std::string_view field = name.substr(at + 1, end - at - 1);
    const bool is_word = !field.empty() && std::ranges::all_of(field, [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_';
    });
    if (is_word) fields.emplace_back(field);
  }
  return fields;
}

class NameCheck {
 public:
  NameCheck(const config::CellConfig& config, const reader::ProgramInfo& info) : info_(info) {
    for (const reader::Tag& tag : info.tags()) names_.push_back(tag.name);
    points_ = picture_points(config);
  }

  // What is kept outlives programs: a warning.
  void note_kept(const std::string& name, const Location& where, const std::string& what, bool points) {
    const std::size_t before = problems_.size();
    check(name, where, what, points);
    if (problems_.size() == before) return;
    problems_.back().code = "C0634";
    problems_.back().severity = result::Severity::Warning;
  }

  // `points`: those of the plant's picture will do, too.
  void check(const std::string& name, const Location& where, const std::string& what, bool points,
             result::Severity severity = result::Severity::Error) {
    if (name.empty() || name.starts_with('%') || info_.find(name) != nullptr) return;
    if (points && std::ranges::find(points_, name) != points_.end()) return;
    const std::string meant = nearest(name, points);
    problems_.push_back({"C0532", severity, where,
                         what + " names '" + name + "', which the program does not have",
                         meant.empty() ? "`stepwright snapshot` lists the variables of a running program"
                                       : "did you mean '" + meant + "'?"});
  }

  // A field of a face stays in the names of a copy that does not fill it in: "{pump}.running". It is told
  // once for each copy, and not as a variable that is missing.
  void check_bound(const drawing::BoundName& bound, const std::string& what,
                   result::Severity severity = result::Severity::Error) {
    const std::vector<std::string> fields = fields_in(bound.name);
    if (fields.empty()) return check(bound.name, bound.where, what, true, severity);
    const nlohmann::json copy = nlohmann::json::parse(bound.copy, nullptr, /*allow_exceptions=*/false);
    const std::string face = plain_text_of(copy, "face");
    const std::string key = plain_text_of(copy, "key");
    for (const std::string& field : fields) {
      std::string message = what + ": the field '" + field + "'";
      if (!key.empty()) message += " of the copy " + key;
      if (!face.empty()) message += " of the face '" + face + "'";
      message += " is empty";
      if (!unfilled_.insert(bound.where.file + '\n' + message).second) continue;
      problems_.push_back({"C0532", severity, bound.where, std::move(message),
                           "fill it in where the screen is drawn: '" + bound.name + "' names nothing"});
    }
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
  std::set<std::string> unfilled_;  // that are told, with their files
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
  for (const drawing::BoundName& each : drawn->names) names.check_bound(each, "the drawing");
}

// What a server keeps is its own: a file that cannot be read or is damaged is told by the server.
nlohmann::json kept(const std::filesystem::path& file, const char* list) {
  const auto text = files::read_bounded(file, kLargestKept);
  if (!text || text->size() > kLargestKept) return nlohmann::json::array();
  nlohmann::json document = nlohmann::json::parse(*text, nullptr, /*allow_exceptions=*/false);
  const bool right = document.is_object() && document.contains(list) && document[list].is_array();
  return right ? document[list] : nlohmann::json::array();
}

void check_forces(const config::CellConfig& config, NameCheck& names) {
  const std::filesystem::path file = config.hmi.access_dir / "forces.json";
  for (const auto& each : kept(file, "forces"))
    names.note_kept(text_of(each, "name"), {file.string(), 0, 0}, "a force", false);
}

void check_trends(const config::CellConfig& config, NameCheck& names) {
  const std::filesystem::path file = config.hmi.access_dir / "trends.json";
  for (const auto& group : kept(file, "groups")) {
    if (!group.is_object() || !group.contains("series") || !group["series"].is_array()) continue;
    for (const auto& each : group["series"]) {
      std::string tag = text_of(each, "tag");
      if (tag.starts_with(kPointPrefix)) tag.erase(0, kPointPrefix.size());
      names.note_kept(tag, {file.string(), 0, 0}, "the trend '" + text_of(group, "name") + "'", true);
    }
  }
}

// A warning, too: somebody may draw it later, or show it to everybody.
void check_wall_screen(const config::CellConfig& config, const std::string& name,
                       const std::vector<screens::Screen>& all, result::Diagnostics& problems) {
  const auto tell = [&](const std::string& what, std::string hint) {
    problems.push_back({"C0532",
                        result::Severity::Warning,
                        {config.file.string(), 0, 0},
                        "[hmi.wall] shows the screen '" + name + "', " + what,
                        std::move(hint)});
  };
  std::vector<std::string> drawn;
  for (const screens::Screen& screen : all) {
    const screens::Version* const shown = screen.shown();
    if (shown == nullptr) continue;
    if (screen.name != name) {
      drawn.push_back(screen.name);
      continue;
    }
    if (shown->least != "viewer")
      tell(
          "which is for the role " + shown->least + " and above: the display is a viewer and does not see it",
          "'Who sees it' in its editor: viewers");
    return;
  }
  const std::string meant = settings::closest(name, drawn);
  tell("and nobody has drawn it", meant.empty() ? "draw it on the page" : "did you mean '" + meant + "'?");
}

void check_wall(const config::CellConfig& config, const std::vector<screens::Screen>& all,
                result::Diagnostics& problems) {
  for (const std::string& panel : config.hmi.wall.panels) {
    const std::string name = config::wall_screen(panel);
    if (!name.empty()) check_wall_screen(config, name, all, problems);
  }
}

// People draw them while the cell runs: a warning, as the page shows by itself what is bound to nothing.
void check_screens(const config::CellConfig& config, const reader::ProgramInfo& info, NameCheck& names,
                   result::Diagnostics& problems) {
  std::error_code unknown;  // as good as not there: check_places says why
  if (!std::filesystem::is_directory(config.hmi.screens_dir, unknown))
    return check_wall(config, {}, problems);
  const auto store = screens::ScreenStore::open(config.hmi.screens_dir);
  if (!store) return;
  check_wall(config, (*store)->list(), problems);
  for (const screens::Screen& screen : (*store)->list()) {
    const screens::Version* const now = screen.shown();
    if (now == nullptr) continue;
    const auto drawn = (*store)->read(screen.name, now->number);
    if (!drawn) continue;
    for (const drawing::BoundName& each : drawn->names)
      names.check_bound(each, "the screen '" + screen.name + "'", result::Severity::Warning);
    std::ranges::move(screens::check_parts(drawn->parts, info), std::back_inserter(problems));
  }
}

}  // namespace

std::vector<std::string> picture_points(const config::CellConfig& config) {
  std::vector<std::string> points;
  if (const auto picture = hmi::picture_of(config.plant))
    for (const protocol::Point& point : picture->synoptic.points) points.push_back(point.id);
  return points;
}

result::Diagnostics check_names(const config::CellConfig& config, const reader::ProgramInfo& info) {
  if (!info.complete()) return {};
  NameCheck names(config, info);
  check_alarms(config, names);
  check_recipes(config, names);
  check_drawing(config, names);
  check_forces(config, names);
  check_trends(config, names);
  result::Diagnostics problems;
  check_screens(config, info, names, problems);
  std::ranges::move(names.take(), std::back_inserter(problems));
  return problems;
}

}  // namespace stepwright::check
