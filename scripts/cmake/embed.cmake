# Writes text files as a C++ source that defines one function, which gives them all by name:
#   cmake -DOUTPUT=F -DINPUTS=a.st,b.st -DHEADER=h.h -DTYPE=T -DFUNCTION=f [-DPREFIX=folder/] [-DNAME=NAME_WE]
#         [-DNAMESPACE=stepwright::driver] -P embed.cmake
# TYPE is an aggregate of name and text; NAME says how a file is called (get_filename_component; NAME by default).
# -DFOLDERS=a,b -DDEPFILE=F.d in place of INPUTS: every *.md of these folders. The command depends on the folders, whose time
# changes when a file comes or goes, and by DEPFILE on each file, so that no build has to look through them.
if(NOT NAMESPACE)
  set(NAMESPACE stepwright::driver)
endif()
if(NOT NAME)
  set(NAME NAME)
endif()
string(REPLACE "," ";" inputs "${INPUTS}")
if(FOLDERS)
  string(REPLACE "," ";" patterns "${FOLDERS}")
  list(TRANSFORM patterns APPEND "/*.md")
  file(GLOB inputs ${patterns})
  list(SORT inputs)
  list(JOIN inputs " " files)
  file(WRITE "${DEPFILE}" "${OUTPUT}: ${files}\n")
endif()
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
