# Writes text files as a C++ source that defines one function, which gives them all by name:
#   cmake -DOUTPUT=F -DINPUTS=a.st,b.st -DHEADER=h.h -DTYPE=T -DFUNCTION=f [-DPREFIX=folder/] [-DNAME=NAME_WE]
#         [-DNAMESPACE=stepwright::driver] -P embed.cmake
# TYPE is an aggregate of name and text; NAME says how a file is called (get_filename_component; NAME by default).
if(NOT NAMESPACE)
  set(NAMESPACE stepwright::driver)
endif()
if(NOT NAME)
  set(NAME NAME)
endif()
string(REPLACE "," ";" inputs "${INPUTS}")
set(ENTRIES "")
foreach(input IN LISTS inputs)
  file(READ "${input}" text)
  get_filename_component(name "${input}" ${NAME})
  string(APPEND ENTRIES "    {\"${PREFIX}${name}\", R\"TEXT(${text})TEXT\"},\n")
endforeach()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[#include "@HEADER@"

namespace @NAMESPACE@ {

namespace {

constexpr @TYPE@ kTexts[] = {
@ENTRIES@};

}  // namespace

std::span<const @TYPE@> @FUNCTION@() {
  return kTexts;
}

}  // namespace @NAMESPACE@
]])
