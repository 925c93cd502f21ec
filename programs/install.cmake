# What an installation has: the one command, its programs in a folder of their own, the units of systemd, the manual page, the
# cells of the demonstrations, images for boards, and the documents. scripts/package makes a Debian package of it.
include(GNUInstallDirs)
get_target_property(installed_programs programs MANUALLY_ADDED_DEPENDENCIES)
install(TARGETS ${installed_programs} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/stepwright COMPONENT stepwright)
install(CODE "file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin\")
              file(CREATE_LINK ../libexec/stepwright/stepwright \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin/stepwright\" SYMBOLIC)"
        COMPONENT stepwright)
install(FILES man/stepwright.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT stepwright-base)
install(FILES completion/stepwright.bash DESTINATION share/bash-completion/completions RENAME stepwright COMPONENT stepwright-base)
install(FILES systemd/stepwright@.service systemd/stepwright-runtime@.service systemd/stepwright-link@.service
              systemd/stepwright-supervisor@.service systemd/stepwright-hmi@.service systemd/stepwright-gateway@.service
              systemd/stepwright-modbus-server@.service systemd/stepwright-modbus-client@.service systemd/stepwright-guard@.service
        DESTINATION lib/systemd/system COMPONENT stepwright-base)
install(FILES systemd/stepwright.sysusers DESTINATION lib/sysusers.d RENAME stepwright.conf COMPONENT stepwright-base)
foreach(cell IN ITEMS batch_mixer bench bench_model conveyor fleet four_diverters htn ltl pick_place pump_station reach robot_cell tugger)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tests/cells/${cell} DESTINATION share/stepwright/cells COMPONENT stepwright-base
          PATTERN CMakeLists.txt EXCLUDE PATTERN "*.py" EXCLUDE PATTERN "*.cpp" EXCLUDE PATTERN __pycache__ EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tests/cells/shared_plant DESTINATION share/stepwright/cells COMPONENT stepwright-base
        PATTERN CMakeLists.txt EXCLUDE PATTERN "*_test.py" EXCLUDE PATTERN stepped_cell.py EXCLUDE PATTERN __pycache__ EXCLUDE)
foreach(image IN ITEMS mps2-an385 mps2-an385-basic mps2-an386)
  install(FILES ${PROJECT_BINARY_DIR}/firmware/${image}.elf DESTINATION share/stepwright/firmware COMPONENT stepwright-base
          OPTIONAL)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT stepwright-base)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/doc DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT stepwright-base)
foreach(folder IN ITEMS cell firmware hmi_web ladder plant_models programs runtime supervisor)
  install(FILES ${PROJECT_SOURCE_DIR}/${folder}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT stepwright-base)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${folder}/doc)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/doc DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT stepwright-base)
  endif()
endforeach()
# Documents name cells as the tree has them.
install(CODE "set(documents \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")
              file(MAKE_DIRECTORY \"\${documents}/tests\")
              file(CREATE_LINK ../../../stepwright/cells \"\${documents}/tests/cells\" SYMBOLIC)"
        COMPONENT stepwright-base)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tests/st/tests DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests/st COMPONENT stepwright-base)
