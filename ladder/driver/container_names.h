#pragma once

// Names of source files in a container: equal sources give equal bytes wherever they lie, and who reads a
// name in the folder of the compilation can open it. Pure functions; any thread.
//
// A relative name stays, in normal form. An absolute one becomes relative to `folder` if it lies below, else
// to the folder that all such files share; only if that makes two files one name do they keep their paths.

#include <string>
#include <string_view>
#include <vector>

#include "ladder/source/source_set.h"

namespace stepwright::driver {

// `folder`: absolute, or empty. Reads no file system.
std::vector<std::string> container_names(const std::vector<std::string>& names, std::string_view folder);

// Of each file of the set.
std::vector<std::string> container_names(const source::SourceSet& sources, std::string_view folder);

}  // namespace stepwright::driver
