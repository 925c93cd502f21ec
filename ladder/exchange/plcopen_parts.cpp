#include "ladder/exchange/plcopen_parts.h"

#include <pugixml.hpp>

namespace stepwright::exchange::plcopen {
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
  pugi::xml_node paragraph = parent.append_child(name).append_child("xhtml:p");
  // CDATA keeps every byte of a program readable; its end mark and bare carriage returns need escapes.
  const bool escaped = text.find("]]>") != std::string::npos || text.find('\r') != std::string::npos;
  paragraph.append_child(escaped ? pugi::node_pcdata : pugi::node_cdata).set_value(text.c_str());
}

}  // namespace stepwright::exchange::plcopen
