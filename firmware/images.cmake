# Images for boards, cross-compiled beside the rest: build/<preset>/firmware/<board>.elf. The portable core and the application are
# compiled from the sources of the host's libraries, so that none can be forgotten.
#
#   firmware_image(mps2-an385 -mcpu=cortex-m3 -mthumb)
#   firmware_image(mps2-an385-basic BASIC -mcpu=cortex-m3 -mthumb)    # without strings and elementary functions

find_program(STEPWRIGHT_ARM_CXX arm-none-eabi-g++ REQUIRED)
set(firmware_here ${CMAKE_CURRENT_LIST_DIR})

# What no test of the host compiles is not compiled here either.
set(firmware_flags
    -std=c++20 -Os -g1 -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-unwind-tables
    -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections -ffp-contract=off -fno-math-errno -fno-common
    -DNDEBUG -DSTEPWRIGHT_HISTOGRAM_BITS=1 -DSTEPWRIGHT_PLAIN_INTERPRETER -DSTEPWRIGHT_VERSION="${PROJECT_VERSION}"
    -Wall -Wextra -Wshadow -Wconversion -Werror -Wno-psabi)
set(firmware_folders runtime/base runtime/bytecode runtime/image runtime/operations runtime/vm runtime/scan runtime/modbus/pdu
                     firmware/storage firmware/app firmware/decimal)

# The sources of the libraries and of the board; with BASIC without what that lacks.
function(_firmware_sources out)
  set(all "")
  foreach(folder IN LISTS firmware_folders)
    string(REPLACE "/" "_" name ${folder})
    get_target_property(sources stepwright_${name} SOURCES)
    foreach(source IN LISTS sources)
      get_filename_component(source ${source} NAME)
      list(APPEND all ${folder}/${source})
    endforeach()
  endforeach()
  if(ARGN)
    list(REMOVE_ITEM all runtime/operations/elementary.cpp runtime/operations/string_ops.cpp)
    list(APPEND all firmware/boards/cortex_m/absent_operations.cpp)
  endif()
  list(APPEND all firmware/boards/cortex_m/startup.cpp firmware/boards/cortex_m/library_support.cpp firmware/boards/cortex_m/charconv.cpp firmware/boards/cmsdk/mps2.cpp)
  set(${out} ${all} PARENT_SCOPE)
endfunction()

# One object below FOLDER; what two images share (the core knows its processor and no board) is made once.
function(_firmware_object out folder source)
  set(object ${PROJECT_BINARY_DIR}/firmware/${folder}/${source}.o)
  set(${out} ${object} PARENT_SCOPE)
  get_property(known GLOBAL PROPERTY STEPWRIGHT_FIRMWARE_OBJECTS)
  if(object IN_LIST known)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY STEPWRIGHT_FIRMWARE_OBJECTS ${object})
  get_filename_component(parent ${object} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  add_custom_command(
    OUTPUT ${object}
    COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${STEPWRIGHT_ARM_CXX} ${ARGN} ${firmware_flags} -I${PROJECT_SOURCE_DIR} -MD -MF
            ${object}.d -c ${PROJECT_SOURCE_DIR}/${source} -o ${object}
    DEPENDS ${PROJECT_SOURCE_DIR}/${source}
    DEPFILE ${object}.d
    COMMENT "${folder}: ${source}"
    VERBATIM)
endfunction()

function(firmware_image image)
  cmake_parse_arguments(ARG "BASIC" "" "" ${ARGN})
  set(processor ${ARG_UNPARSED_ARGUMENTS})
  list(GET processor 0 name)
  string(REPLACE "-mcpu=" "" name ${name})
  set(basic "")
  set(basic_flag "")
  if(ARG_BASIC)
    set(basic BASIC)
    set(basic_flag -DSTEPWRIGHT_FIRMWARE_BASIC)
  endif()
  string(REPLACE "-basic" "" board ${image})
  set(folder ${PROJECT_BINARY_DIR}/firmware)
  set(script ${firmware_here}/boards/cmsdk/mps2.ld)
  _firmware_sources(sources ${basic})
  set(objects "")
  foreach(source IN LISTS sources)
    if(source MATCHES "^runtime/")
      _firmware_object(object "${name}" ${source} ${processor})
    else()
      _firmware_object(object ${image} ${source} ${processor} ${basic_flag}
                       -DSTEPWRIGHT_BOARD_HEADER="firmware/boards/${board}/board.h")
    endif()
    list(APPEND objects ${object})
  endforeach()
  add_custom_command(
    OUTPUT ${folder}/${image}.elf
    COMMAND ${STEPWRIGHT_ARM_CXX} ${processor} ${objects} -nostartfiles -T ${script} -Wl,--gc-sections -Wl,--fatal-warnings
            -Wl,--no-warn-rwx-segments -Wl,-Map=${folder}/${image}.map -o ${folder}/${image}.elf
    DEPENDS ${objects} ${script}
    COMMENT "${image}.elf"
    VERBATIM)
  add_custom_target(firmware_${image} ALL DEPENDS ${folder}/${image}.elf)
endfunction()
