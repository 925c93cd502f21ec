#pragma once

// Reads a PLCopen file structurally: do its elements stand in the order of the schema, do its connections
// resolve, and which chart do they make. Independent of the writer.

#include <pugixml.hpp>
#include <set>
#include <string>
#include <vector>

namespace stepwright::exchange {

// Errors of a body (ids used twice, connections to nothing, children out of order); empty if nothing.
std::vector<std::string> faults_of(pugi::xml_node body);

// "A+B -T1-> C" for every transition of an SFC body: sources and targets as the connections lead to them.
std::multiset<std::string> transitions_of(pugi::xml_node sfc);

}  // namespace stepwright::exchange
