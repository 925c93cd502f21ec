// Data types, initial values and variables of PLCopen TC6 XML as ST text.

#include <algorithm>

#include "ladder/exchange/plcopen_read.h"
#include "ladder/graphic/identifier.h"
#include "ladder/graphic/type_text.h"

namespace stepwright::exchange::plcopen {
namespace {

namespace code = source::code;

pugi::xml_node first_element(pugi::xml_node node) {
  for (const pugi::xml_node each : node.children())
    if (each.type() == pugi::node_element) return each;
  return {};
}

std::string array_type(ReadContext& context, pugi::xml_node array) {
  std::string bounds;
  for (const pugi::xml_node each : array.children()) {
    if (local_name(each) != "dimension") continue;
    bounds += (bounds.empty() ? "" : ", ") + context.required(each, "lower") + ".." +
              context.required(each, "upper");
  }
  return "ARRAY[" + bounds + "] OF " + read_type(context, child(array, "baseType"));
}

std::string enumeration_type(ReadContext& context, pugi::xml_node enumeration) {
  std::string values;
  for (const pugi::xml_node each : child(enumeration, "values").children()) {
    if (local_name(each) != "value") continue;
    values += (values.empty() ? "" : ", ") + context.required_name(each, "name");
    if (const pugi::xml_attribute value = each.attribute("value"))
      values += std::string(" := ") + value.value();
  }
  const pugi::xml_node base = child(enumeration, "baseType");
  return (base ? read_type(context, base) + " " : "") + "(" + values + ")";
}

std::string structure_type(ReadContext& context, pugi::xml_node structure) {
  std::vector<graphic::StructureMember> members;
  for (const pugi::xml_node each : structure.children()) {
    if (local_name(each) != "variable") continue;
    members.push_back({context.required_name(each, "name"), each.attribute("address").value(),
                       read_type(context, child(each, "type")),
                       read_value(context, child(each, "initialValue"))});
  }
  return graphic::structure_text(members);
}

std::string subrange_type(ReadContext& context, pugi::xml_node subrange) {
  const pugi::xml_node range = child(subrange, "range");
  return read_type(context, child(subrange, "baseType")) + "(" + context.required(range, "lower") + ".." +
         context.required(range, "upper") + ")";
}

// A simple value inside of an array or structure: quoted where it would not hold together as it is. Whether
// others are strings, which stand in files without quotes, is known when all types are
// (graphic::with_quotes).
std::string part_value(const std::string& value) {
  const bool expression =
      !value.empty() && std::string_view("'\"([").find(value.front()) != std::string::npos;
  const auto count = [&](char c) { return std::count(value.begin(), value.end(), c); };
  const bool whole = count('(') == count(')') && count('[') == count(']') && count('\'') % 2 == 0 &&
                     count('"') % 2 == 0 && graphic::split_outside(value, ',').size() < 2 &&
                     graphic::split_outside(value, ';').size() < 2;
  return expression || whole ? value : graphic::string_literal(value, false);
}

}  // namespace

std::string read_type(ReadContext& context, pugi::xml_node node) {
  const pugi::xml_node type = first_element(node);
  const std::string name(local_name(type));
  if (!type) {
    context.error(node, code::kNotPlcopen, "a type is missing", "name one, such as <BOOL/>");
    return "BOOL";
  }
  if (name == "array") return array_type(context, type);
  if (name == "derived") return context.required(type, "name");
  if (name == "enum") return enumeration_type(context, type);
  if (name == "struct") return structure_type(context, type);
  if (name == "subrangeSigned" || name == "subrangeUnsigned") return subrange_type(context, type);
  if (name == "pointer") return "REF_TO " + read_type(context, child(type, "baseType"));
  const std::string upper = graphic::upper(name);
  if (upper == "STRING" || upper == "WSTRING") {
    const pugi::xml_attribute length = type.attribute("length");
    return length ? upper + "[" + length.value() + "]" : upper;
  }
  return upper;
}

std::string read_value(ReadContext& context, pugi::xml_node node) {
  const pugi::xml_node value = first_element(node);
  const std::string_view name = local_name(value);
  if (!value) return {};
  if (name == "simpleValue") return value.attribute("value").value();
  std::string text;
  const bool array = name == "arrayValue";
  for (const pugi::xml_node each : value.children()) {
    if (local_name(each) != "value") continue;
    if (!text.empty()) text += ", ";
    const bool simple = local_name(first_element(each)) == "simpleValue";
    const std::string part = simple ? part_value(read_value(context, each)) : read_value(context, each);
    const std::string repetition = each.attribute("repetitionValue").value();
    if (!array) text += context.required(each, "member") + " := ";
    text += array && !repetition.empty() && repetition != "1" ? repetition + "(" + part + ")" : part;
  }
  return array ? "[" + text + "]" : "(" + text + ")";
}

void read_variables(ReadContext& context, pugi::xml_node list, graphic::VariableSection section,
                    std::vector<graphic::Variable>& variables, std::vector<graphic::VariableList>& lists) {
  lists.push_back(
      {context.documentation(list), extra_of(list, {"constant", "retain"}, {"variable", "documentation"})});
  for (const pugi::xml_node node : list.children()) {
    if (local_name(node) != "variable") continue;
    graphic::Variable variable;
    variable.name = context.required_name(node, "name");
    variable.type = read_type(context, child(node, "type"));
    variable.section = section;
    variable.address = node.attribute("address").value();
    variable.initial = read_value(context, child(node, "initialValue"));
    variable.constant = context.boolean(list, "constant");
    variable.retain = context.boolean(list, "retain");
    variable.comment = context.documentation(node);
    variable.list = static_cast<std::uint32_t>(lists.size());
    variable.extra = extra_of(node, {"name", "address"}, {"type", "initialValue", "documentation"});
    variable.where = context.file().offset(node);
    variables.push_back(std::move(variable));
  }
}

}  // namespace stepwright::exchange::plcopen
