#pragma once

// Writes a project as PLCopen TC6 XML 2.01 (namespace http://www.plcopen.org/xml/tc6_0201): interfaces, ST,
// LD and SFC bodies with their layout, one configuration with one resource, its tasks and program instances.
// Pure function; the same project and options give the same bytes.
//
//   Result<std::string> xml = write_plcopen(project);

#include <string>

#include "ladder/graphic/project.h"
#include "runtime/ground/result/result.h"

namespace stepwright::exchange {

struct PlcopenOptions {
  std::string company = "Stepwright";
  std::string product = "Stepwright";
  std::string version = "0.1";
  std::string time = "2000-01-01T00:00:00";  // creation time, xsd:dateTime; fixed so that output repeats
};

// Fails with the errors of graphic::check for a chart, with E0814 for a rung that holds statements which are
// not plain assignments (TC6 has no statement list in LD: export the chart instead), with E0815 for a text
// that XML cannot hold.
[[nodiscard]] result::Result<std::string> write_plcopen(const graphic::Project& project,
                                                        const PlcopenOptions& options = {});

}  // namespace stepwright::exchange
