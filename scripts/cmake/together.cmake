# Several source files read by one run of the compiler, which then sees the headers and makes the templates that they share
# once: less than half of the time of compiling a test. Each stays a file of its own, complete with its headers: the debug
# preset, and -DSTEPWRIGHT_TOGETHER=OFF, compile one by one. A file that gives a name of its own to something else
# than a file beside it ("redefinition", "ambiguous"), or that is compiled with a setting of its own, is named after APART.

option(STEPWRIGHT_TOGETHER "Compile several files by one run of the compiler" ON)
set(STEPWRIGHT_TOGETHER_MOST 8)

# Sets RESULT to what is to be compiled for SOURCES: files of this folder in groups, all else as it is.
# The groups name files from the project's root, so that they are the same in every clone (for the compiler cache).
# APART: what is compiled by itself.
function(_stepwright_together target result)
  cmake_parse_arguments(ARG "" "" "SOURCES;APART" ${ARGN})
  set(alone ${ARG_APART})
  set(files "")
  foreach(source IN LISTS ARG_SOURCES)
    get_filename_component(path ${source} ABSOLUTE)
    if(path MATCHES "^${PROJECT_SOURCE_DIR}/.*\\.cpp$" AND EXISTS ${path} AND NOT path MATCHES "^${PROJECT_BINARY_DIR}/")
      file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${path})
      list(APPEND files ${path})
    else()
      list(APPEND alone ${source})
    endif()
  endforeach()
  list(LENGTH files count)
  if(NOT STEPWRIGHT_TOGETHER OR count LESS 2)
    set(${result} ${ARG_SOURCES} ${ARG_APART} PARENT_SCOPE)
    return()
  endif()
  math(EXPR groups "(${count} + ${STEPWRIGHT_TOGETHER_MOST} - 1) / ${STEPWRIGHT_TOGETHER_MOST}")
  math(EXPR last "${groups} - 1")
  foreach(group RANGE ${last})
    math(EXPR first "${group} * ${count} / ${groups}")
    math(EXPR length "(${group} + 1) * ${count} / ${groups} - ${first}")
    list(SUBLIST files ${first} ${length} members)
    list(TRANSFORM members REPLACE "(.+)" "#include \"\\1\"")
    list(JOIN members "\n" content)
    set(path ${CMAKE_CURRENT_BINARY_DIR}/${target}_${group}.cpp)
    file(CONFIGURE OUTPUT ${path} CONTENT "${content}\n" @ONLY)
    list(APPEND alone ${path})
  endforeach()
  set(${result} ${alone} PARENT_SCOPE)
endfunction()
