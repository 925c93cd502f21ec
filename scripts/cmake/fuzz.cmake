# libFuzzer targets: what is fuzzed is compiled again as a whole, by clang and instrumented, beside the project's compiler.
#
#   stepwright_fuzzer(fuzz_pddl SOURCES pddl_fuzzer.cpp pddl_run.cpp LIBRARIES runtime/ground/result supervisor/pddl/task LINK fmt)
#
# SOURCES are those of the caller's folder. Of LIBRARIES all sources are compiled, FILES names further ones from the root of
# the project; both go into an archive, so that what is not reached needs nothing to link with. DEFINES are for all of them.
# Does nothing unless STEPWRIGHT_FUZZ is on.

if(STEPWRIGHT_FUZZ)
  find_program(STEPWRIGHT_CLANG NAMES clang++-14 clang++)
  if(NOT STEPWRIGHT_CLANG)
    message(FATAL_ERROR "STEPWRIGHT_FUZZ needs clang++")
  endif()
endif()

function(_stepwright_fuzz_objects out fuzzer)
  set(objects "")
  foreach(source IN LISTS ARG_UNITS)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
    string(REPLACE "/" "_" name ${name})
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${fuzzer}/${name}.o)
    add_custom_command(OUTPUT ${object}
                       COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${STEPWRIGHT_CLANG} -std=c++20 -O1 -g1 -ffp-contract=off
                               -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined
                               -I${PROJECT_SOURCE_DIR} ${ARG_FLAGS} -MD -MF ${object}.d -c ${source} -o ${object}
                       DEPENDS ${source} DEPFILE ${object}.d VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set(${out} ${objects} PARENT_SCOPE)
endfunction()

function(stepwright_fuzzer fuzzer)
  if(NOT STEPWRIGHT_FUZZ)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;FILES;LINK;DEFINES" ${ARGN})
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${fuzzer})
  list(TRANSFORM ARG_DEFINES PREPEND "-D" OUTPUT_VARIABLE ARG_FLAGS)
  set(ARG_UNITS "")
  foreach(library IN LISTS ARG_LIBRARIES)
    string(REPLACE "/" "_" target stepwright_${library})
    get_target_property(sources ${target} SOURCES)
    if(NOT sources)
      continue()  # headers only
    endif()
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/${library}/)
    list(APPEND ARG_UNITS ${sources})
  endforeach()
  list(TRANSFORM ARG_FILES PREPEND ${PROJECT_SOURCE_DIR}/)
  list(APPEND ARG_UNITS ${ARG_FILES})
  _stepwright_fuzz_objects(fuzzed ${fuzzer})
  set(archive ${CMAKE_CURRENT_BINARY_DIR}/${fuzzer}/fuzzed.a)
  add_custom_command(OUTPUT ${archive} COMMAND ${CMAKE_COMMAND} -E rm -f ${archive} COMMAND ${CMAKE_AR} crs ${archive} ${fuzzed}
                     DEPENDS ${fuzzed} VERBATIM)
  list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE ARG_UNITS)
  _stepwright_fuzz_objects(own ${fuzzer})
  list(TRANSFORM ARG_LINK PREPEND "-l")
  set(program ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${fuzzer})
  add_custom_command(OUTPUT ${program}
                     COMMAND ${STEPWRIGHT_CLANG} -fsanitize=fuzzer,address,undefined ${own} ${archive} ${ARG_LINK} -o ${program}
                     DEPENDS ${own} ${archive} VERBATIM)
  add_custom_target(${fuzzer} ALL DEPENDS ${program})
endfunction()
