#pragma once

// Elements that several kinds of PLCopen bodies share. Internal to this folder.

#include <string>

#include "ladder/graphic/project.h"

namespace pugi {
class xml_node;
}

namespace stepwright::exchange::plcopen {

// Text in a paragraph of XHTML below an element `name`.
void add_text(pugi::xml_node parent, const char* name, const std::string& text);
// The type of a variable from its ST text.
void add_type(pugi::xml_node parent, const std::string& type);

// The initial value of a variable or type from its ST text.
void add_value(pugi::xml_node parent, const std::string& value);

// Name and namespace of what Stepwright adds to a chart (addData of its body):
// <chart xmlns="..." finalScan="true"/>.
inline constexpr const char* kChartData = "urn:stepwright:plcopen:chart:1";

// A body as it was drawn; with the actions and transitions of its POU.
void write_body(pugi::xml_node node, const graphic::DiagramBody& body);
void write_drawn(pugi::xml_node pou, const graphic::DrawnBody& drawn);

}  // namespace stepwright::exchange::plcopen
