# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` adds to the modules' own rules: shipped data, and what makes the libraries
# known to CMake and to pkg-config.
include(CMakePackageConfigHelpers)

install(DIRECTORY share/models share/peers share/scenes share/sensors
        DESTINATION ${CMAKE_INSTALL_DATADIR}/lockbox COMPONENT data)

# Messages name documents, and documents each other. The build folder has them in the same place.
set(documents_folder ${CMAKE_INSTALL_DATADIR}/doc/lockbox)
install(FILES README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md DESTINATION ${documents_folder} COMPONENT data)
install(DIRECTORY docs DESTINATION ${documents_folder} COMPONENT data
        FILES_MATCHING PATTERN *.md PATTERN *.png)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/${documents_folder})
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/docs ${PROJECT_BINARY_DIR}/${documents_folder}/docs SYMBOLIC)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lockbox)
install(EXPORT lockboxTargets NAMESPACE lockbox:: DESTINATION ${package_folder}
        COMPONENT development)
configure_package_config_file(cmake/lockboxConfig.cmake.in ${PROJECT_BINARY_DIR}/lockboxConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lockboxConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lockboxConfig.cmake
              ${PROJECT_BINARY_DIR}/lockboxConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT development)

# Static libraries would need all third-party ones named, in the order in which linkers want them.
if(BUILD_SHARED_LIBS)
  get_property(modules GLOBAL PROPERTY LOCKBOX_MODULES)
  list(TRANSFORM modules PREPEND -llockbox_ OUTPUT_VARIABLE libraries)
  list(JOIN libraries " " libraries)
  set(pkg_config_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH to_prefix /${pkg_config_folder} /)
  configure_file(cmake/lockbox.pc.in ${PROJECT_BINARY_DIR}/lockbox.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/lockbox.pc DESTINATION ${pkg_config_folder}
          COMPONENT development)
endif()
