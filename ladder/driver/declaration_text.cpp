#include "ladder/driver/declaration_text.h"

namespace stepwright::driver {

namespace {

const char* section_word(graphic::VariableSection section) {
  switch (section) {
    case graphic::VariableSection::Local:
      return "VAR";
    case graphic::VariableSection::Temp:
      return "VAR_TEMP";
    case graphic::VariableSection::Input:
      return "VAR_INPUT";
    case graphic::VariableSection::Output:
      return "VAR_OUTPUT";
    case graphic::VariableSection::InOut:
      return "VAR_IN_OUT";
    case graphic::VariableSection::External:
      return "VAR_EXTERNAL";
    case graphic::VariableSection::Global:
      break;
  }
  return "VAR_GLOBAL";
}

}  // namespace

std::string declaration_text(const graphic::Variable& variable) {
  std::string text = section_word(variable.section);
  if (variable.constant) text += " CONSTANT";
  if (variable.retain) text += " RETAIN";
  text += " " + variable.name;
  if (!variable.address.empty()) text += " AT " + variable.address;
  text += " : " + variable.type;
  if (!variable.initial.empty()) text += " := " + variable.initial;
  return text + "; END_VAR";
}

std::string configuration_text(const graphic::Project& project) {
  std::string text;
  for (graphic::Variable each : project.globals) {
    each.section = graphic::VariableSection::Global;
    text += declaration_text(each) + "\n";
  }
  if (project.tasks.empty() && project.instances.empty()) return text;
  text += "CONFIGURATION project_configuration\n";
  for (const graphic::Task& task : project.tasks) {
    text += "TASK " + task.name + "(INTERVAL := T#" + std::to_string(task.interval_us) +
            "us, PRIORITY := " + std::to_string(task.priority) + ");\n";
  }
  for (const graphic::ProgramInstance& instance : project.instances)
    text += "PROGRAM " + instance.name + " WITH " + instance.task + " : " + instance.program + ";\n";
  return text + "END_CONFIGURATION\n";
}

}  // namespace stepwright::driver
