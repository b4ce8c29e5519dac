# Manual pages and completions for bash, zsh and fish, generated from the help of the built programs.
find_package(Python3 QUIET COMPONENTS Interpreter)
if(NOT Python3_FOUND OR CMAKE_CROSSCOMPILING)
  return()
endif()

set(manual ${PROJECT_BINARY_DIR}/manual)
set(script ${PROJECT_SOURCE_DIR}/cmake/manual.py)
set(programs --glint $<TARGET_FILE:glint>)
set(depends ${script} glint)
if(TARGET glint-viewer)
  list(APPEND programs --viewer $<TARGET_FILE:glint-viewer>)
  list(APPEND depends glint-viewer)
endif()
add_custom_command(
  OUTPUT ${manual}/done
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${manual}
  COMMAND ${Python3_EXECUTABLE} -B ${script} ${programs} --folder ${manual}
  COMMAND ${CMAKE_COMMAND} -E touch ${manual}/done
  DEPENDS ${depends}
  VERBATIM)
add_custom_target(manual ALL DEPENDS ${manual}/done)

install(DIRECTORY ${manual}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT glint
        PATTERN "glint-view*.1" EXCLUDE)
install(FILES ${manual}/man1/glint-view.1 ${manual}/man1/glint-viewer.1
        DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT viewer OPTIONAL)
install(FILES ${manual}/bash/glint COMPONENT glint
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${manual}/zsh/_glint COMPONENT glint
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${manual}/fish/glint.fish COMPONENT glint
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
