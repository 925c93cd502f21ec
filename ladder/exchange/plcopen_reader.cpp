#include "ladder/exchange/plcopen_reader.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "ladder/exchange/duration.h"
#include "ladder/exchange/plcopen_configurations.h"
#include "ladder/exchange/plcopen_parts.h"
#include "ladder/exchange/plcopen_read.h"
#include "ladder/exchange/plcopen_schema.h"
#include "ladder/graphic/identifier.h"

namespace stepwright::exchange {
namespace plcopen {

namespace code = source::code;

void ReadContext::error(pugi::xml_node where, const char* code, std::string message, std::string hint) {
  result::Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.where = file_.location(file_.offset(where));
  diagnostic.message = std::move(message);
  diagnostic.hint = std::move(hint);
  diagnostics_.push_back(std::move(diagnostic));
}

std::string ReadContext::required(pugi::xml_node node, const char* attribute) {
  const char* value = node.attribute(attribute).value();
  if (*value == '\0')
    error(
        node, code::kNotPlcopen,
        std::string("the attribute '") + attribute + "' of <" + std::string(local_name(node)) + "> is empty",
        "give it a value");
  return value;
}

std::string ReadContext::required_name(pugi::xml_node node, const char* attribute) {
  std::string name = required(node, attribute);
  // Whether it is a name in the dialect is seen where it is used; this ends one there.
  const bool is_word = std::ranges::none_of(
      name, [](unsigned char c) { return c < 0x80 && c != '_' && c != '.' && std::isalnum(c) == 0; });
  if (!is_word)
    error(node, code::kNotPlcopen, "'" + name + "' of <" + std::string(local_name(node)) + "> is no name",
          "letters, digits and underscores, without blanks: " + graphic::make_identifier(name));
  return name;
}

bool ReadContext::boolean(pugi::xml_node node, const char* attribute) {
  const std::string_view value = node.attribute(attribute).value();
  if (value.empty() || value == "false" || value == "0") return false;
  if (value != "true" && value != "1")
    error(node, code::kNotPlcopen, std::string(attribute) + "=\"" + std::string(value) + "\" is no boolean",
          "write true or false");
  return true;
}

std::optional<double> ReadContext::decimal(pugi::xml_node node, const char* attribute) {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(found.value(), &end);
  const bool good = end != found.value() && *end == '\0' && value > -1e9 && value < 1e9;
  if (!good)
    error(node, code::kNotPlcopen, std::string(attribute) + "=\"" + found.value() + "\" is no coordinate");
  return good ? value : 0;
}

std::optional<std::uint64_t> ReadContext::number(pugi::xml_node node, const char* attribute) {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) return std::nullopt;
  const std::string_view text = found.value();
  const bool digits =
      !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == std::string_view::npos;
  if (!digits)
    error(node, code::kNotPlcopen, std::string(attribute) + "=\"" + found.value() + "\" is no number");
  return digits ? std::strtoull(found.value(), nullptr, 10) : 0;
}

std::string ReadContext::documentation(pugi::xml_node node) const {
  return file_.source_text(child(node, "documentation")).text;
}

namespace {

using graphic::Pou;
using graphic::Project;
using graphic::VariableSection;

std::optional<VariableSection> section_of(std::string_view list) {
  if (list == "localVars") return VariableSection::Local;
  if (list == "tempVars") return VariableSection::Temp;
  if (list == "inputVars") return VariableSection::Input;
  if (list == "outputVars") return VariableSection::Output;
  if (list == "inOutVars") return VariableSection::InOut;
  if (list == "externalVars") return VariableSection::External;
  if (list == "globalVars") return VariableSection::Global;
  return std::nullopt;
}

class ProjectReader {
 public:
  ProjectReader(ReadContext& context, Project& project, std::string_view configuration)
      : context_(context), project_(project), chosen_(configuration) {}

  void read(pugi::xml_node root) {
    if (local_name(root) != "project") {
      context_.error(root, code::kNotPlcopen, "this is no PLCopen project",
                     "the root of a TC6 XML file is <project>");
      return;
    }
    const auto older = schema_faults(root, Strictness::Older);
    const auto strictness = context_.dialect().old_exchange ? Strictness::Older : Strictness::Required;
    for (const SchemaFault& each : schema_faults(root, strictness)) {
      const bool of_version_2 = std::ranges::none_of(older, [&](const SchemaFault& old) {
        return old.node == each.node && old.message == each.message;
      });
      const std::string hint = "the schema of TC6 requires it";
      context_.error(each.node, code::kNotPlcopen, each.message,
                     of_version_2 ? source::with_dialects(hint, &source::Dialect::old_exchange) : hint);
    }
    if (context_.failed()) return;
    const pugi::xml_node header = child(root, "contentHeader");
    project_.name = header.attribute("name").value();
    project_.parts.root =
        extra_of(root, {"xmlns"}, {"fileHeader", "contentHeader", "types", "instances", "documentation"});
    project_.parts.file_header = extra_of(child(root, "fileHeader"), {}, {});
    project_.parts.content_header = extra_of(header, {"name"}, {});
    const pugi::xml_node types = child(root, "types");
    for (const pugi::xml_node node : child(types, "dataTypes").children())
      if (local_name(node) == "dataType") data_type(node);
    for (const pugi::xml_node node : child(types, "pous").children())
      if (local_name(node) == "pou") pou(node);
    instances(child(root, "instances"));
  }

 private:
  void data_type(pugi::xml_node node) {
    graphic::DataType type;
    type.name = context_.required_name(node, "name");
    type.type = read_type(context_, child(node, "baseType"));
    type.initial = read_value(context_, child(node, "initialValue"));
    type.comment = context_.documentation(node);
    type.extra = extra_of(node, {"name"}, {"baseType", "initialValue", "documentation"});
    type.where = context_.file().offset(node);
    project_.types.push_back(std::move(type));
  }

  void pou(pugi::xml_node node) {
    Pou pou;
    pou.name = context_.required_name(node, "name");
    pou.where = context_.file().offset(node);
    const std::string kind = context_.required(node, "pouType");
    if (kind == "function") pou.kind = graphic::PouKind::Function;
    if (kind == "functionBlock") pou.kind = graphic::PouKind::FunctionBlock;
    if (kind != "function" && kind != "functionBlock" && kind != "program")
      context_.error(node, code::kNotPlcopen, "there is no kind of POU '" + kind + "'",
                     "pouType is function, functionBlock or program");
    interface(child(node, "interface"), pou);
    pou.comment = context_.documentation(node);
    pou.extra =
        extra_of(node, {"name", "pouType"}, {"interface", "actions", "transitions", "body", "documentation"});
    graphic::DrawnBody drawn;
    named_bodies(child(node, "actions"), "action", drawn.actions);
    named_bodies(child(node, "transitions"), "transition", drawn.transitions);
    std::size_t bodies = 0;
    for (const pugi::xml_node each : node.children()) {
      if (local_name(each) != "body") continue;
      if (bodies++ == 0) {
        drawn.body = read_body(context_, each);
        drawn.final_scan = has_final_scan(each);
      } else {
        context_.error(each, code::kExchangeUnsupported,
                       "POU '" + pou.name + "' has several bodies (worksheets)", "join them into one");
      }
    }
    pou.body = std::move(drawn);
    project_.pous.push_back(std::move(pou));
  }

  bool has_final_scan(pugi::xml_node body) {
    for (const pugi::xml_node data : child(body, "addData").children())
      if (data.attribute("name").value() == std::string_view(kChartData))
        return context_.boolean(child(data, "chart"), "finalScan");
    return false;
  }

  void interface(pugi::xml_node node, Pou& pou) {
    const pugi::xml_node result = child(node, "returnType");
    if (result) pou.result_type = read_type(context_, result);
    for (const pugi::xml_node list : node.children())
      if (const auto section = section_of(local_name(list)))
        read_variables(context_, list, *section, pou.variables, pou.lists);
    pou.interface_extra = extra_of(node, {},
                                   {"returnType", "localVars", "tempVars", "inputVars", "outputVars",
                                    "inOutVars", "externalVars", "globalVars"});
  }

  void named_bodies(pugi::xml_node list, std::string_view element, std::vector<graphic::NamedBody>& out) {
    for (const pugi::xml_node node : list.children()) {
      if (local_name(node) != element) continue;
      graphic::NamedBody named;
      named.name = context_.required(node, "name");
      named.body = read_body(context_, child(node, "body"));
      named.documentation = context_.documentation(node);
      named.extra = extra_of(node, {"name"}, {"body", "documentation"});
      named.where = context_.file().offset(node);
      out.push_back(std::move(named));
    }
  }

  void instances(pugi::xml_node node) {
    const pugi::xml_node chosen = chosen_configuration(context_, node, chosen_);
    if (chosen) {
      configuration(chosen);
      leave_out(programs_of_others(node, chosen));
    }
    project_.parts.instances = extra_of(node, {}, {"configurations"});
  }

  // What only another device runs may name what only that device has.
  void leave_out(const std::vector<std::string>& programs) {
    std::erase_if(project_.pous, [&](const Pou& pou) {
      return pou.kind == graphic::PouKind::Program && std::ranges::any_of(programs, [&](const auto& each) {
               return graphic::same_name(each, pou.name);
             });
    });
  }

  void configuration(pugi::xml_node node) {
    project_.configuration = context_.required(node, "name");
    project_.configuration_where = context_.file().offset(node);
    for (const pugi::xml_node each : node.children()) {
      if (local_name(each) == "resource") resource(each);
      if (local_name(each) == "globalVars")
        read_variables(context_, each, VariableSection::Global, project_.globals, project_.global_lists);
    }
    project_.parts.configuration_comment = context_.documentation(node);
    project_.parts.configuration = extra_of(node, {"name"}, {"resource", "globalVars", "documentation"});
  }

  void resource(pugi::xml_node node) {
    graphic::Resource resource;
    resource.name = context_.required(node, "name");
    const auto index = static_cast<std::uint32_t>(project_.resources.size());
    for (const pugi::xml_node each : node.children()) {
      if (local_name(each) == "task") task(each, index);
      if (local_name(each) == "pouInstance") instance(each, {}, index);
      if (local_name(each) == "globalVars")
        read_variables(context_, each, VariableSection::Global, resource.globals, resource.lists);
    }
    resource.comment = context_.documentation(node);
    resource.extra = extra_of(node, {"name"}, {"task", "pouInstance", "globalVars", "documentation"});
    project_.resources.push_back(std::move(resource));
  }

  std::optional<std::int64_t> interval_us(const std::string& text) const {
    const source::Dialect& dialect = context_.dialect();
    std::optional<std::int64_t> us = duration_us(text);
    if (!us && dialect.exported_tasks) us = xsd_duration_us(text);
    if (!us && dialect.old_exchange) us = clock_duration_us(text);
    return us;
  }

  void task(pugi::xml_node node, std::uint32_t resource) {
    graphic::Task task;
    task.name = context_.required_name(node, "name");
    task.priority = static_cast<int>(context_.number(node, "priority").value_or(0) & 0xFFFFU);
    task.single = node.attribute("single").value();
    task.resource = resource;
    task.interval_us = 0;
    const std::string interval = node.attribute("interval").value();
    if (!interval.empty()) {
      const auto us = interval_us(interval);
      if (us && (*us > 0 || !task.single.empty())) {
        task.interval_us = *us;
      } else if (us) {
        context_.error(node, code::kNotPlcopen,
                       "task '" + task.name + "' has the interval '" + interval + "': it would never wait",
                       "how often it runs, such as T#20ms");
      } else {
        const std::string hint = "write it as T#20ms, in whole microseconds";
        context_.error(
            node, code::kNotPlcopen,
            "the interval '" + interval + "' of task '" + task.name + "' is no duration",
            xsd_duration_us(interval)     ? source::with_dialects(hint, &source::Dialect::exported_tasks)
            : clock_duration_us(interval) ? source::with_dialects(hint, &source::Dialect::old_exchange)
                                          : hint);
      }
    }
    task.comment = context_.documentation(node);
    task.extra = extra_of(node, {"name", "priority", "single", "interval"}, {"pouInstance", "documentation"});
    task.where = context_.file().offset(node);
    for (const pugi::xml_node each : node.children())
      if (local_name(each) == "pouInstance") instance(each, task.name, resource);
    project_.tasks.push_back(std::move(task));
  }

  // The type of a program instance: where the dialect says so, that of its name, or an older attribute.
  std::string type_of(pugi::xml_node node, const std::string& name) {
    if (*node.attribute("typeName").value() != '\0') return context_.required_name(node, "typeName");
    if (context_.dialect().old_exchange && !node.attribute("typeName"))
      return context_.required(node, "type");
    if (context_.dialect().exported_tasks) return name;
    context_.error(node, code::kNotPlcopen, "the attribute 'typeName' of <pouInstance> is empty",
                   source::with_dialects("name the program that it is an instance of",
                                         &source::Dialect::exported_tasks));
    return {};
  }

  void instance(pugi::xml_node node, const std::string& task, std::uint32_t resource) {
    graphic::ProgramInstance instance;
    instance.name = context_.required_name(node, "name");
    instance.program = type_of(node, instance.name);
    instance.task = task;
    instance.resource = resource;
    instance.comment = context_.documentation(node);
    instance.extra = extra_of(node, {"name", "typeName"}, {"documentation"});
    instance.where = context_.file().offset(node);
    project_.instances.push_back(std::move(instance));
  }

  ReadContext& context_;
  Project& project_;
  std::string_view chosen_;
};

}  // namespace
}  // namespace plcopen

result::Result<graphic::Project> read_plcopen(std::string name, std::string text,
                                              const source::Dialect& dialect,
                                              std::string_view configuration) {
  auto file = XmlFile::parse(std::move(name), std::move(text));
  if (!file) return result::forward(file);
  graphic::Project project;
  plcopen::ReadContext context(*file, dialect);
  plcopen::ProjectReader(context, project, configuration).read(file->root());
  if (context.failed()) return tl::unexpected(context.take());
  project.file_name = file->name();
  project.file_text = file->text();
  return project;
}

}  // namespace stepwright::exchange
