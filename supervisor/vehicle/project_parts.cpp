#include "supervisor/vehicle/project_parts.h"

#include <utility>

#include "ladder/graphic/externals.h"

namespace stepwright::vehicle {

graphic::Variable global_variable(std::string name, std::string type, std::string comment,
                                  std::string address, std::string initial) {
  graphic::Variable made = instance(std::move(name), std::move(type));
  made.section = graphic::VariableSection::Global;
  made.address = std::move(address);
  made.initial = std::move(initial);
  made.comment = std::move(comment);
  return made;
}

graphic::Variable instance(std::string name, std::string type) {
  graphic::Variable made;
  made.name = std::move(name);
  made.type = std::move(type);
  return made;
}

void add_program(graphic::Project& project, const char* task, graphic::Pou pou) {
  project.instances.push_back({pou.name, pou.name, task});
  project.pous.push_back(std::move(pou));
}

void add_text(graphic::Project& project, const char* task, const std::string& name, const std::string& text,
              std::vector<graphic::Variable> locals) {
  graphic::Pou pou;
  pou.name = name;
  pou.variables = graphic::externals(project.globals, text);
  for (graphic::Variable& local : locals) pou.variables.push_back(std::move(local));
  pou.body = graphic::StBody{text};
  add_program(project, task, std::move(pou));
}

void add_chart(graphic::Project& project, const char* task, const std::string& name,
               graphic::SfcChart chart) {
  graphic::Pou pou;
  pou.name = name;
  pou.variables = graphic::externals(project.globals, graphic::text_of(chart));
  pou.body = std::move(chart);
  add_program(project, task, std::move(pou));
}

}  // namespace stepwright::vehicle
