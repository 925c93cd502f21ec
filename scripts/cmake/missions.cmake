# STEPWRIGHT_MISSIONS: the planners of cell/missions/missions.def, which a new one joins by a line there.

set(definitions ${PROJECT_SOURCE_DIR}/cell/missions/missions.def)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${definitions})
file(STRINGS ${definitions} STEPWRIGHT_MISSIONS REGEX "^STEPWRIGHT_MISSION")
list(TRANSFORM STEPWRIGHT_MISSIONS REPLACE "^STEPWRIGHT_MISSION\\(([a-z0-9_]+)\\)$" "\\1")

foreach(mission IN LISTS STEPWRIGHT_MISSIONS)
  if(NOT mission MATCHES "^[a-z0-9_]+$" OR NOT EXISTS ${PROJECT_SOURCE_DIR}/cell/missions/${mission}/CMakeLists.txt)
    message(FATAL_ERROR "${definitions}: '${mission}': a line is STEPWRIGHT_MISSION(NAME) and nothing else, NAME of a-z, 0-9 and _, "
                        "with a folder cell/missions/NAME")
  endif()
endforeach()

# Adds the planners' folders under FOLDER to the build.
function(stepwright_add_missions folder)
  foreach(mission IN LISTS STEPWRIGHT_MISSIONS)
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}${mission}/CMakeLists.txt)
      add_subdirectory(${folder}${mission})
    endif()
  endforeach()
endfunction()
