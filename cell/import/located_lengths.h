#pragma once

// Bits that the variables of a project take at their addresses: an array or a structure more than its address
// says. The compiler is asked, which lays them out. Not thread-safe.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "ladder/source/dialect.h"

namespace stepwright::cell_import {

// Of each address that a variable of the project has, as it is written. What cannot be known is not there,
// and a line of `left`.
std::map<std::string, std::uint32_t> located_lengths(const graphic::Project& project,
                                                     const source::Dialect& dialect,
                                                     std::vector<std::string>& left);

}  // namespace stepwright::cell_import
