#include "ladder/exchange/plcopen_parts.h"

#include <algorithm>
#include <array>
#include <pugixml.hpp>

#include "ladder/graphic/identifier.h"

namespace stepwright::exchange::plcopen {
namespace {

constexpr std::array<const char*, 20> elementary{"BOOL",  "BYTE", "WORD",  "DWORD", "LWORD", "SINT",  "INT",
                                                 "DINT",  "LINT", "USINT", "UINT",  "UDINT", "ULINT", "REAL",
                                                 "LREAL", "TIME", "DATE",  "DT",    "TOD",   "ANY"};

std::string without_spaces(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c != ' ' && c != '\t' && c != '\n') result += c;
  }
  return result;
}

// "ARRAY[0..3,1..2]OF INT": the bounds as dimensions, the rest as the base type. False if it is none.
bool add_array(pugi::xml_node parent, const std::string& type) {
  const std::string name = graphic::upper(type);
  const std::size_t open = name.find('[');
  const std::size_t close = name.find(']');
  const std::size_t of = name.find("OF", close == std::string::npos ? 0 : close);
  if (name.rfind("ARRAY", 0) != 0 || open == std::string::npos || close == std::string::npos ||
      of == std::string::npos) {
    return false;
  }
  pugi::xml_node array = parent.append_child("array");
  const std::string bounds = without_spaces(type.substr(open + 1, close - open - 1));
  for (std::size_t begin = 0; begin < bounds.size();) {
    const std::size_t end = std::min(bounds.find(',', begin), bounds.size());
    const std::string range = bounds.substr(begin, end - begin);
    const std::size_t dots = std::min(range.find(".."), range.size());
    pugi::xml_node dimension = array.append_child("dimension");
    dimension.append_attribute("lower") = range.substr(0, dots).c_str();
    dimension.append_attribute("upper") = range.substr(std::min(dots + 2, range.size())).c_str();
    begin = end + 1;
  }
  add_type(array.append_child("baseType"), type.substr(of + 2));
  return true;
}

}  // namespace

pugi::xml_node Body::add(const char* name, int x, int y, int width, int height) {
  pugi::xml_node node = parent_.append_child(name);
  node.append_attribute("localId") = next_id_++;
  node.append_attribute("width") = width;
  node.append_attribute("height") = height;
  pugi::xml_node position = node.append_child("position");
  position.append_attribute("x") = x;
  position.append_attribute("y") = y;
  return node;
}

void add_point_in(pugi::xml_node parent, const std::vector<Source>& sources) {
  pugi::xml_node point = parent.append_child("connectionPointIn");
  for (const Source& source : sources) {
    pugi::xml_node connection = point.append_child("connection");
    connection.append_attribute("refLocalId") = source.id;
    if (!source.output.empty()) connection.append_attribute("formalParameter") = source.output.c_str();
  }
}

void add_point_out(pugi::xml_node parent, const char* formal_parameter) {
  pugi::xml_node point = parent.append_child("connectionPointOut");
  if (formal_parameter != nullptr) point.append_attribute("formalParameter") = formal_parameter;
}

void add_text(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).append_child("xhtml:p").append_child(pugi::node_pcdata).set_value(text.c_str());
}

void add_type(pugi::xml_node parent, const std::string& type) {
  std::string name = type;
  name.erase(0, name.find_first_not_of(" \t\n"));
  name.erase(name.find_last_not_of(" \t\n") + 1);
  if (add_array(parent, name)) return;
  name = graphic::upper(without_spaces(name));
  if (name == "TIME_OF_DAY") name = "TOD";
  if (name == "DATE_AND_TIME") name = "DT";
  if (std::find(elementary.begin(), elementary.end(), name) != elementary.end()) {
    parent.append_child(name.c_str());
  } else if (name.rfind("STRING", 0) == 0 || name.rfind("WSTRING", 0) == 0) {
    pugi::xml_node node = parent.append_child(name[0] == 'W' ? "wstring" : "string");
    const std::size_t open = name.find_first_of("[(");
    if (open != std::string::npos) {
      node.append_attribute("length") = name.substr(open + 1, name.size() - open - 2).c_str();
    }
  } else {
    parent.append_child("derived").append_attribute("name") = without_spaces(type).c_str();
  }
}

}  // namespace stepwright::exchange::plcopen
