#pragma once

// Sheets of a program, to be printed: the other way to read sources beside `compile`. Texts become listings,
// tables of declarations and charts; drawn POUs become rungs and charts.
//
// Pure, as `compile` is. Types are not checked: a program that is not finished can be printed.
//
//   Result<std::vector<graphic::Sheet>> sheets = driver::sheets_of(input);

#include <vector>

#include "ladder/driver/compile.h"
#include "ladder/graphic/sheet.h"
#include "runtime/ground/result/result.h"

namespace stepwright::driver {

// Fails with what `compile` says about syntax, charts and diagrams.
[[nodiscard]] result::Result<std::vector<graphic::Sheet>> sheets_of(const CompileInput& input);

}  // namespace stepwright::driver
