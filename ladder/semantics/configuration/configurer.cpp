// Tasks and what triggers them (IEC 61131-3, 6.8.2).

#include "ladder/semantics/configuration/configurer.h"

#include <algorithm>
#include <utility>

#include "ladder/source/suggestion.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::ExpressionKind;

namespace {

// One nanosecond count must become a whole number of microseconds that fits the container.
constexpr std::int64_t kMaxIntervalUs = 3'600'000'000;

std::string path_of(const Expression& source) {
  if (source.kind == ExpressionKind::Direct) return syntax::to_string(source.address);
  if (source.kind == ExpressionKind::Field)
    return path_of(*source.operands[0]) + "." + std::string(source.name.text);
  return std::string(source.name.text);
}

}  // namespace

void Configurer::run() {
  for (const syntax::Resource& resource : configuration_.resources) {
    const std::size_t first = a_.model.tasks.size();
    resource_tasks_ = {first, first};
    for (const syntax::TaskDeclaration& each : resource.tasks) declare_task(each);
    resource_tasks_ = tasks_.emplace_back(TaskRange{first, a_.model.tasks.size()});
    for (const syntax::ProgramDeclaration& each : resource.programs) declare_program(each, tasks_.size() - 1);
  }
  for (const syntax::ConfiguredVariable& each : configuration_.configured) configure(each);
  for (std::size_t r = 0; r < tasks_.size(); ++r) {
    const syntax::Resource& resource = configuration_.resources[r];
    resource_tasks_ = tasks_[r];
    for (std::size_t i = 0; i < resource.tasks.size(); ++i)
      if (resource.tasks[i].single) set_trigger(resource.tasks[i], a_.model.tasks[resource_tasks_.first + i]);
    for (Instance& each : instances_)
      if (each.resource == r) add_calls(each);
  }
  check_clock();
  qualify_tasks();
}

// Names of tasks are those of their resource: where two resources have one name, viewers see RESOURCE.task.
void Configurer::qualify_tasks() {
  std::vector<std::pair<std::size_t, std::string>> names;
  for (std::size_t r = 0; r < tasks_.size(); ++r)
    for (std::size_t i = tasks_[r].first; i < tasks_[r].end; ++i) {
      const std::string& name = a_.model.tasks[i].name;
      const bool elsewhere = std::ranges::any_of(tasks_, [&](const TaskRange& other) {
        for (std::size_t k = other.first; k < other.end && other.first != tasks_[r].first; ++k)
          if (naming::same_name(a_.model.tasks[k].name, name)) return true;
        return false;
      });
      const std::string_view resource = configuration_.resources[r].name.text;
      if (elsewhere && !resource.empty()) names.emplace_back(i, std::string(resource) + "." + name);
    }
  for (auto& [task, name] : names) a_.model.tasks[task].name = std::move(name);
}

void Configurer::run_only(const Pou& program) {
  Task task;
  task.name = "default";
  a_.model.tasks.push_back(std::move(task));
  add_calls(add_instance(program.spelling, program, 0, program.where));
}

void Configurer::declare_task(const syntax::TaskDeclaration& declaration) {
  ExpressionAnalyzer expressions(a_, nullptr);
  Task task;
  task.name = std::string(declaration.name.text);
  for (std::size_t i = resource_tasks_.first; i < a_.model.tasks.size(); ++i)
    if (naming::same_name(a_.model.tasks[i].name, task.name))
      a_.error(code::kDuplicate, declaration.name.where,
               "there is another task " + quote(task.name) + " in this resource");
  set_interval(declaration, task);
  if (declaration.priority) {
    const Type* type = a_.type_table().elementary(ElementaryType::Udint);
    if (const auto value = expressions.constant(*declaration.priority, type))
      task.priority = static_cast<std::uint32_t>(value->integer);
  }
  add_task(std::move(task), declaration.name.where);
}

void Configurer::add_task(Task task, Position where) {
  if (a_.model.tasks.size() == bytecode::kMaxTasks)
    a_.error(code::kBadTask, where,
             "a program has at most " + std::to_string(bytecode::kMaxTasks) +
                 " tasks, one for each program without a task included",
             "let a task run several programs: PROGRAM ... WITH the same task");
  a_.model.tasks.push_back(std::move(task));
}

void Configurer::set_interval(const syntax::TaskDeclaration& declaration, Task& task) {
  if (!declaration.interval) {
    task.interval_us = 0;  // runs on its trigger or, without one, again and again
    return;
  }
  ExpressionAnalyzer expressions(a_, nullptr);
  const auto value =
      expressions.constant(*declaration.interval, a_.type_table().elementary(ElementaryType::Time));
  if (!value) return;
  const auto us = static_cast<std::int64_t>(value->integer / 1000);
  const bool none = value->integer == 0 && declaration.single;
  if (!none && (us < 1 || us > kMaxIntervalUs || value->integer % 1000 != 0)) {
    a_.error(code::kBadTask, declaration.interval->where,
             "an interval is a whole number of microseconds, at least one and at most an hour");
    return;
  }
  task.interval_us = static_cast<std::uint32_t>(us);
}

void Configurer::set_trigger(const syntax::TaskDeclaration& declaration, Task& task) {
  const Expression& source = *declaration.single;
  const auto place = trigger_place(source);
  if (!place) return;
  if (!place->type->is_bool() || !place->is_direct()) {
    a_.error(code::kBadTask, source.where,
             place->is_direct() ? "SINGLE is a BOOL, not " + place->type->name
                                : "the place of the trigger must be known when the program is compiled",
             "use a global BOOL, an address like %IX0.0 or an output of a program");
    return;
  }
  task.trigger = Trigger{path_of(source), copy_direct(*place)};
}

std::optional<Place> Configurer::trigger_place(const Expression& source) {
  switch (source.kind) {
    case ExpressionKind::Field:
      if (auto output = program_output(source)) return output;
      [[fallthrough]];
    case ExpressionKind::Variable:
    case ExpressionKind::Index:
    case ExpressionKind::Direct: {
      // A configuration sees what a program without variables sees.
      Pou outside;
      return ExpressionAnalyzer(a_, &outside).places().place(source, Access::Read);
    }
    case ExpressionKind::Error:
      return std::nullopt;
    default:
      a_.error(code::kBadTask, source.where, "SINGLE is a variable: its rising edge runs the task",
               "use a global BOOL, an address like %IX0.0 or an output of a program");
      return std::nullopt;
  }
}

// instance.output, [resource.]instance.output; nothing, and no report, if it is none.
std::optional<Place> Configurer::program_output(const Expression& source) {
  const Expression& owner = *source.operands[0];
  const bool qualified = owner.kind == ExpressionKind::Field;
  for (const Instance& each : instances_) {
    const ProgramInstance& instance = a_.model.instances[each.index];
    if (!naming::same_name(instance.name, owner.name.text)) continue;
    if (qualified && !naming::same_name(name_of(each), owner.operands[0]->name.text)) continue;
    const Variable* output = instance.program->find(source.name.id);
    if (output == nullptr || output->section != Section::Output || output->type == nullptr)
      return std::nullopt;
    Place place;
    place.base = Base::Data;
    place.offset = instance.offset + output->place.offset;
    place.type = output->type;
    return place;
  }
  return std::nullopt;
}

// Scans look at the triggers: without an interval there would be none.
void Configurer::check_clock() const {
  const auto& tasks = a_.model.tasks;
  const bool ticks = std::any_of(tasks.begin(), tasks.end(),
                                 [](const Task& each) { return each.interval_us > 0 || !each.trigger; });
  if (tasks.empty() || ticks || a_.sink.has_errors()) return;
  a_.error(code::kBadTask, configuration_.name.where,
           "no task has an INTERVAL: nothing looks at the triggers",
           "give one task an interval, which says how often the triggers are looked at");
}

}  // namespace stepwright::semantics::internal
