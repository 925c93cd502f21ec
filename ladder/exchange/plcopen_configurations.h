#pragma once

// Choice of the configuration of a PLCopen file that is read. A file of a plant has one for each device, and
// a program of ours is that of one device.
//
// Pure functions of the file; internal to this folder.

#include <string>
#include <string_view>
#include <vector>

#include "ladder/exchange/plcopen_read.h"

namespace stepwright::exchange::plcopen {

// The one that is called `name`; of an empty name the only one, where the dialect says so the only one that
// runs a program. A null node if the file has none, or after a report that names those that there are.
pugi::xml_node chosen_configuration(ReadContext& context, pugi::xml_node instances, std::string_view name);

// The programs that other configurations run and `chosen` does not.
std::vector<std::string> programs_of_others(pugi::xml_node instances, pugi::xml_node chosen);

}  // namespace stepwright::exchange::plcopen
