#include "tests/unit/ladder/exchange/drawn_elements.h"

#include <sstream>

#include "ladder/exchange/plcopen_reader.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {

driver::CompileInput input_of(const graphic::Project& project) {
  driver::CompileInput input;
  input.projects = {&project};
  return input;
}

std::string in(const std::string& from) {
  std::istringstream ids(from);
  std::string text = "<connectionPointIn>";
  for (std::string id; ids >> id;) {
    const std::size_t colon = id.find(':');
    text += "<connection refLocalId=\"" + id.substr(0, colon) + "\"" +
            (colon == std::string::npos ? "" : " formalParameter=\"" + id.substr(colon + 1) + "\"") + "/>";
  }
  return text + "</connectionPointIn>";
}

std::string at(const std::string& element, int id, int x, int y, const std::string& inside,
               const std::string& attributes) {
  return "<" + element + " localId=\"" + std::to_string(id) + "\"" + attributes + "><position x=\"" +
         std::to_string(x) + "\" y=\"" + std::to_string(y) + "\"/>" + inside + "</" + element + ">\n";
}

std::string rail() {
  return at("leftPowerRail", 1, 0, 0, "<connectionPointOut formalParameter=\"\"/>");
}

std::string contact(int id, int x, int y, const std::string& from, const std::string& name,
                    const std::string& attributes) {
  return at("contact", id, x, y, in(from) + "<connectionPointOut/><variable>" + name + "</variable>",
            attributes);
}

std::string coil(int id, int x, int y, const std::string& from, const std::string& name,
                 const std::string& attributes) {
  return at("coil", id, x, y, in(from) + "<connectionPointOut/><variable>" + name + "</variable>",
            attributes);
}

std::string input(int id, int x, int y, const std::string& text) {
  return at("inVariable", id, x, y, "<connectionPointOut/><expression>" + text + "</expression>");
}

std::string output(int id, int x, int y, const std::string& from, const std::string& text) {
  return at("outVariable", id, x, y, in(from) + "<expression>" + text + "</expression>");
}

std::string block(int id, int x, int y, const std::string& type, const std::string& inputs,
                  const std::string& outputs) {
  std::string text = "<inputVariables>";
  std::istringstream pins(inputs);
  for (std::string pin; pins >> pin;) {
    const std::size_t equals = pin.find('=');
    text += "<variable formalParameter=\"" + pin.substr(0, equals) + "\">" + in(pin.substr(equals + 1)) +
            "</variable>";
  }
  text += "</inputVariables><inOutVariables/><outputVariables>";
  std::istringstream names(outputs);
  for (std::string pin; names >> pin;)
    text += "<variable formalParameter=\"" + pin + "\"><connectionPointOut/></variable>";
  return at("block", id, x, y, text + "</outputVariables>", " typeName=\"" + type + "\"");
}

std::string ints(const std::string& names, const std::string& type) {
  std::istringstream list(names);
  std::string text;
  for (std::string name; list >> name;)
    text += "<variable name=\"" + name + "\"><type><" + type + "/></type></variable>\n";
  return text;
}

std::string ladder(const std::string& variables, const std::string& body) {
  return editor_project(editor_program(variables, "<LD>\n" + rail() + body + "</LD>\n"));
}

std::string run(const std::string& xml, const std::string& inputs, const std::string& scans,
                const std::string& outputs, const std::string& text) {
  const auto project = read_plcopen("plc.xml", xml);
  if (!project) return result::to_string(project.error());
  driver::CompileInput given = input_of(*project);
  if (!text.empty()) given.texts.push_back({"beside.st", text});
  const auto compiled = driver::compile(given);
  if (!compiled) return result::to_string(compiled.error());
  support::CompiledProgram program(given);
  std::istringstream lines(scans);
  std::string all;
  for (std::string line; std::getline(lines, line, '|');) {
    std::istringstream names(inputs);
    for (std::string name; names >> name;)
      program.set("run." + name, (" " + line + " ").find(" " + name + " ") != std::string::npos ? 1 : 0);
    if (program.scan().trap) return all + "trap";
    std::istringstream shown(outputs);
    std::string values;
    for (std::string name; shown >> name;) values += std::to_string(program.get("run." + name));
    all += (all.empty() ? "" : " ") + values;
  }
  return all;
}

}  // namespace stepwright::exchange
