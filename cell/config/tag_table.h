#pragma once

// Notes on tags for people as a table of comma-separated values (RFC 4180), as spreadsheets write it and the
// page gives it out: beside [tags] of a cell's configuration ([hmi] tags = "tags.csv").
//
//   name,unit,description,group,decimals,least,greatest,values
//   Main.level,l,level of the buffer,buffer,1,0,200,
//   Main.mode,,,,,,,off|by hand|automatic
//
// Columns in any order; all but `name` may be missing. A row that says nothing but a name says nothing; other
// columns (type, address) are for people. A tag of both is wrong.
//
// Diagnostics with their line: E0001 the file cannot be read, C0630 a name that is empty or there twice,
// C0631 a range with nothing in it, C0633 no table, or a field that is wrong; as a warning a column whose
// name is nearly one that is read.

#include <filesystem>
#include <vector>

#include "cell/config/tag_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::config {

// Adds to `tags`. An empty path: there is no table.
result::Diagnostics read_tag_table(const std::filesystem::path& file, std::vector<TagConfig>& tags);

}  // namespace stepwright::config
