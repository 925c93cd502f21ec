#include "ladder/exchange/plcopen_writer.h"

#include <pugixml.hpp>
#include <sstream>

#include "ladder/exchange/plcopen_parts.h"
#include "ladder/graphic/identifier.h"

namespace stepwright::exchange {
namespace {

using graphic::Pou;
using graphic::Project;
using graphic::Variable;
using graphic::VariableSection;
using result::Diagnostics;

const char* element_of(VariableSection section) {
  constexpr const char* names[] = {"localVars", "tempVars",     "inputVars", "outputVars",
                                   "inOutVars", "externalVars", "globalVars"};
  return names[static_cast<std::size_t>(section)];
}

void write_variable(pugi::xml_node list, const Variable& variable) {
  pugi::xml_node node = list.append_child("variable");
  node.append_attribute("name") = variable.name.c_str();
  if (!variable.address.empty()) node.append_attribute("address") = variable.address.c_str();
  plcopen::add_type(node.append_child("type"), variable.type);
  if (!variable.initial.empty()) {
    node.append_child("initialValue").append_child("simpleValue").append_attribute("value") =
        variable.initial.c_str();
  }
  if (!variable.comment.empty()) plcopen::add_text(node, "documentation", variable.comment);
}

// Neighbours of the same section and attributes share a list, so that the order of declaration stays.
void write_variables(pugi::xml_node parent, const std::vector<Variable>& variables,
                     const char* element = nullptr) {
  const Variable* before = nullptr;
  pugi::xml_node list;
  for (const Variable& variable : variables) {
    if (before == nullptr || before->section != variable.section || before->constant != variable.constant ||
        before->retain != variable.retain) {
      list = parent.append_child(element != nullptr ? element : element_of(variable.section));
      if (variable.constant) list.append_attribute("constant") = true;
      if (variable.retain) list.append_attribute("retain") = true;
    }
    write_variable(list, variable);
    before = &variable;
  }
}

void write_actions(pugi::xml_node pou, const graphic::SfcChart& chart) {
  if (chart.actions.empty()) return;
  pugi::xml_node actions = pou.append_child("actions");
  for (const graphic::Action& action : chart.actions) {
    pugi::xml_node node = actions.append_child("action");
    node.append_attribute("name") = action.name.c_str();
    plcopen::add_text(node.append_child("body"), "ST", action.st_body);
  }
}

Diagnostics write_pou(pugi::xml_node pous, const Pou& pou) {
  constexpr const char* kinds[] = {"program", "functionBlock", "function"};
  pugi::xml_node node = pous.append_child("pou");
  node.append_attribute("name") = pou.name.c_str();
  node.append_attribute("pouType") = kinds[static_cast<std::size_t>(pou.kind)];
  pugi::xml_node interface = node.append_child("interface");
  if (pou.kind == graphic::PouKind::Function) {
    plcopen::add_type(interface.append_child("returnType"), pou.result_type);
  }
  write_variables(interface, pou.variables);
  if (const auto* chart = std::get_if<graphic::SfcChart>(&pou.body)) {
    Diagnostics diagnostics = graphic::check(*chart);
    if (result::has_errors(diagnostics)) return diagnostics;
    write_actions(node, *chart);
    plcopen::write_sfc(node.append_child("body"), *chart);
    return {};
  }
  pugi::xml_node body = node.append_child("body");
  if (const auto* st = std::get_if<graphic::StBody>(&pou.body)) {
    plcopen::add_text(body, "ST", st->text);
    return {};
  }
  return plcopen::write_ladder(body, pou);
}

void write_headers(pugi::xml_node project, const std::string& name, const PlcopenOptions& options) {
  pugi::xml_node file = project.append_child("fileHeader");
  file.append_attribute("companyName") = options.company.c_str();
  file.append_attribute("productName") = options.product.c_str();
  file.append_attribute("productVersion") = options.version.c_str();
  file.append_attribute("creationDateTime") = options.time.c_str();
  pugi::xml_node content = project.append_child("contentHeader");
  content.append_attribute("name") = name.c_str();
  pugi::xml_node info = content.append_child("coordinateInfo");
  for (const char* language : {"fbd", "ld", "sfc"}) {
    pugi::xml_node scaling = info.append_child(language).append_child("scaling");
    scaling.append_attribute("x") = 10;
    scaling.append_attribute("y") = 10;
  }
}

void write_instance(pugi::xml_node parent, const graphic::ProgramInstance& instance) {
  pugi::xml_node node = parent.append_child("pouInstance");
  node.append_attribute("name") = instance.name.c_str();
  node.append_attribute("typeName") = instance.program.c_str();
}

std::string interval_text(std::int64_t us) {
  return us % 1000 == 0 ? "T#" + std::to_string(us / 1000) + "ms" : "T#" + std::to_string(us) + "us";
}

void write_instances(pugi::xml_node root, const Project& project) {
  pugi::xml_node configuration =
      root.append_child("instances").append_child("configurations").append_child("configuration");
  configuration.append_attribute("name") = "config";
  pugi::xml_node resource = configuration.append_child("resource");
  resource.append_attribute("name") = "resource1";
  for (const graphic::Task& task : project.tasks) {
    pugi::xml_node node = resource.append_child("task");
    node.append_attribute("name") = task.name.c_str();
    node.append_attribute("interval") = interval_text(task.interval_us).c_str();
    node.append_attribute("priority") = task.priority;
    for (const graphic::ProgramInstance& instance : project.instances) {
      if (graphic::same_name(instance.task, task.name)) write_instance(node, instance);
    }
  }
  for (const graphic::ProgramInstance& instance : project.instances) {
    if (instance.task.empty()) write_instance(resource, instance);
  }
  write_variables(configuration, project.globals, "globalVars");
}

}  // namespace

result::Result<std::string> write_plcopen(const Project& project, const PlcopenOptions& options) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("project");
  root.append_attribute("xmlns") = "http://www.plcopen.org/xml/tc6_0201";
  root.append_attribute("xmlns:xhtml") = "http://www.w3.org/1999/xhtml";
  write_headers(root, project.name.empty() ? "stepwright" : project.name, options);
  pugi::xml_node types = root.append_child("types");
  types.append_child("dataTypes");
  pugi::xml_node pous = types.append_child("pous");
  Diagnostics diagnostics;
  for (const Pou& pou : project.pous) {
    for (result::Diagnostic& each : write_pou(pous, pou)) diagnostics.push_back(std::move(each));
  }
  if (result::has_errors(diagnostics)) return tl::unexpected<Diagnostics>(std::move(diagnostics));
  write_instances(root, project);
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

}  // namespace stepwright::exchange
