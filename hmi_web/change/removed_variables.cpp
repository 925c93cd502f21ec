#include "hmi_web/change/removed_variables.h"

#include <utility>

#include "runtime/bytecode/reader/resolve_name.h"

namespace stepwright::change {
namespace {

constexpr std::size_t kMostNamed = 5;

bool has(const reader::ProgramInfo& program, const std::string& name) {
  return reader::resolve_name(program, name).has_value();
}

// "'a', 'b' and 3 more".
std::string listed(const std::set<std::string>& names) {
  std::string text;
  std::size_t told = 0;
  for (const std::string& each : names) {
    if (told++ == kMostNamed) return text + " and " + std::to_string(names.size() - kMostNamed) + " more";
    text += (text.empty() ? "'" : ", '") + each + "'";
  }
  return text;
}

}  // namespace

void RemovedVariables::turn(std::shared_ptr<const reader::ProgramInfo> program) {
  if (!program || program == program_) return;
  const auto before = std::exchange(program_, std::move(program));
  // Of a program that is not known whole nobody can say what it lacks.
  if (!program_->complete()) return;
  if (tags_ != nullptr) note_recipes(*program_);
  if (screens_ != nullptr && before) note_screens(*before, *program_);
}

void RemovedVariables::note_recipes(const reader::ProgramInfo& program) {
  for (const recipes::RecipeTag& each : *tags_) {
    if (has(program, each.name)) {
      if (missing_.erase(each.name) != 0)
        log_.info("recipes", "the tag '" + each.name + "' of the recipes has its variable again");
    } else if (missing_.insert(each.name).second) {
      log_.warning("recipes", "the program has no variable '" + each.name +
                                  "', which recipes set: no recipe can be loaded until it has");
    }
  }
}

void RemovedVariables::note_screens(const reader::ProgramInfo& before, const reader::ProgramInfo& now) {
  for (const screens::Screen& screen : screens_->list()) {
    const screens::Version* const shown = screen.shown();
    if (shown == nullptr) continue;
    const auto drawn = screens_->read(screen.name, shown->number);
    if (!drawn) continue;
    std::set<std::string> lost;
    for (const drawing::BoundName& each : drawn->names)
      if (has(before, each.name) && !has(now, each.name)) lost.insert(each.name);
    if (lost.empty()) continue;
    log_.warning("screens", "the screen '" + screen.name + "' names " + listed(lost) +
                                ", which the program does not have any more");
  }
}

}  // namespace stepwright::change
