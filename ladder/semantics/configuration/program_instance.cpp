// Instances of programs, their connections, and function blocks with tasks of their own (6.8.2).

#include <algorithm>
#include <limits>
#include <utility>

#include "ladder/semantics/calls/call_analyzer.h"
#include "ladder/semantics/configuration/configurer.h"
#include "ladder/source/suggestion.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::semantics::internal {

namespace {

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

Place part_of_this(std::uint32_t offset, const Type* type) {
  Place place;
  place.base = Base::This;
  place.offset = offset;
  place.type = type;
  return place;
}

Statement assign(Place target, Place source, Position where) {
  Statement copy;
  copy.kind = StatementKind::Assign;
  copy.where = where;
  copy.target = std::move(target);
  copy.value = load(std::move(source), where);
  return copy;
}

}  // namespace

void note_block_tasks(Analysis& a, const syntax::Unit& unit) {
  for (const syntax::Configuration& configuration : unit.configurations)
    for (const syntax::Resource& resource : configuration.resources)
      for (const syntax::ProgramDeclaration& program : resource.programs) {
        if (program.broken) continue;
        const auto pou = a.pous.find(program.type.id.value);
        if (pou == a.pous.end()) continue;
        for (const syntax::BlockTask& each : program.block_tasks)
          a.run_by_tasks[pou->second].push_back(each.block.id);
      }
}

// Among those of the resource.
std::optional<std::size_t> Configurer::find_task(const syntax::Name& name) const {
  const auto& tasks = a_.model.tasks;
  std::vector<std::string_view> candidates;
  for (std::size_t i = resource_tasks_.first; i < resource_tasks_.end; ++i) {
    if (naming::same_name(tasks[i].name, name.text)) return i;
    candidates.push_back(tasks[i].name);
  }
  a_.error(code::kUnknownTask, name.where, "there is no task " + quote(name.text),
           source::did_you_mean(name.text, candidates));
  return std::nullopt;
}

// A program without a task runs behind all others, and again as soon as it has ended (6.8.2).
std::size_t Configurer::background_task(const syntax::Name& program) {
  Task task;
  task.name = std::string(program.text) + ".background";
  task.priority = std::numeric_limits<std::uint32_t>::max();
  task.interval_us = 0;
  add_task(std::move(task), program.where);
  return a_.model.tasks.size() - 1;
}

void Configurer::declare_program(const syntax::ProgramDeclaration& declaration, std::size_t resource) {
  if (declaration.broken) return;
  const syntax::Name& name = declaration.name;
  const Pou* program = find_program(a_, declaration.type);
  const auto task = declaration.task ? find_task(*declaration.task) : std::optional(background_task(name));
  if (!task) return;
  for (const ProgramInstance& other : a_.model.instances)
    if (naming::same_name(other.name, name.text))
      a_.error(code::kDuplicate, name.where, "there is another program instance " + quote(name.text),
               "the resources of a configuration share their names here");
  if (program == nullptr) return;
  Instance& added = add_instance(std::string(name.text), *program, *task, name.where);
  added.declaration = &declaration;
  added.resource = resource;
  ProgramInstance& instance = a_.model.instances[added.index];
  if (declaration.retain) instance.retention = Retention::Kept;
  if (declaration.non_retain) instance.retention = Retention::Lost;
}

Configurer::Instance& Configurer::add_instance(const std::string& name, const Pou& program, std::size_t task,
                                               Position where) {
  const Place place = a_.allocate_place(program.type, where);
  Instance added;
  added.task = task;
  added.index = a_.model.instances.size();
  a_.model.instances.push_back({name, &program, place.offset, Retention::Unsaid});
  return instances_.emplace_back(std::move(added));
}

void Configurer::add_calls(Instance& instance) {
  const ProgramInstance& made = a_.model.instances[instance.index];
  const Pou& program = *made.program;
  const syntax::ProgramDeclaration* declaration = instance.declaration;
  const Position where = declaration != nullptr ? declaration->name.where : program.where;
  check_addresses(instance, program, made.name, 0);
  const bool has_in_out = std::any_of(program.variables.begin(), program.variables.end(),
                                      [](const Variable& each) { return each.section == Section::InOut; });
  const bool connected = declaration != nullptr && !declaration->connections.empty();
  const Pou* entry = &program;
  const bool copies = std::any_of(instance.located.begin(), instance.located.end(),
                                  [](const Located& each) { return each.copied; });
  if (connected || has_in_out || copies) {
    Pou& runner = make_runner(instance, made.name, where);
    Statement call;
    call.kind = StatementKind::Instance;
    call.where = where;
    call.target = part_of_this(0, program.type);
    runner.callees.push_back(&program);
    if (!connect(instance, runner, call)) return;
    copy_located(instance, 0, program.type->size, true, runner);
    runner.body.push_back(std::move(call));
    copy_located(instance, 0, program.type->size, false, runner);
    entry = &runner;
  }
  a_.model.tasks[instance.task].calls.push_back({made.name, entry, made.offset});
  if (declaration == nullptr) return;
  for (const syntax::BlockTask& each : declaration->block_tasks) add_block_call(instance, each);
  // The body is shared: a block that a task runs in one instance must have a task in all.
  const auto given = a_.run_by_tasks.find(&program);
  if (given == a_.run_by_tasks.end()) return;
  for (const NameId block : given->second) {
    const auto& tasks = declaration->block_tasks;
    const bool known =
        std::any_of(tasks.begin(), tasks.end(), [&](const auto& each) { return each.block.id == block; });
    if (known) continue;
    const Variable* variable = program.find(block);
    a_.error(code::kBadConnection, where,
             "another instance of " + quote(program.spelling) + " gives " +
                 quote(variable != nullptr ? variable->spelling : "") + " a task, this one does not",
             "give the block a task in all instances of the program or in none");
    return;
  }
}

void Configurer::add_block_call(const Instance& instance, const syntax::BlockTask& given) {
  const ProgramInstance& made = a_.model.instances[instance.index];
  const Variable* block = made.program->find(given.block.id);
  const auto task = find_task(given.task);
  if (!task || (block != nullptr && block->type == nullptr)) return;
  const bool is_block =
      block != nullptr && block->type->kind == TypeKind::Instance && block->place.base == Base::This;
  if (!is_block) {
    a_.error(code::kBadConnection, given.block.where,
             quote(made.program->spelling) + " has no function block " + quote(given.block.text));
    return;
  }
  const Pou& pou = *block->type->pou;
  for (const Variable& each : pou.variables) {
    if (each.section != Section::InOut) continue;
    a_.error(code::kBadConnection, given.block.where,
             quote(each.spelling) + " of " + quote(pou.spelling) + " is VAR_IN_OUT: a task cannot run it",
             "what VAR_IN_OUT stands for is known in the call only");
    return;
  }
  const std::uint32_t begin = block->place.offset;
  const std::uint32_t end = begin + block->type->size;
  Pou& runner = make_runner(instance, made.name + "." + block->spelling, given.block.where);
  Statement call;
  call.kind = StatementKind::Instance;
  call.where = given.block.where;
  call.target = part_of_this(begin, block->type);
  runner.callees.push_back(&pou);
  copy_located(instance, begin, end, true, runner);
  runner.body.push_back(std::move(call));
  copy_located(instance, begin, end, false, runner);
  a_.model.tasks[*task].calls.push_back({runner.spelling, &runner, made.offset});
}

Pou& Configurer::make_runner(const Instance& instance, std::string name, Position where) {
  auto pou = std::make_unique<Pou>();
  pou->spelling = std::move(name);
  pou->kind = PouKind::Program;
  pou->where = where;
  pou->end = where;
  pou->type = a_.model.instances[instance.index].program->type;
  a_.model.pous.push_back(std::move(pou));
  return *a_.model.pous.back();
}

// Located variables of the instance that lie in [from, to).
void Configurer::copy_located(const Instance& instance, std::uint32_t from, std::uint32_t to, bool before,
                              Pou& runner) {
  for (const Located& each : instance.located) {
    if (!each.copied || each.offset < from || each.offset >= to) continue;
    if (each.area.base == (before ? Base::Output : Base::Input)) continue;
    Place member = part_of_this(each.offset, each.area.type);
    Place area = copy_direct(each.area);
    runner.body.push_back(before ? assign(std::move(member), std::move(area), runner.where)
                                 : assign(std::move(area), std::move(member), runner.where));
  }
}

// A configuration connects to constants, globals and addresses, and so not to what is computed.
bool Configurer::is_connectable(const syntax::Argument& argument) const {
  if (!argument.value) return true;
  const bool sign = argument.value->kind == syntax::ExpressionKind::Unary &&
                    (argument.value->operands[0]->kind == syntax::ExpressionKind::Integer ||
                     argument.value->operands[0]->kind == syntax::ExpressionKind::Real);
  if (sign) return true;
  switch (argument.value->kind) {
    case syntax::ExpressionKind::Unary:
    case syntax::ExpressionKind::Binary:
    case syntax::ExpressionKind::Call:
      a_.error(code::kBadConnection, argument.value->where,
               "a program is connected to constants, global variables and addresses",
               "compute the value in a program and connect the variable that holds it");
      return false;
    default:
      return true;
  }
}

bool Configurer::connect(const Instance& instance, Pou& runner, Statement& call) {
  const Pou& program = *a_.model.instances[instance.index].program;
  if (instance.declaration != nullptr)
    for (const syntax::Argument& each : instance.declaration->connections) {
      if (!is_connectable(each)) return false;
      if (each.formal) continue;
      a_.error(code::kBadConnection, each.value->where, "a connection names its variable",
               "write input := source, output => target");
      return false;
    }
  static const std::vector<syntax::Argument> kNone;
  const auto& connections = instance.declaration != nullptr ? instance.declaration->connections : kNone;
  ExpressionAnalyzer expressions(a_, &runner);
  return CallAnalyzer(a_, expressions, &runner).pass_arguments(connections, program, runner.where, call);
}

}  // namespace stepwright::semantics::internal
