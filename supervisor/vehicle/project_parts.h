#pragma once

// Parts of a project that is made by program: variables, and programs of one task that run in the order in
// which they are added. Pure functions of values.
//
//   project.globals.push_back(global_variable("arc", "REAL", "how far it has come, m"));
//   add_text(project, "fleet", "sensing", text, {instance("read", "MC_ReadVehicle")});

#include <string>
#include <vector>

#include "ladder/graphic/project.h"

namespace stepwright::vehicle {

graphic::Variable global_variable(std::string name, std::string type, std::string comment,
                                  std::string address = {}, std::string initial = {});
// A local variable, most often of a function block.
graphic::Variable instance(std::string name, std::string type);

// A program and its instance, of one name. Text and chart get as VAR_EXTERNAL the globals that the project
// has by now and that they mention; `locals` besides.
void add_program(graphic::Project& project, const char* task, graphic::Pou pou);
void add_text(graphic::Project& project, const char* task, const std::string& name, const std::string& text,
              std::vector<graphic::Variable> locals);
void add_chart(graphic::Project& project, const char* task, const std::string& name, graphic::SfcChart chart);

}  // namespace stepwright::vehicle
