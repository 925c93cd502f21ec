// Globals, tasks and program instances (IEC 61131-3, 6.8).

#include <utility>

#include "ladder/semantics/internal/declarer.h"
#include "ladder/source/suggestion.h"
#include "runtime/naming/ascii_names.h"

namespace stepwright::semantics::internal {

namespace {

// One nanosecond count must become a whole number of microseconds that fits the container.
constexpr std::int64_t kMaxIntervalUs = 3'600'000'000;

void declare_global(Analysis& a, const syntax::VariableDeclaration& line, const syntax::Name& name,
                    const Type* type) {
  Variable variable;
  variable.name = name.id;
  variable.spelling = std::string(name.text);
  variable.type = type;
  variable.section = Section::Global;
  variable.constant = line.constant;
  variable.retain = line.retain;
  variable.where = name.where;
  variable.place.type = type;
  if (type != nullptr) {
    ExpressionAnalyzer expressions(a, nullptr);
    std::vector<std::byte> bytes = type->initial;
    bytes.resize(type->size);
    bool sound = !line.initial || initialise(a, expressions, *line.initial, *type, bytes);
    if (sound && type->is_scalar() && line.constant) variable.value = load(*type, bytes);
    if (sound && line.address) {
      sound = locate(a, line, variable, bytes);
    } else if (sound) {
      variable.place = a.allocate_place(type, name.where);
      auto& data = a.model.area(Base::Data);
      if (data.size() >= variable.place.offset + bytes.size())
        std::copy(bytes.begin(), bytes.end(), data.begin() + variable.place.offset);
    }
    if (!sound) variable.type = nullptr;
  }
  const auto index = static_cast<std::uint32_t>(a.model.globals.size());
  if (!a.globals.try_emplace(name.id.value, index).second) {
    a.error(code::kDuplicate, name.where, "there is another global variable " + quote(name.text));
    return;
  }
  a.model.globals.push_back(std::move(variable));
}

const Pou* find_program(Analysis& a, const syntax::Name& name) {
  const auto found = a.pous.find(name.id.value);
  if (found != a.pous.end() && found->second->kind == PouKind::Program) return found->second;
  std::vector<std::string_view> candidates;
  for (const auto& each : a.model.pous)
    if (each->kind == PouKind::Program) candidates.push_back(each->spelling);
  a.error(code::kUnknownProgram, name.where, "there is no program " + quote(name.text),
          source::did_you_mean(name.text, candidates));
  return nullptr;
}

void add_instance(Analysis& a, Task& task, const std::string& name, const Pou& program, Position where) {
  const Place place = a.allocate_place(program.type, where);
  task.programs.push_back({name, &program, place.offset});
}

void declare_task(Analysis& a, const syntax::TaskDeclaration& declaration) {
  ExpressionAnalyzer expressions(a, nullptr);
  Task task;
  task.name = std::string(declaration.name.text);
  for (const Task& other : a.model.tasks)
    if (naming::same_name(other.name, task.name))
      a.error(code::kDuplicate, declaration.name.where, "there is another task " + quote(task.name));
  if (!declaration.interval) {
    a.error(code::kBadTask, declaration.name.where, "the task has no INTERVAL", "write (INTERVAL := T#10ms)");
  } else if (const auto value = expressions.constant(*declaration.interval,
                                                     a.type_table().elementary(ElementaryType::Time))) {
    const auto us = static_cast<std::int64_t>(value->integer / 1000);
    if (us < 1 || us > kMaxIntervalUs || value->integer % 1000 != 0) {
      a.error(code::kBadTask, declaration.interval->where,
              "an interval is a whole number of microseconds, at least one and at most an hour");
    } else {
      task.interval_us = static_cast<std::uint32_t>(us);
    }
  }
  if (declaration.priority) {
    const Type* type = a.type_table().elementary(ElementaryType::Udint);
    if (const auto value = expressions.constant(*declaration.priority, type))
      task.priority = static_cast<std::uint32_t>(value->integer);
  }
  a.model.tasks.push_back(std::move(task));
}

void declare_program(Analysis& a, const syntax::ProgramDeclaration& declaration) {
  const Pou* program = find_program(a, declaration.type);
  Task* task = nullptr;
  if (declaration.task) {
    for (Task& each : a.model.tasks)
      if (naming::same_name(each.name, declaration.task->text)) task = &each;
  }
  if (task == nullptr) {
    std::vector<std::string_view> candidates;
    for (const Task& each : a.model.tasks) candidates.push_back(each.name);
    const syntax::Name& place = declaration.task ? *declaration.task : declaration.name;
    a.error(code::kUnknownTask, place.where,
            declaration.task ? "there is no task " + quote(declaration.task->text)
                             : quote(declaration.name.text) + " runs in no task",
            declaration.task ? source::did_you_mean(declaration.task->text, candidates)
                             : "write WITH and a task");
    return;
  }
  for (const Task& each : a.model.tasks)
    for (const ProgramInstance& other : each.programs)
      if (naming::same_name(other.name, declaration.name.text))
        a.error(code::kDuplicate, declaration.name.where,
                "there is another program instance " + quote(declaration.name.text));
  if (program != nullptr)
    add_instance(a, *task, std::string(declaration.name.text), *program, declaration.name.where);
}

// Without a configuration the only program runs every 10 ms.
void configure_default(Analysis& a, std::size_t user_pous) {
  // A POU that could not be read may be the missing one, a second one of a name the one too many.
  if (a.sink.has_errors()) return;
  const Pou* only = nullptr;
  for (std::size_t i = 0; i < user_pous; ++i) {
    const Pou& each = *a.model.pous[i];
    if (each.kind != PouKind::Program) continue;
    if (only != nullptr) {
      a.error(code::kNoProgram, each.where, "several programs and no configuration that says when each runs",
              "add a CONFIGURATION with a TASK and PROGRAM ... WITH ...");
      return;
    }
    only = &each;
  }
  if (only == nullptr) {
    a.error(code::kNoProgram, Position(), "there is no PROGRAM to run");
    return;
  }
  Task task;
  task.name = "default";
  a.model.tasks.push_back(std::move(task));
  add_instance(a, a.model.tasks.back(), only->spelling, *only, only->where);
}

}  // namespace

void declare_globals(Analysis& a, TypeResolver& types,
                     const std::vector<syntax::VariableDeclaration>& lines) {
  for (const syntax::VariableDeclaration& line : lines) {
    const Type* type = types.resolve(*line.type);
    for (const syntax::Name& name : line.names) declare_global(a, line, name, type);
  }
}

void configure(Analysis& a, const syntax::Unit& unit, std::size_t user_pous) {
  if (unit.configurations.empty()) return configure_default(a, user_pous);
  if (unit.configurations.size() > 1) {
    a.error(code::kSeveralConfigurations, unit.configurations[1].name.where,
            "there is more than one configuration");
    return;
  }
  const syntax::Configuration& configuration = unit.configurations.front();
  bool has_programs = false;
  for (const syntax::Resource& resource : configuration.resources) {
    for (const syntax::TaskDeclaration& each : resource.tasks) declare_task(a, each);
    for (const syntax::ProgramDeclaration& each : resource.programs) declare_program(a, each);
    has_programs = has_programs || !resource.programs.empty();
  }
  if (!has_programs)
    a.error(code::kNoProgram, configuration.name.where, "the configuration runs no program",
            "write PROGRAM name WITH task : type;");
}

}  // namespace stepwright::semantics::internal
