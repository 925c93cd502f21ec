// Types and initial values of PLCopen TC6 XML from their ST text.

#include <algorithm>
#include <array>
#include <cctype>
#include <pugixml.hpp>
#include <string_view>

#include "ladder/exchange/plcopen_parts.h"
#include "ladder/graphic/identifier.h"

namespace stepwright::exchange::plcopen {
namespace {

constexpr std::array<const char*, 30> elementary{
    "BOOL",     "BYTE",    "WORD",        "DWORD",          "LWORD",         "SINT",
    "INT",      "DINT",    "LINT",        "USINT",          "UINT",          "UDINT",
    "ULINT",    "REAL",    "LREAL",       "TIME",           "DATE",          "DT",
    "TOD",      "ANY",     "ANY_DERIVED", "ANY_ELEMENTARY", "ANY_MAGNITUDE", "ANY_NUM",
    "ANY_REAL", "ANY_INT", "ANY_BIT",     "ANY_STRING",     "ANY_DATE",      ""};

std::string trimmed(std::string_view text) {
  const char* blank = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(blank) + 1 - begin));
}

// Pieces of `text` between `separator`s that stand in no brackets and no string.
std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i == text.size() || (text[i] == separator && depth == 0)) {
      parts.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
      continue;
    }
    if (text[i] == '\'' || text[i] == '"') {
      const char quote = text[i];
      for (++i; i < text.size() && text[i] != quote; ++i)
        if (text[i] == '$') ++i;
      i = std::min(i, text.size() - 1);
    }
    if (text[i] == '(' || text[i] == '[') ++depth;
    if (text[i] == ')' || text[i] == ']') --depth;
  }
  if (!parts.empty() && parts.back().empty()) parts.pop_back();
  return parts;
}

// Where `what` stands in `text` outside of brackets and strings.
std::size_t find_outside(const std::string& text, const char* what) {
  const std::string_view wanted(what);
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (depth == 0 && text.compare(i, wanted.size(), wanted) == 0) return i;
    if (text[i] == '(' || text[i] == '[') ++depth;
    if (text[i] == ')' || text[i] == ']') --depth;
  }
  return std::string::npos;
}

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
  const std::size_t open = type.find('[');
  const std::size_t close = type.find(']');
  if (!starts(type, "ARRAY") || open == std::string::npos || close == std::string::npos) return false;
  const std::size_t of = graphic::upper(type).find("OF", close);
  if (of == std::string::npos) return false;
  pugi::xml_node array = parent.append_child("array");
  for (const std::string& range : split(type.substr(open + 1, close - open - 1), ','))
    add_range(array.append_child("dimension"), range);
  add_type(array.append_child("baseType"), type.substr(of + 2));
  return true;
}

// "STRUCT a : INT := 1; b AT %QW1 : REAL; END_STRUCT".
void add_structure(pugi::xml_node parent, const std::string& type) {
  pugi::xml_node structure = parent.append_child("struct");
  const std::size_t end = graphic::upper(type).rfind("END_STRUCT");
  for (const std::string& line : split(type.substr(6, std::min(end, type.size()) - 6), ';')) {
    const std::size_t colon = std::min(find_outside(line, ":"), line.size());
    std::string name = trimmed(line.substr(0, colon));
    const std::string rest = colon < line.size() ? line.substr(colon + 1) : "";
    const std::size_t assign = find_outside(rest, ":=");
    pugi::xml_node node = structure.append_child("variable");
    const std::size_t at = graphic::upper(name).find(" AT ");
    node.append_attribute("name") = name.substr(0, at).c_str();
    if (at != std::string::npos) node.append_attribute("address") = trimmed(name.substr(at + 4)).c_str();
    add_type(node.append_child("type"), rest.substr(0, assign));
    if (assign != std::string::npos) add_value(node.append_child("initialValue"), rest.substr(assign + 2));
  }
}

// "(Red, Green := 5)", "INT (A := 1)".
bool add_enumeration(pugi::xml_node parent, const std::string& type) {
  const std::size_t open = type.find('(');
  if (open == std::string::npos || type.back() != ')' || type.find("..") != std::string::npos) return false;
  if (starts(type, "STRING") || starts(type, "WSTRING")) return false;
  pugi::xml_node enumeration = parent.append_child("enum");
  pugi::xml_node values = enumeration.append_child("values");
  for (const std::string& each : split(type.substr(open + 1, type.size() - open - 2), ',')) {
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
  if (!starts(name, "STRING") && !starts(name, "WSTRING")) return false;
  pugi::xml_node node = parent.append_child(starts(name, "W") ? "wstring" : "string");
  const std::size_t open = name.find_first_of("[(");
  if (open != std::string::npos)
    node.append_attribute("length") = trimmed(name.substr(open + 1, name.size() - open - 2)).c_str();
  return true;
}

}  // namespace

void add_type(pugi::xml_node parent, const std::string& type) {
  std::string name = trimmed(type);
  if (name.empty()) return;
  if (starts(name, "STRUCT") && name.size() > 6 && std::isspace(static_cast<unsigned char>(name[6])) != 0)
    return add_structure(parent, name);
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
  for (const std::string& part : split(text.substr(1, text.size() - 2), ',')) {
    pugi::xml_node node = list.append_child("value");
    std::string own = part;
    if (structure) {
      const std::size_t assign = std::min(part.find(":="), part.size());
      node.append_attribute("member") = trimmed(part.substr(0, assign)).c_str();
      own = part.substr(std::min(assign + 2, part.size()));
    } else if (const std::size_t open = part.find('('); open != std::string::npos && open > 0 &&
                                                        part.back() == ')' &&
                                                        part.find_first_not_of("0123456789_") == open) {
      node.append_attribute("repetitionValue") = part.substr(0, open).c_str();
      own = part.substr(open + 1, part.size() - open - 2);
    }
    add_value(node, own);
  }
}

}  // namespace stepwright::exchange::plcopen
