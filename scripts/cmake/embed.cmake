# Writes the .st files of a folder as a C++ source: cmake -DOUTPUT=F -DINPUTS=a.st,b.st -P embed.cmake
string(REPLACE "," ";" inputs "${INPUTS}")
set(ENTRIES "")
foreach(input IN LISTS inputs)
  file(READ "${input}" text)
  get_filename_component(name "${input}" NAME)
  string(APPEND ENTRIES "    {\"library/${name}\", R\"ST(${text})ST\"},\n")
endforeach()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[#include "ladder/driver/library_texts.h"

namespace stepwright::driver {

namespace {

constexpr LibraryText kTexts[] = {
@ENTRIES@};

}  // namespace

std::span<const LibraryText> library_texts() {
  return kTexts;
}

}  // namespace stepwright::driver
]])
