# Debian packages, by `cpack -G DEB` in the build folder: heightlight, the program, and libheightlight-dev, the libraries. To
# be configured with -DCMAKE_INSTALL_PREFIX=/usr, so that files go where Debian wants them.
set(CPACK_PACKAGE_CONTACT "the Heightlight authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Light on height fields: ambient occlusion, bounces, and closed forms of them")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME heightlight)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Finds what every texel of a heightmap sees of the sky and of the rest, bounces diffuse light to convergence, bakes material maps, and judges closed forms and screen-space methods.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "gnuplot-nox | gnuplot")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libheightlight-dev)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries and headers of Heightlight, for CMake and pkg-config.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libhwy-dev, libopenimageio-dev, libfmt-dev, libssl-dev, libpng-dev, libtiff-dev, zlib1g-dev")

# Each package has the licence and the notice of third parties, whose templates are compiled into it, where Debian looks.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS LICENSE NOTICE)
file(READ LICENSE licence)
file(READ NOTICE notice)
file(WRITE ${PROJECT_BINARY_DIR}/copyright "${licence}\n${notice}")
install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/heightlight
        COMPONENT program EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/libheightlight-dev
        COMPONENT development EXCLUDE_FROM_ALL)
include(CPack)
