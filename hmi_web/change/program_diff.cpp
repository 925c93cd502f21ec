#include "hmi_web/change/program_diff.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/host/change_problems.h"

namespace stepwright::change {
namespace {

using bytecode::TypeKind;
using record::StateLayout;
using record::StateVariable;

// "IDLE=0,RUN=1," as "(IDLE, RUN)".
std::string enumeration(const std::string& text) {
  std::string names;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    names += (names.empty() ? "" : ", ") + text.substr(at, text.find('=', at) - at);
    at = end + 1;
  }
  return "(" + names + ")";
}

std::string single_type(const record::StateType& type) {
  const std::string elementary = bytecode::name_of(type.elementary);
  switch (type.kind) {
    case TypeKind::String:
      return elementary + "[" + std::to_string(type.capacity) + "]";
    case TypeKind::Subrange:
      return elementary + " (" + std::to_string(type.lower) + ".." + std::to_string(type.upper) + ")";
    case TypeKind::Enumeration:
      return enumeration(type.text);
    case TypeKind::Reference:
      return "REF_TO " + type.text;
    default:
      return elementary;
  }
}

std::string type_text(const StateLayout& layout, const StateVariable& variable) {
  const std::string type = single_type(layout.type_of(variable));
  if (!variable.is_array) return type;
  return "ARRAY [" + std::to_string(variable.lower) + ".." +
         std::to_string(std::int64_t{variable.lower} + variable.count - 1) + "] OF " + type;
}

std::string address_text(const StateLayout& layout, const StateVariable& variable) {
  if ((variable.flags & record::kStateLocated) == 0) return {};
  const record::StateAreas& areas = layout.areas();
  const std::uint32_t outputs = areas.inputs + areas.outputs;
  const bool input = variable.address < areas.inputs;
  const bool output = !input && variable.address < outputs;
  const std::uint32_t byte = variable.address - (input ? 0 : output ? areas.inputs : outputs);
  const std::string area = input ? "%I" : output ? "%Q" : "%M";
  if (variable.bit != bytecode::kNoBit)
    return area + "X" + std::to_string(byte) + "." + std::to_string(variable.bit);
  const std::uint32_t size = layout.type_of(variable).size;
  const char* letter = size == 2 ? "W" : size == 4 ? "D" : size == 8 ? "L" : "B";
  return area + letter + std::to_string(size == 2 || size == 4 || size == 8 ? byte / size : byte);
}

// One of both programs, with the bits that its charts keep for their transitions.
struct Side {
  const StateLayout& layout;
  std::set<std::pair<std::uint32_t, std::uint8_t>> fires;

  Side(const StateLayout& of, const reader::ProgramInfo& info) : layout(of) {
    for (const reader::ChartInfo& chart : info.charts()) {
      for (const reader::TransitionInfo& each : chart.transitions) {
        if (each.fires) fires.emplace(each.fires->address, each.fires->bit);
      }
    }
  }
  // What people have declared; null if there is none of that path.
  const StateVariable* find(const std::string& path) const {
    const StateVariable* found = layout.find(path);
    return found != nullptr && is_declared(*found) ? found : nullptr;
  }
  bool is_declared(const StateVariable& variable) const {
    return (variable.flags & (record::kStateHidden | record::kStateStep)) == 0 &&
           !fires.contains({variable.address, variable.bit});
  }
};

// Of variables that are named by a report, with their types on each side.
std::vector<Difference> named(const std::vector<std::string>& paths, const Side& from, const Side& to) {
  std::vector<Difference> list;
  for (const std::string& path : paths) {
    const StateVariable* before = from.find(path);
    const StateVariable* after = to.find(path);
    if (before == nullptr && after == nullptr) continue;
    list.push_back({path, before != nullptr ? type_text(from.layout, *before) : "",
                    after != nullptr ? type_text(to.layout, *after) : ""});
  }
  return list;
}

std::vector<Difference> moved(const Side& from, const Side& to) {
  std::vector<Difference> list;
  for (const StateVariable& old : from.layout.variables()) {
    const StateVariable* now = to.find(old.path);
    if (!from.is_declared(old) || now == nullptr) continue;
    std::string before = address_text(from.layout, old);
    std::string after = address_text(to.layout, *now);
    if (before != after) list.push_back({old.path, std::move(before), std::move(after)});
  }
  return list;
}

bool is_active(const reader::Variable& step, std::span<const std::byte> image) {
  return reader::read_number(step, image) != 0;
}

// Steps of one program that the other one lacks, as "chart.step".
std::vector<StepDifference> steps(const reader::ProgramInfo& of, const reader::ProgramInfo& other,
                                  std::span<const std::byte> image) {
  std::set<std::string> known;
  for (const reader::ChartInfo& chart : other.charts()) {
    for (const reader::StepInfo& step : chart.steps)
      known.insert(naming::upper(chart.name + "." + step.name));
  }
  std::vector<StepDifference> list;
  for (const reader::ChartInfo& chart : of.charts()) {
    for (const reader::StepInfo& step : chart.steps) {
      std::string name = chart.name + "." + step.name;
      if (!known.contains(naming::upper(name)))
        list.push_back({std::move(name), is_active(step.active, image)});
    }
  }
  return list;
}

std::string task_text(const reader::TaskInfo& task) {
  std::string text;
  if (task.interval_us > 0) {
    const bool whole = task.interval_us % 1'000 == 0;
    text =
        whole ? std::to_string(task.interval_us / 1'000) + " ms" : std::to_string(task.interval_us) + " us";
  } else {
    text = task.trigger.empty() ? "freewheeling" : "on " + task.trigger;
  }
  return text + ", priority " + std::to_string(task.priority);
}

std::vector<Difference> tasks(const reader::ProgramInfo& running, const reader::ProgramInfo& next) {
  std::map<std::string, Difference> by_name;
  for (const reader::TaskInfo& task : running.tasks()) by_name[task.name].before = task_text(task);
  for (const reader::TaskInfo& task : next.tasks()) by_name[task.name].after = task_text(task);
  std::vector<Difference> list;
  for (auto& [name, each] : by_name) {
    if (each.before != each.after) list.push_back({name, std::move(each.before), std::move(each.after)});
  }
  return list;
}

}  // namespace

result::Result<ProgramDiff> compare(const reader::LoadedProgram& running, const reader::LoadedProgram& next,
                                    std::span<const std::byte> image) {
  auto outlook = host::outlook_of(running.program(), next.program(), image);
  if (!outlook) return result::forward(outlook);
  auto before = reader::ProgramInfo::read(running.bytes());
  if (!before) return result::forward(before);
  auto after = reader::ProgramInfo::read(next.bytes());
  if (!after) return result::forward(after);
  const Side from(outlook->from, *before);
  const Side to(outlook->to, *after);
  const record::TransferReport& report = outlook->transfer;
  ProgramDiff diff;
  diff.carried = report.carried;
  diff.added = named(report.initialised, from, to);
  diff.removed = named(report.dropped, from, to);
  diff.retyped = named(report.retyped, from, to);
  diff.shortened = named(report.shortened, from, to);
  diff.references = named(report.references, from, to);
  diff.moved = moved(from, to);
  diff.tasks = tasks(*before, *after);
  diff.steps_added = steps(*after, *before, {});
  diff.steps_removed = steps(*before, *after, image);
  diff.keep = std::move(outlook->keep);
  diff.restart_charts = std::move(outlook->restart_charts);
  return diff;
}

}  // namespace stepwright::change
