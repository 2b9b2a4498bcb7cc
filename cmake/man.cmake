# Man pages, made of the program's own help whenever it is built anew: the target `man`. Not of instrumented programs.
find_program(HEIGHTLIGHT_HELP2MAN help2man)
if(NOT HEIGHTLIGHT_HELP2MAN)
  message(STATUS "No help2man: there will be no man pages")
elseif(NOT HEIGHTLIGHT_SANITIZE AND NOT HEIGHTLIGHT_COVERAGE)
  add_custom_command(
    OUTPUT ${PROJECT_BINARY_DIR}/man/heightlight.1
    COMMAND ${PROJECT_SOURCE_DIR}/cmake/make-man $<TARGET_FILE:heightlight_cli> ${PROJECT_BINARY_DIR}/man
    DEPENDS heightlight_cli ${PROJECT_SOURCE_DIR}/cmake/make-man
    COMMENT "Man pages")
  add_custom_target(man ALL DEPENDS ${PROJECT_BINARY_DIR}/man/heightlight.1)
  # Optional: heightlight_cli may have been built alone.
  install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
endif()
