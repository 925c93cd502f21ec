#include "cell/check/check_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "hmi_web/alarms/definition_file.h"
#include "hmi_web/recipes/definition_file.h"
#include "hmi_web/recorder/cell_alarms.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/bytecode/whole_number.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/result/closest.h"

namespace stepwright::check {
namespace {

using bytecode::ElementaryType;
using result::Location;

constexpr std::string_view kFigures = "cell.";

bool is_real(ElementaryType type) {
  return type == ElementaryType::Real || type == ElementaryType::Lreal;
}

// Whether a variable reads literals as they are written for the other type.
bool takes(ElementaryType variable, ElementaryType literal) {
  if (variable == literal) return true;
  if (is_real(variable)) return bytecode::is_whole_number(literal) || is_real(literal);
  return bytecode::is_whole_number(variable) ? bytecode::is_whole_number(literal)
                                             : bytecode::is_string(variable) && bytecode::is_string(literal);
}

// Of a type of whole numbers.
std::pair<double, double> reach_of(ElementaryType type) {
  const int bits = static_cast<int>(8 * bytecode::size_of(bytecode::mem_type(type)));
  if (bytecode::is_unsigned(type)) return {0, std::ldexp(1.0, bits) - 1};
  return {-std::ldexp(1.0, bits - 1), std::ldexp(1.0, bits - 1) - 1};
}

std::string whole(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.0f", value);
  return text.data();
}

class FitCheck {
 public:
  explicit FitCheck(const reader::ProgramInfo& info) : info_(info) {}

  void alarm_source(const std::string& name, const Location& where, const std::string& what) {
    if (name.starts_with(kFigures)) return figure(name, where, what);
    const auto found = resolved(name, where, what);
    if (found && name.starts_with('%')) return by_address(name, *found, where, what);
    if (found && bytecode::is_string(found->type))
      tell("C0528", where,
           what + " is " + name + ", a " + bytecode::name_of(found->type) + ": it never has a number",
           "a number or a BOOL can be watched");
  }

  void recipe(const recipes::RecipeTag& tag) {
    const auto found = resolved(tag.name, tag.name_where, "a recipe's tag (name)");
    if (!found) return;
    const reader::Tag* const known = info_.find_tag(tag.name);
    if (known != nullptr && (known->flags & bytecode::kSymbolConstant) != 0)
      return tell("C0528", tag.name_where,
                  "a recipe's tag is " + tag.name + ", which is a constant of the program",
                  "a variable without CONSTANT can be set");
    if (takes(found->type, tag.type)) return check_range(tag, found->type);
    tell("C0528", tag.where,
         "a recipe's tag is of the type " + std::string(bytecode::name_of(tag.type)) + ", and " + tag.name +
             " of the program is of the type " + bytecode::name_of(found->type),
         "type = \"" + std::string(bytecode::name_of(found->type)) + "\"");
  }

  void task(const config::TaskConfig& task) {
    std::vector<std::string> names;
    for (const reader::TaskInfo& each : info_.tasks()) {
      if (naming::same_name(each.name, task.name)) return;
      names.push_back(each.name);
    }
    tell("C0532", task.where, "[tasks." + task.name + "] names a task that the program does not have",
         meant_or(task.name, names, "its tasks: "), result::Severity::Warning);
  }

  result::Diagnostics take() { return std::move(problems_); }

 private:
  // The page knows the values of a program by their names.
  void by_address(const std::string& address, const reader::Variable& at, const Location& where,
                  const std::string& what) {
    const auto same = [&](const reader::Tag& tag) {
      return tag.variable.address == at.address && tag.variable.bit == at.bit;
    };
    const auto tag = std::ranges::find_if(info_.tags(), same);
    tell("C0532", where, what + " is the address " + address + ", and alarms watch variables by their names",
         tag == info_.tags().end() ? "declare a variable AT " + address + ", and name that"
                                   : "did you mean '" + tag->name + "'?");
  }

  void figure(const std::string& name, const Location& where, const std::string& what) {
    const std::vector<std::string> known = {
        std::string(recorder::kRuntimeAlive), std::string(recorder::kRuntimeFault),
        std::string(recorder::kSupervisorAlive), std::string(recorder::kServerAway)};
    if (std::ranges::find(known, name) != known.end()) return;
    tell("C0532", where, what + " names '" + name + "', which is no figure of a cell",
         meant_or(name, known, "there are "));
  }

  // A load beyond the variable's type is refused, whatever the recipe says.
  void check_range(const recipes::RecipeTag& tag, ElementaryType type) {
    if (!bytecode::is_whole_number(type) || !bytecode::is_whole_number(tag.type)) return;
    const auto [least, most] = reach_of(type);
    if (tag.least >= least && tag.most <= most) return;
    tell("C0528", tag.where,
         "a recipe's tag goes from " + whole(tag.least) + " to " + whole(tag.most) + ", and " + tag.name +
             " of the program, of the type " + bytecode::name_of(type) + ", from " + whole(least) + " to " +
             whole(most),
         "recipes with other values cannot be loaded: type = \"" + std::string(bytecode::name_of(type)) +
             "\", or min and max within it",
         result::Severity::Warning);
  }

  // A name that is not there is told elsewhere; an address is not.
  std::optional<reader::Variable> resolved(const std::string& name, const Location& where,
                                           const std::string& what) {
    if (name.empty()) return std::nullopt;
    auto found = reader::resolve_name(info_, name, "C0529", where);
    if (found) return std::move(found->variable);
    if (name.starts_with('%'))
      tell("C0529", where, what + ": " + found.error().front().message, found.error().front().hint);
    return std::nullopt;
  }

  static std::string meant_or(const std::string& name, const std::vector<std::string>& known,
                              const std::string& before) {
    const std::string* const meant = result::closest(name, known, (name.size() + 2) / 3);
    if (meant != nullptr) return "did you mean '" + *meant + "'?";
    std::string all = before;
    for (const std::string& each : known) all += (&each == &known.front() ? "" : ", ") + each;
    return known.empty() ? std::string() : all;
  }

  void tell(const char* code, const Location& where, std::string message, std::string hint,
            result::Severity severity = result::Severity::Error) {
    problems_.push_back({code, severity, where, std::move(message), std::move(hint)});
  }

  const reader::ProgramInfo& info_;
  result::Diagnostics problems_;
};

}  // namespace

result::Diagnostics check_fit(const config::CellConfig& config, const reader::ProgramInfo& info) {
  if (!info.complete()) return {};
  FitCheck fit(info);
  if (!config.history.alarms.empty()) {
    if (const auto alarms = alarms::load_alarms(config.history.alarms); alarms) {
      for (const alarms::AlarmDefinition& each : *alarms) {
        const std::string what = "the alarm '" + each.name + "'";
        fit.alarm_source(each.source, each.source_where, what + " (source)");
        fit.alarm_source(each.suppress_when, each.suppress_when_where, what + " (suppress_when)");
      }
    }
  }
  if (!config.hmi.recipes.empty()) {
    if (const auto tags = recipes::load_definitions(config.hmi.recipes); tags)
      for (const recipes::RecipeTag& each : *tags) fit.recipe(each);
  }
  for (const config::TaskConfig& each : config.tasks) fit.task(each);
  return fit.take();
}

}  // namespace stepwright::check
