# How every target of Stepwright is declared: folder = layer = namespace = target.
#
#   stepwright_library(runtime/vm PORTABLE SOURCES interpreter.cpp DEPENDS runtime/bytecode runtime/image)
#   stepwright_program(stepwright-link SOURCES main.cpp bridge.cpp DEPENDS cell/config runtime/dds)
#   stepwright_test(runtime/vm SOURCES interpreter_test.cpp)

include(${CMAKE_CURRENT_LIST_DIR}/together.cmake)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

find_program(STEPWRIGHT_MOLD mold)
if(STEPWRIGHT_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
if(STEPWRIGHT_SANITIZE)
  add_compile_options(-fsanitize=${STEPWRIGHT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${STEPWRIGHT_SANITIZE})
  if(STEPWRIGHT_SANITIZE MATCHES "undefined")
    # The check of virtual calls needs type information, which the portable core is built without.
    add_compile_options(-fno-sanitize=vptr)
  endif()
  if(STEPWRIGHT_SANITIZE MATCHES "thread")
    # g++ warns that this sanitizer does not see the fences of Boost.Asio; its mutexes, which it sees, order the same.
    add_compile_options(-Wno-tsan)
  endif()
endif()

# What is switched off: g++ 12 sees all of it in std::string and std::vector where it is not (GCC bugs 105329, 105562,
# 105651), most of all when the header was precompiled. The sanitizers' presets look for the same at run time.
# -ffp-contract=off: one meaning on every machine: no fused multiply-add behind the program's back.
set(STEPWRIGHT_COMPILE_OPTIONS -Wall -Wextra -Wshadow -Wconversion -Wnon-virtual-dtor -Wno-restrict -Wno-maybe-uninitialized
                               -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Werror -ffp-contract=off)

# For what computes little: tests, command lines, processes that wait for others, reading and writing of files. It makes the
# build a good deal shorter (a fifth less than -O1). Benchmarks and the baselines in them are compiled like what they measure.
set(STEPWRIGHT_LIGHT_OPTIONS $<$<CONFIG:Release>:-Og>)
set(STEPWRIGHT_LIGHT_FOLDERS
  "cell" "programs" "hmi_web/(access|alarms|api|client|protocol|recorder|server|storage)" "tests/support" "firmware/link"
  "ladder/(driver|exchange|print|source_files)" "runtime/(dds|exec|metrics|remote|replay|scan_test|trace)" "runtime/ground/(files|log|mqtt|process|settings)" "supervisor/(executive|model|run|translate)"
  "supervisor/fleet/(executive|program|report|vda5050)" "supervisor/ltl/(drawing|hoa|mission|program)" "supervisor/tamp/(drawing|mission|pictures|program)"
  "tests/bench/(campaign|planner/generators)" "tests/fuzz")

function(_stepwright_is_light folder result)
  set(${result} FALSE PARENT_SCOPE)
  foreach(light IN LISTS STEPWRIGHT_LIGHT_FOLDERS)
    if(folder MATCHES "^${light}(/|$)")
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# g++ looks for garbage all the time while it reads headers; where there is memory that is a twentieth of the build.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-expand=1000>
                      $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>)  # kB
endif()

add_custom_target(programs)
add_custom_target(unit_tests)

# The headers that most files name are read once for all that is compiled alike. A file still names every header that it
# needs: the debug preset reads them the plain way.
set(STEPWRIGHT_STANDARD_HEADERS <algorithm> <array> <chrono> <cmath> <cstdint> <cstring> <filesystem> <functional> <map> <memory>
    <optional> <set> <span> <string> <string_view> <unordered_map> <utility> <vector>)

function(_stepwright_precompiled name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/scripts/cmake/precompiled.cpp)
  target_compile_options(${name} PRIVATE ${STEPWRIGHT_COMPILE_OPTIONS} ${ARGN})
  target_precompile_headers(${name} PRIVATE ${STEPWRIGHT_STANDARD_HEADERS})
endfunction()

# Executables are compiled with -fPIE, objects of libraries with -fPIC.
function(_stepwright_precompiled_for_programs name)
  _stepwright_precompiled(${name} -fPIE ${ARGN})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
endfunction()

_stepwright_precompiled(stepwright_precompiled)
_stepwright_precompiled(stepwright_precompiled_light ${STEPWRIGHT_LIGHT_OPTIONS})
_stepwright_precompiled_for_programs(stepwright_programs_precompiled)
_stepwright_precompiled_for_programs(stepwright_programs_precompiled_light ${STEPWRIGHT_LIGHT_OPTIONS})

function(_stepwright_link target scope)
  foreach(folder IN LISTS ARGN)
    string(REPLACE "/" "_" dependency ${folder})
    target_link_libraries(${target} ${scope} stepwright_${dependency})
  endforeach()
endfunction()

# A library of one folder. PORTABLE: no exceptions, no RTTI (it also builds for the firmware).
# DEPENDS names folders; PRIVATE names third-party targets, which never show in our headers. Several files are
# compiled together (together.cmake) but for those after APART, portable libraries, and those of tests/bench that do not ask
# for it by TOGETHER: they are full of alternatives with the same names, and what is measured is not to be seen by a loop.
function(stepwright_library folder)
  cmake_parse_arguments(ARG "PORTABLE;TOGETHER" "" "SOURCES;APART;DEPENDS;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  string(REGEX REPLACE "^[^/]+/(.*)" "\\1" alias ${folder})
  string(REPLACE "/" "_" alias ${alias})
  set(target stepwright_${name})
  if(ARG_SOURCES)
    if(ARG_TOGETHER OR NOT (ARG_PORTABLE OR folder MATCHES "^tests/bench/"))
      _stepwright_together(${target} ARG_SOURCES SOURCES ${ARG_SOURCES} APART ${ARG_APART})
      set(ARG_APART "")
    endif()
    add_library(${target} STATIC ${ARG_SOURCES} ${ARG_APART})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
    target_compile_options(${target} PRIVATE ${STEPWRIGHT_COMPILE_OPTIONS})
    _stepwright_is_light(${folder} light)
    if(ARG_PORTABLE)
      target_compile_options(${target} PRIVATE -fno-exceptions -fno-rtti)
    elseif(light)
      target_compile_options(${target} PRIVATE ${STEPWRIGHT_LIGHT_OPTIONS})
      target_precompile_headers(${target} REUSE_FROM stepwright_precompiled_light)
    else()
      target_precompile_headers(${target} REUSE_FROM stepwright_precompiled)
    endif()
    _stepwright_link(${target} PUBLIC ${ARG_DEPENDS})
    if(ARG_PRIVATE)
      target_link_libraries(${target} PRIVATE ${ARG_PRIVATE})
    endif()
    set_property(GLOBAL APPEND PROPERTY STEPWRIGHT_LIBRARIES ${target})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR})
    _stepwright_link(${target} INTERFACE ${ARG_DEPENDS})
  endif()
  if(NOT TARGET stepwright::${alias})  # programs/x_y and runtime/x/y
    add_library(stepwright::${alias} ALIAS ${target})
  endif()
endfunction()

# What only tests are compiled with: GoogleTest's header is read once for all (tests/support/precompiled.cpp).
function(_stepwright_test_options target)
  target_compile_options(${target} PRIVATE ${STEPWRIGHT_LIGHT_OPTIONS})
  if(NOT target STREQUAL stepwright_tests_precompiled)
    target_precompile_headers(${target} REUSE_FROM stepwright_tests_precompiled)
  endif()
endfunction()

# An executable in build/<preset>/bin; the target `programs` builds those of programs/.
function(stepwright_program name)
  cmake_parse_arguments(ARG "TOGETHER" "" "SOURCES;APART;DEPENDS;PRIVATE" ${ARGN})
  if(ARG_TOGETHER OR "GTest::gtest_main" IN_LIST ARG_PRIVATE OR CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/programs/")
    _stepwright_together(${name} ARG_SOURCES SOURCES ${ARG_SOURCES} APART ${ARG_APART})
    set(ARG_APART "")
  endif()
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  target_compile_options(${name} PRIVATE ${STEPWRIGHT_COMPILE_OPTIONS})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  _stepwright_link(${name} PRIVATE ${ARG_DEPENDS})
  if(ARG_PRIVATE)
    target_link_libraries(${name} PRIVATE ${ARG_PRIVATE})
  endif()
  if("GTest::gtest_main" IN_LIST ARG_PRIVATE)
    _stepwright_test_options(${name})
  elseif(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/(programs|tests/browser|tests/cells)(/|$)")
    target_compile_options(${name} PRIVATE ${STEPWRIGHT_LIGHT_OPTIONS})
    target_precompile_headers(${name} REUSE_FROM stepwright_programs_precompiled_light)
    if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/programs/")
      add_dependencies(programs ${name})
    endif()
  else()
    target_precompile_headers(${name} REUSE_FROM stepwright_programs_precompiled)
  endif()
endfunction()

# Seconds after which a test counts as one that never ends. No measure of how fast it is to be: the longest takes a minute
# or two on a machine that does nothing else, and a machine may be ten times slower.
set(STEPWRIGHT_TEST_PATIENCE 1800)

# The ctest entries of a GoogleTest executable: one runs all of its cases in one process; SHARDS of them share the cases of
# an executable that takes longer than others. The entry is named by the executable unless NAME says otherwise: Unit.runtime_vm
# for unit_runtime_vm, Unit.runtime_host.1 and so on for shards. COMMAND runs it in another way.
function(stepwright_test_entries target)
  cmake_parse_arguments(ARG "" "NAME;SHARDS" "COMMAND;ENVIRONMENT" ${ARGN})
  if(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  if(NOT ARG_COMMAND)
    set(ARG_COMMAND ${target})
  endif()
  if(NOT ARG_NAME)
    string(REGEX MATCH "^([a-z])([a-z]*)_(.+)$" matched ${target})
    string(TOUPPER ${CMAKE_MATCH_1} initial)
    set(ARG_NAME ${initial}${CMAKE_MATCH_2}.${CMAKE_MATCH_3})
  endif()
  foreach(shard RANGE 1 ${ARG_SHARDS})
    set(entry ${ARG_NAME})
    set(environment ${ARG_ENVIRONMENT})
    if(ARG_SHARDS GREATER 1)
      set(entry ${ARG_NAME}.${shard})
      math(EXPR index "${shard} - 1")
      list(APPEND environment GTEST_TOTAL_SHARDS=${ARG_SHARDS} GTEST_SHARD_INDEX=${index})
    endif()
    add_test(NAME ${entry} COMMAND ${ARG_COMMAND} --gtest_brief=1)
    # A shard without cases proves nothing: there are more shards than cases.
    set_tests_properties(${entry} PROPERTIES TIMEOUT ${STEPWRIGHT_TEST_PATIENCE} ENVIRONMENT "${environment}"
                                             FAIL_REGULAR_EXPRESSION "\\] 0 tests from")
  endforeach()
endfunction()

# The unit tests of one folder: executable unit_<folder>; SHARDS as above.
function(stepwright_test folder)
  cmake_parse_arguments(ARG "" "SHARDS" "SOURCES;APART;DEPENDS;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  set(target unit_${name})
  stepwright_program(${target} SOURCES ${ARG_SOURCES} APART ${ARG_APART} DEPENDS ${folder} ${ARG_DEPENDS}
                     PRIVATE GTest::gtest_main GTest::gmock ${ARG_PRIVATE})
  target_compile_definitions(${target} PRIVATE STEPWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                               STEPWRIGHT_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  stepwright_test_entries(${target} SHARDS ${ARG_SHARDS})
  add_dependencies(unit_tests ${target})
endfunction()
