#pragma once

// Elements that several kinds of PLCopen bodies share. Internal to this folder.

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "runtime/result/result.h"

namespace pugi {
class xml_node;
}

namespace stepwright::exchange::plcopen {

// Where a connection comes from: an element and, if it has several outputs, the name of one.
struct Source {
  std::uint64_t id = 0;
  std::string output;
};

// The graphical elements of one body, numbered from 1.
class Body {
 public:
  explicit Body(pugi::xml_node& parent) : parent_(parent) {}
  // A new element with its localId, size and position.
  pugi::xml_node add(const char* name, int x, int y, int width, int height);
  std::uint64_t last_id() const { return next_id_ - 1; }

 private:
  pugi::xml_node& parent_;
  std::uint64_t next_id_ = 1;
};

void add_point_in(pugi::xml_node parent, const std::vector<Source>& sources);
void add_point_out(pugi::xml_node parent, const char* formal_parameter = nullptr);
// Text in a paragraph of XHTML below an element `name`.
void add_text(pugi::xml_node parent, const char* name, const std::string& text);
// The type of a variable from its ST text.
void add_type(pugi::xml_node parent, const std::string& type);

// The initial value of a variable or type from its ST text.
void add_value(pugi::xml_node parent, const std::string& value);

// A body as it was drawn; with the actions and transitions of its POU.
void write_body(pugi::xml_node node, const graphic::DiagramBody& body);
void write_drawn(pugi::xml_node pou, const graphic::DrawnBody& drawn);

// SFC: requires a sound chart. LD: fails with E0601.
void write_sfc(pugi::xml_node body, const graphic::SfcChart& chart);
[[nodiscard]] result::Diagnostics write_ladder(pugi::xml_node body, const graphic::Pou& pou);

}  // namespace stepwright::exchange::plcopen
