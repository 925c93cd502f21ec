#include "ladder/driver/declaration_text.h"

namespace stepwright::driver {

std::string DeclarationText::variable(const graphic::Variable& variable) const {
  std::string text = graphic::keyword_of(variable.section);
  if (variable.constant) text += " CONSTANT";
  if (variable.retain) text += " RETAIN";
  text += " " + variable.name;
  if (!variable.address.empty()) text += " AT " + variable.address;
  text += " : " + graphic::with_quotes_inside(variable.type, behind_);
  if (!variable.initial.empty())
    text += " := " + graphic::with_quotes(variable.initial, variable.type, behind_);
  return text + "; END_VAR";
}

std::vector<graphic::Variable> DeclarationText::quoted(std::vector<graphic::Variable> variables) const {
  for (graphic::Variable& each : variables) {
    each.initial = graphic::with_quotes(each.initial, each.type, behind_);
    each.type = graphic::with_quotes_inside(each.type, behind_);
  }
  return variables;
}

std::string DeclarationText::types(const graphic::Project& project, const Mark& mark) const {
  std::string text;
  for (const graphic::DataType& each : project.types) {
    text += mark(each.where) + "TYPE " + each.name + " : " + graphic::with_quotes_inside(each.type, behind_);
    if (!each.initial.empty()) text += " := " + graphic::with_quotes(each.initial, each.type, behind_);
    text += "; END_TYPE\n";
  }
  return text;
}

std::string DeclarationText::globals(std::vector<graphic::Variable> variables, const Mark& mark) const {
  std::string text;
  for (graphic::Variable& each : variables) {
    each.section = graphic::VariableSection::Global;
    text += mark(each.where) + variable(each) + "\n";
  }
  return text;
}

namespace {

std::string task_text(const graphic::Task& task) {
  std::string list;
  if (!task.single.empty()) list = "SINGLE := " + task.single + ", ";
  if (task.interval_us != 0) list += "INTERVAL := T#" + std::to_string(task.interval_us) + "us, ";
  return "TASK " + task.name + "(" + list + "PRIORITY := " + std::to_string(task.priority) + ");\n";
}

std::string instance_text(const graphic::ProgramInstance& instance) {
  const std::string task = instance.task.empty() ? "" : " WITH " + instance.task;
  return "PROGRAM " + instance.name + task + " : " + instance.program + ";\n";
}

// Tasks and instances of one resource.
std::string items_text(const graphic::Project& project, std::size_t resource, const Mark& mark) {
  std::string text;
  for (const graphic::Task& each : project.tasks)
    if (each.resource == resource) text += mark(each.where) + task_text(each);
  for (const graphic::ProgramInstance& each : project.instances)
    if (each.resource == resource) text += mark(each.where) + instance_text(each);
  return text;
}

}  // namespace

std::string DeclarationText::configuration(const graphic::Project& project, const Mark& mark) const {
  const std::string shared = globals(project.globals, mark);
  if (project.tasks.empty() && project.instances.empty()) return shared;
  const std::string name =
      project.configuration.empty() ? std::string("project_configuration") : project.configuration;
  std::string text = mark(project.configuration_where) + "CONFIGURATION " + name + "\n" + shared;
  if (project.resources.empty()) text += items_text(project, 0, mark);
  for (std::size_t i = 0; i < project.resources.size(); ++i) {
    const graphic::Resource& resource = project.resources[i];
    text += mark(project.configuration_where) + "RESOURCE " + resource.name + " ON PLC\n" +
            globals(resource.globals, mark) + items_text(project, i, mark) + "END_RESOURCE\n";
  }
  return text + "END_CONFIGURATION\n";
}

}  // namespace stepwright::driver
