// Types and initial values of PLCopen TC6 XML from their ST text.

#include <algorithm>
#include <array>
#include <pugixml.hpp>

#include "ladder/exchange/plcopen_parts.h"
#include "ladder/graphic/identifier.h"
#include "ladder/graphic/type_text.h"

namespace stepwright::exchange::plcopen {
namespace {

using graphic::split_outside;
using graphic::trimmed;

constexpr std::array<const char*, 30> elementary{
    "BOOL",     "BYTE",    "WORD",        "DWORD",          "LWORD",         "SINT",
    "INT",      "DINT",    "LINT",        "USINT",          "UINT",          "UDINT",
    "ULINT",    "REAL",    "LREAL",       "TIME",           "DATE",          "DT",
    "TOD",      "ANY",     "ANY_DERIVED", "ANY_ELEMENTARY", "ANY_MAGNITUDE", "ANY_NUM",
    "ANY_REAL", "ANY_INT", "ANY_BIT",     "ANY_STRING",     "ANY_DATE",      ""};

bool starts(const std::string& text, const char* word) {
  return graphic::upper(text).rfind(word, 0) == 0;
}

void add_range(pugi::xml_node node, const std::string& range) {
  const std::size_t dots = std::min(range.find(".."), range.size());
  node.append_attribute("lower") = trimmed(range.substr(0, dots)).c_str();
  node.append_attribute("upper") = trimmed(range.substr(std::min(dots + 2, range.size()))).c_str();
}

// "ARRAY[0..3, 1..2] OF INT"; false if it is none.
bool add_array(pugi::xml_node parent, const std::string& type) {
  const std::string element = graphic::element_type(type);
  if (element.empty()) return false;
  const std::size_t open = type.find('[');
  pugi::xml_node array = parent.append_child("array");
  for (const std::string& range : split_outside(type.substr(open + 1, type.find(']') - open - 1), ','))
    add_range(array.append_child("dimension"), range);
  add_type(array.append_child("baseType"), element);
  return true;
}

void add_structure(pugi::xml_node parent, const std::string& type) {
  pugi::xml_node structure = parent.append_child("struct");
  for (const graphic::StructureMember& member : graphic::members_of(type)) {
    pugi::xml_node node = structure.append_child("variable");
    node.append_attribute("name") = member.name.c_str();
    if (!member.address.empty()) node.append_attribute("address") = member.address.c_str();
    add_type(node.append_child("type"), member.type);
    if (!member.initial.empty()) add_value(node.append_child("initialValue"), member.initial);
  }
}

// "(Red, Green := 5)", "INT (A := 1)".
bool add_enumeration(pugi::xml_node parent, const std::string& type) {
  const std::size_t open = type.find('(');
  if (open == std::string::npos || type.back() != ')' || type.find("..") != std::string::npos) return false;
  if (graphic::is_string_type(type)) return false;
  pugi::xml_node enumeration = parent.append_child("enum");
  pugi::xml_node values = enumeration.append_child("values");
  for (const std::string& each : split_outside(type.substr(open + 1, type.size() - open - 2), ',')) {
    const std::size_t assign = each.find(":=");
    pugi::xml_node value = values.append_child("value");
    value.append_attribute("name") = trimmed(each.substr(0, assign)).c_str();
    if (assign != std::string::npos)
      value.append_attribute("value") = trimmed(each.substr(assign + 2)).c_str();
  }
  const std::string base = trimmed(type.substr(0, open));
  if (!base.empty()) add_type(enumeration.append_child("baseType"), base);
  return true;
}

// "INT(0..10)".
bool add_subrange(pugi::xml_node parent, const std::string& type) {
  const std::size_t open = type.find('(');
  if (open == std::string::npos || type.back() != ')' || type.find("..") == std::string::npos) return false;
  const std::string base = trimmed(type.substr(0, open));
  const std::string folded = graphic::upper(base);
  const bool is_unsigned = folded[0] == 'U' || folded == "BYTE" || folded.find("WORD") != std::string::npos;
  pugi::xml_node subrange = parent.append_child(is_unsigned ? "subrangeUnsigned" : "subrangeSigned");
  add_range(subrange.append_child("range"), type.substr(open + 1, type.size() - open - 2));
  add_type(subrange.append_child("baseType"), base);
  return true;
}

bool add_string(pugi::xml_node parent, const std::string& name) {
  if (!graphic::is_string_type(name)) return false;
  pugi::xml_node node = parent.append_child(graphic::is_wide_string_type(name) ? "wstring" : "string");
  const std::size_t open = name.find_first_of("[(");
  if (open != std::string::npos)
    node.append_attribute("length") = trimmed(name.substr(open + 1, name.size() - open - 2)).c_str();
  return true;
}

}  // namespace

void add_type(pugi::xml_node parent, const std::string& type) {
  std::string name = trimmed(type);
  if (name.empty()) return;
  if (graphic::is_structure(name)) return add_structure(parent, name);
  if (starts(name, "REF_TO "))
    return add_type(parent.append_child("pointer").append_child("baseType"), name.substr(7));
  if (add_array(parent, name) || add_subrange(parent, name) || add_enumeration(parent, name) ||
      add_string(parent, name))
    return;
  std::string folded = graphic::upper(name);
  if (folded == "TIME_OF_DAY") folded = "TOD";
  if (folded == "DATE_AND_TIME") folded = "DT";
  if (std::find(elementary.begin(), elementary.end(), folded) != elementary.end()) {
    parent.append_child(folded.c_str());
  } else {
    parent.append_child("derived").append_attribute("name") = name.c_str();
  }
}

void add_value(pugi::xml_node parent, const std::string& value) {
  const std::string text = trimmed(value);
  const bool array = !text.empty() && text.front() == '[' && text.back() == ']';
  const bool structure =
      !text.empty() && text.front() == '(' && text.back() == ')' && text.find(":=") != std::string::npos;
  if (!array && !structure) {
    parent.append_child("simpleValue").append_attribute("value") = text.c_str();
    return;
  }
  pugi::xml_node list = parent.append_child(array ? "arrayValue" : "structValue");
  for (const std::string& part : split_outside(text.substr(1, text.size() - 2), ',')) {
    pugi::xml_node node = list.append_child("value");
    if (structure) {
      const std::size_t assign = std::min(graphic::find_outside(part, ":="), part.size());
      node.append_attribute("member") = trimmed(part.substr(0, assign)).c_str();
      add_value(node, part.substr(std::min(assign + 2, part.size())));
      continue;
    }
    const auto [count, own] = graphic::repetition_of(part);
    if (count != "1") node.append_attribute("repetitionValue") = count.c_str();
    add_value(node, own);
  }
}

}  // namespace stepwright::exchange::plcopen
