# What `cmake --install` puts where: libraries with their headers, found by find_package(heightlight) and by pkg-config;
# the program, with its man pages and what completes its command lines; the licence. What is of no component named is the
# program's.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

set(HEIGHTLIGHT_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/heightlight)
set(HEIGHTLIGHT_CORE_HEADERS
    closed_forms.h curves.h error.h evidence.h forms.h gloss.h heightmap.h image.h occlusion_forms.h screenspace.h shaders.h
    sky_light.h solve.h sun.h surface.h synth.h terrain_forms.h transport.h visibility.h watch.h)
list(TRANSFORM HEIGHTLIGHT_CORE_HEADERS PREPEND include/heightlight/)

install(TARGETS heightlight_core EXPORT heightlight ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(FILES ${HEIGHTLIGHT_CORE_HEADERS} ${PROJECT_BINARY_DIR}/include/heightlight/version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/heightlight COMPONENT development)
install(FILES LICENSE NOTICE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
set(pkg_config_files core)
if(HEIGHTLIGHT_FILES)
  install(TARGETS heightlight_files EXPORT heightlight ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(FILES include/heightlight/files.h include/heightlight/georeference.h
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/heightlight COMPONENT development)
  list(APPEND pkg_config_files files)
endif()
if(HEIGHTLIGHT_CLI)
  install(TARGETS heightlight_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # The program writes them itself, so that they know all its options.
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/completions)
  foreach(shell bash zsh)
    install(CODE "execute_process(COMMAND $<TARGET_FILE:heightlight_cli> completion ${shell}
                    OUTPUT_FILE ${PROJECT_BINARY_DIR}/completions/${shell} COMMAND_ERROR_IS_FATAL ANY)")
  endforeach()
  install(FILES ${PROJECT_BINARY_DIR}/completions/bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          RENAME heightlight)
  install(FILES ${PROJECT_BINARY_DIR}/completions/zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
          RENAME _heightlight)
  include(cmake/man.cmake)
endif()

install(EXPORT heightlight NAMESPACE heightlight:: FILE heightlightTargets.cmake DESTINATION ${HEIGHTLIGHT_CONFIG_DIR}
        COMPONENT development)
configure_package_config_file(cmake/heightlightConfig.cmake.in ${PROJECT_BINARY_DIR}/heightlightConfig.cmake
                              INSTALL_DESTINATION ${HEIGHTLIGHT_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/heightlightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/heightlightConfig.cmake ${PROJECT_BINARY_DIR}/heightlightConfigVersion.cmake
        DESTINATION ${HEIGHTLIGHT_CONFIG_DIR} COMPONENT development)
file(RELATIVE_PATH HEIGHTLIGHT_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
foreach(name ${pkg_config_files})
  configure_file(cmake/heightlight-${name}.pc.in heightlight-${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/heightlight-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT development)
endforeach()
if(HEIGHTLIGHT_CLI)
  include(cmake/package.cmake)
endif()
