#pragma once

// The rules of TC6 XML 2.01 for the elements that this folder reads and writes: which attributes and children
// they must and may have, in which order. Internal to this folder and its tests; pure functions.

#include <pugixml.hpp>
#include <string>
#include <vector>

namespace stepwright::exchange::plcopen {

struct SchemaFault {
  pugi::xml_node node;  // the element that breaks the rule
  std::string message;  // "<coil> has no child <variable>"
};

enum class Strictness {
  Required,  // what must be there is there: a file that is read may hold more than we know
  Older,     // the same, but for what came with version 2
  Complete,  // and nothing else, in the order of the schema: what we write
};

// Every broken rule below `project`, in the order of the file.
std::vector<SchemaFault> schema_faults(pugi::xml_node project, Strictness strictness);

}  // namespace stepwright::exchange::plcopen
