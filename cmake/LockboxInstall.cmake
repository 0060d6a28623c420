# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` adds to the modules' own rules: shipped data and the CMake package.
include(CMakePackageConfigHelpers)

install(DIRECTORY share/models share/scenes share/sensors DESTINATION ${CMAKE_INSTALL_DATADIR}/lockbox)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lockbox)
install(EXPORT lockboxTargets NAMESPACE lockbox:: DESTINATION ${package_folder})
configure_package_config_file(cmake/lockboxConfig.cmake.in ${PROJECT_BINARY_DIR}/lockboxConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lockboxConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lockboxConfig.cmake
              ${PROJECT_BINARY_DIR}/lockboxConfigVersion.cmake DESTINATION ${package_folder})
