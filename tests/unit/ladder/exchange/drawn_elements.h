#pragma once

// Elements of drawn networks as XML, and what a project of them does scan by scan.

#include <string>

#include "ladder/driver/compile.h"
#include "ladder/graphic/project.h"

namespace stepwright::exchange {

driver::CompileInput input_of(const graphic::Project& project);

// <connectionPointIn> from these elements: "2 5:Q".
std::string in(const std::string& from);
// An element at a place; the inside follows its position.
std::string at(const std::string& element, int id, int x, int y, const std::string& inside,
               const std::string& attributes = "");
// Element 1.
std::string rail();
std::string contact(int id, int x, int y, const std::string& from, const std::string& name,
                    const std::string& attributes = "");
std::string coil(int id, int x, int y, const std::string& from, const std::string& name,
                 const std::string& attributes = "");
std::string input(int id, int x, int y, const std::string& text);
std::string output(int id, int x, int y, const std::string& from, const std::string& text);
// Pins as "EN=3 IN=4" and "ENO OUT".
std::string block(int id, int x, int y, const std::string& type, const std::string& inputs,
                  const std::string& outputs);

// <variable>s of a type, for each name.
std::string ints(const std::string& names, const std::string& type = "INT");
// A project with one program whose body is this ladder behind a rail.
std::string ladder(const std::string& variables, const std::string& body);

// Compiles a project, with an ST text beside it, and runs it. One line per scan: the inputs that are TRUE,
// "a b|a|"; gives the values of the outputs, one group per scan, or what is wrong.
std::string run(const std::string& xml, const std::string& inputs, const std::string& scans,
                const std::string& outputs, const std::string& text = {});

}  // namespace stepwright::exchange
