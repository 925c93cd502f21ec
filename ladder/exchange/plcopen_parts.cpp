#include "ladder/exchange/plcopen_parts.h"

#include <pugixml.hpp>

namespace stepwright::exchange::plcopen {

void add_text(pugi::xml_node parent, const char* name, const std::string& text) {
  pugi::xml_node paragraph = parent.append_child(name).append_child("xhtml:p");
  // CDATA keeps every byte of a program readable; its end mark and bare carriage returns need escapes.
  const bool escaped = text.find("]]>") != std::string::npos || text.find('\r') != std::string::npos;
  paragraph.append_child(escaped ? pugi::node_pcdata : pugi::node_cdata).set_value(text.c_str());
}

}  // namespace stepwright::exchange::plcopen
