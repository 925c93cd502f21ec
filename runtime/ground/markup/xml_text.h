#pragma once

// Text within XML: pictures, reports, exchanged projects. Functions without state; any thread.
//
//   out += "<title>" + markup::xml_escaped(name) + "</title>";

#include <string>

namespace stepwright::markup {

// True if XML 1.0 in UTF-8 has a form for every character.
bool is_xml_text(const std::string& text);

// Escapes what XML reserves; control characters become spaces, bytes that are no UTF-8 U+FFFD.
std::string xml_escaped(const std::string& text);

}  // namespace stepwright::markup
