#include "ladder/exchange/plcopen_parts.h"

#include <algorithm>
#include <pugixml.hpp>

namespace stepwright::exchange::plcopen {

void add_text(pugi::xml_node parent, const char* name, const std::string& text) {
  pugi::xml_node paragraph = parent.append_child(name).append_child("xhtml:p");
  // CDATA keeps every byte of a program readable; its end mark and carriage returns need escapes.
  const bool escaped = text.find("]]>") != std::string::npos || text.find('\r') != std::string::npos;
  // A zero byte would end the text early: another character that XML does not have stands for it, and the
  // writer refuses it.
  std::string whole = text;
  std::replace(whole.begin(), whole.end(), '\0', '\x01');
  paragraph.append_child(escaped ? pugi::node_pcdata : pugi::node_cdata).set_value(whole.c_str());
}

}  // namespace stepwright::exchange::plcopen
