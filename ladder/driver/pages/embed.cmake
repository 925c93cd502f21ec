# Writes the pages of diagnostics as a C++ source: cmake -DOUTPUT=F -DINPUTS=E0101.md,... -P embed.cmake
string(REPLACE "," ";" inputs "${INPUTS}")
set(ENTRIES "")
foreach(input IN LISTS inputs)
  file(READ "${input}" text)
  get_filename_component(code "${input}" NAME_WE)
  string(APPEND ENTRIES "    {\"${code}\", R\"PAGE(${text})PAGE\"},\n")
endforeach()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[#include "ladder/driver/diagnostic_pages.h"

namespace stepwright::driver {

namespace {

constexpr DiagnosticPage kPages[] = {
@ENTRIES@};

}  // namespace

std::span<const DiagnosticPage> diagnostic_pages() {
  return kPages;
}

}  // namespace stepwright::driver
]])
