#include "ladder/exchange/plcopen_writer.h"

#include <pugixml.hpp>
#include <sstream>

#include "ladder/exchange/chart_drawing.h"
#include "ladder/exchange/drawing.h"
#include "ladder/exchange/exchange_codes.h"
#include "ladder/exchange/ladder_drawing.h"
#include "ladder/exchange/plcopen_parts.h"
#include "ladder/exchange/xml_file.h"
#include "ladder/graphic/identifier.h"
#include "runtime/ground/markup/xml_text.h"

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

void add_documentation(pugi::xml_node node, const std::string& text) {
  if (!text.empty()) plcopen::add_text(node, "documentation", text);
}

void write_variable(pugi::xml_node list, const Variable& variable) {
  pugi::xml_node node = list.append_child("variable");
  node.append_attribute("name") = variable.name.c_str();
  if (!variable.address.empty()) node.append_attribute("address") = variable.address.c_str();
  append_attributes(node, variable.extra);
  plcopen::add_type(node.append_child("type"), variable.type);
  if (!variable.initial.empty()) plcopen::add_value(node.append_child("initialValue"), variable.initial);
  append_children(node, variable.extra);
  add_documentation(node, variable.comment);
}

bool share_a_list(const Variable& a, const Variable& b) {
  return a.section == b.section && a.constant == b.constant && a.retain == b.retain && a.list == b.list;
}

// Neighbours of the same section and attributes share a list, so that the order of declaration stays.
void write_variables(pugi::xml_node parent, const std::vector<Variable>& variables,
                     const std::vector<graphic::VariableList>& lists, const char* element = nullptr) {
  for (std::size_t i = 0; i < variables.size();) {
    const Variable& first = variables[i];
    pugi::xml_node list = parent.append_child(element != nullptr ? element : element_of(first.section));
    if (first.constant) list.append_attribute("constant") = true;
    if (first.retain) list.append_attribute("retain") = true;
    const graphic::VariableList* more =
        first.list > 0 && first.list <= lists.size() ? &lists[first.list - 1] : nullptr;
    if (more != nullptr) append_attributes(list, more->extra);
    for (; i < variables.size() && share_a_list(first, variables[i]); ++i) write_variable(list, variables[i]);
    if (more == nullptr) continue;
    append_children(list, more->extra);
    add_documentation(list, more->documentation);
  }
}

void write_types(pugi::xml_node parent, const Project& project) {
  for (const graphic::DataType& type : project.types) {
    pugi::xml_node node = parent.append_child("dataType");
    node.append_attribute("name") = type.name.c_str();
    append_attributes(node, type.extra);
    plcopen::add_type(node.append_child("baseType"), type.type);
    if (!type.initial.empty()) plcopen::add_value(node.append_child("initialValue"), type.initial);
    append_children(node, type.extra);
    add_documentation(node, type.comment);
  }
}

// Every body as one that was drawn: a file that was read and a program that was planned are written alike.
result::Result<graphic::DrawnBody> drawn_body(const Pou& pou) {
  if (const auto* drawn = std::get_if<graphic::DrawnBody>(&pou.body)) return *drawn;
  graphic::DrawnBody drawn;
  if (const auto* st = std::get_if<graphic::StBody>(&pou.body)) {
    drawn.body.text = plain_text(st->text);
    return drawn;
  }
  if (const auto* chart = std::get_if<graphic::SfcChart>(&pou.body)) {
    Diagnostics diagnostics = graphic::check(*chart);
    if (result::has_errors(diagnostics)) return tl::unexpected(std::move(diagnostics));
    return draw_chart(*chart);
  }
  auto diagram = draw_ladder(std::get<graphic::LadderProgram>(pou.body), pou.name);
  if (!diagram) return result::forward(diagram);
  drawn.body.language = graphic::BodyLanguage::Diagram;
  drawn.body.diagram = std::move(*diagram);
  return drawn;
}

// What rungs carry from one place to another is a variable of the POU.
std::vector<Variable> variables_of(const Pou& pou) {
  std::vector<Variable> variables = pou.variables;
  const auto* ladder = std::get_if<graphic::LadderProgram>(&pou.body);
  if (ladder == nullptr) return variables;
  for (const graphic::Wire& wire : ladder->wires)
    variables.push_back({wire.name, wire.type, wire.keeps ? VariableSection::Local : VariableSection::Temp});
  return variables;
}

Diagnostics write_pou(pugi::xml_node pous, const Pou& pou) {
  constexpr const char* kinds[] = {"program", "functionBlock", "function"};
  pugi::xml_node node = pous.append_child("pou");
  node.append_attribute("name") = pou.name.c_str();
  node.append_attribute("pouType") = kinds[static_cast<std::size_t>(pou.kind)];
  append_attributes(node, pou.extra);
  pugi::xml_node interface = node.append_child("interface");
  if (pou.kind == graphic::PouKind::Function) {
    plcopen::add_type(interface.append_child("returnType"), pou.result_type);
  }
  write_variables(interface, variables_of(pou), pou.lists);
  append_children(interface, pou.interface_extra);
  const auto body = drawn_body(pou);
  if (!body) return body.error();
  plcopen::write_drawn(node, *body);
  append_children(node, pou.extra);
  add_documentation(node, pou.comment);
  return {};
}

void write_headers(pugi::xml_node project, const Project& from, const PlcopenOptions& options) {
  pugi::xml_node file = project.append_child("fileHeader");
  append_attributes(file, from.parts.file_header);
  append_children(file, from.parts.file_header);
  const std::pair<const char*, const std::string*> required[] = {{"companyName", &options.company},
                                                                 {"productName", &options.product},
                                                                 {"productVersion", &options.version},
                                                                 {"creationDateTime", &options.time}};
  for (const auto& [name, value] : required)
    if (!file.attribute(name)) file.append_attribute(name) = value->c_str();
  pugi::xml_node content = project.append_child("contentHeader");
  content.append_attribute("name") = from.name.empty() ? "stepwright" : from.name.c_str();
  append_attributes(content, from.parts.content_header);
  append_children(content, from.parts.content_header);
  if (child(content, "coordinateInfo")) return;
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
  append_attributes(node, instance.extra);
  append_children(node, instance.extra);
  add_documentation(node, instance.comment);
}

std::string interval_text(std::int64_t us) {
  return us % 1000 == 0 ? "T#" + std::to_string(us / 1000) + "ms" : "T#" + std::to_string(us) + "us";
}

void write_task(pugi::xml_node resource, const graphic::Task& task, const Project& project) {
  pugi::xml_node node = resource.append_child("task");
  node.append_attribute("name") = task.name.c_str();
  if (!task.single.empty()) node.append_attribute("single") = task.single.c_str();
  if (task.interval_us != 0) node.append_attribute("interval") = interval_text(task.interval_us).c_str();
  node.append_attribute("priority") = task.priority;
  append_attributes(node, task.extra);
  for (const graphic::ProgramInstance& instance : project.instances)
    if (instance.resource == task.resource && graphic::same_name(instance.task, task.name))
      write_instance(node, instance);
  append_children(node, task.extra);
  add_documentation(node, task.comment);
}

void write_resource(pugi::xml_node configuration, const graphic::Resource& resource, std::size_t index,
                    const Project& project) {
  pugi::xml_node node = configuration.append_child("resource");
  node.append_attribute("name") = resource.name.c_str();
  append_attributes(node, resource.extra);
  for (const graphic::Task& task : project.tasks)
    if (task.resource == index) write_task(node, task, project);
  write_variables(node, resource.globals, resource.lists, "globalVars");
  for (const graphic::ProgramInstance& instance : project.instances)
    if (instance.resource == index && instance.task.empty()) write_instance(node, instance);
  append_children(node, resource.extra);
  add_documentation(node, resource.comment);
}

void write_instances(pugi::xml_node root, const Project& project) {
  pugi::xml_node instances = root.append_child("instances");
  pugi::xml_node configurations = instances.append_child("configurations");
  const bool runs = !project.tasks.empty() || !project.instances.empty();
  if (!runs && project.configuration.empty() && project.resources.empty() && project.globals.empty()) {
    // A library has none.
    append_children(instances, project.parts.instances);
    return;
  }
  pugi::xml_node configuration = configurations.append_child("configuration");
  configuration.append_attribute("name") =
      project.configuration.empty() ? "config" : project.configuration.c_str();
  append_attributes(configuration, project.parts.configuration);
  for (std::size_t i = 0; i < project.resources.size(); ++i)
    write_resource(configuration, project.resources[i], i, project);
  if (project.resources.empty() && runs) {
    graphic::Resource only;
    only.name = "resource1";
    write_resource(configuration, only, 0, project);
  }
  write_variables(configuration, project.globals, project.global_lists, "globalVars");
  append_children(configuration, project.parts.configuration);
  add_documentation(configuration, project.parts.configuration_comment);
  append_children(instances, project.parts.instances);
}

// The first text that XML cannot hold.
struct TextCheck : pugi::xml_tree_walker {
  std::string bad;
  bool for_each(pugi::xml_node& node) override {
    bool good = markup::is_xml_text(node.value());
    for (const pugi::xml_attribute each : node.attributes()) good = good && markup::is_xml_text(each.value());
    if (good) return true;
    for (pugi::xml_node owner = node; owner && bad.empty(); owner = owner.parent())
      if (std::string_view(owner.name()) == "pou")
        bad = std::string("POU '") + owner.attribute("name").value() + "'";
    if (bad.empty()) bad = "the project";
    return false;
  }
};

}  // namespace

result::Result<std::string> write_plcopen(const Project& project, const PlcopenOptions& options) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("project");
  root.append_attribute("xmlns") = "http://www.plcopen.org/xml/tc6_0201";
  root.append_attribute("xmlns:xhtml") = "http://www.w3.org/1999/xhtml";
  append_attributes(root, project.parts.root);
  write_headers(root, project, options);
  pugi::xml_node types = root.append_child("types");
  write_types(types.append_child("dataTypes"), project);
  pugi::xml_node pous = types.append_child("pous");
  Diagnostics diagnostics;
  for (const Pou& pou : project.pous) {
    for (result::Diagnostic& each : write_pou(pous, pou)) diagnostics.push_back(std::move(each));
  }
  if (result::has_errors(diagnostics)) return tl::unexpected<Diagnostics>(std::move(diagnostics));
  write_instances(root, project);
  append_children(root, project.parts.root);
  TextCheck texts;
  document.traverse(texts);
  if (!texts.bad.empty())
    return result::fail(
        code::kNoXmlCharacter, {},
        texts.bad + " holds a text that XML cannot: a control character, or bytes that are no UTF-8",
        "remove the character, or save the source as UTF-8");
  std::ostringstream out;
  document.save(out, "  ");
  // A reader takes a bare carriage return for a line end; texts that hold one stand in no CDATA (add_text).
  std::string xml = out.str();
  for (std::size_t at = xml.find('\r'); at != std::string::npos; at = xml.find('\r', at))
    xml.replace(at, 1, "&#13;");
  return xml;
}

}  // namespace stepwright::exchange
