#pragma once

// Reads PLCopen TC6 XML 2.01 (also 2.0 files, whose elements are the same): data types, POUs with their ST,
// LD, FBD and SFC bodies as drawn, configurations. What the model has no place for - vendor data, unknown
// attributes - is kept beside it, and write_plcopen writes it back.
//
// A file may have several configurations, one for each device of a plant: one is read, with the programs that
// no other runs alone.
//
// Nothing is interpreted: bodies are Pou::body of kind DrawnBody, which the compiler lowers. Pure function.
//
//   Result<Project> project = read_plcopen("plc.xml", text);

#include <string>
#include <string_view>

#include "ladder/graphic/project.h"
#include "ladder/source/dialect.h"
#include "runtime/ground/result/result.h"

namespace stepwright::exchange {

// `configuration`: which one, if there are several. Fails with E0801 (no XML, too large, a document type),
// E0802 (not PLCopen, something missing or malformed) and E0804 (what is not supported), each at its line and
// column of the file.
[[nodiscard]] result::Result<graphic::Project> read_plcopen(
    std::string name, std::string text, const source::Dialect& dialect = source::standard_dialect(),
    std::string_view configuration = {});

}  // namespace stepwright::exchange
