# SPDX-License-Identifier: BSD-3-Clause
# Debian packages of what is built: `cpack --config build/CPackConfig.cmake`, or scripts/package.
# Their contents are the components that install rules name.
set(LOCKBOX_PACKAGE_CONTACT "The lockbox authors <lockbox@packages.invalid>"
    CACHE STRING "Maintainer of the Debian packages: who builds and hands them out")

# The libraries' version of the interface is a part of their name, and of the folder of what they load:
# those of two can be installed.
set(interface ${LOCKBOX_INTERFACE})
set(library_package liblockbox${interface})
set(package_of_tool lockbox)
set(package_of_libraries ${library_package})
set(package_of_data lockbox-data)
set(package_of_development lockbox-dev)
set(package_of_python python3-lockbox)
set(components tool libraries data development)
if(LOCKBOX_PYTHON)
  list(APPEND components python)
endif()

# Of one build: each package works with the others of the same version only.
set(same "(= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS "${library_package} ${same}, lockbox-data ${same}")
set(CPACK_DEBIAN_TOOL_PACKAGE_SUGGESTS "ffmpeg, gnuplot-nox, lockbox-dev, python3-lockbox")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_RECOMMENDS "lockbox-data ${same}")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers
                                                 ${PROJECT_BINARY_DIR}/debian/shlibs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${library_package} ${same}, libeigen3-dev (>= 3.4), libpcl-dev (>= 1.13)")
math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${library_package} ${same}, lockbox-data ${same}, python3-numpy"
    "python3 (>= 3.${Python3_VERSION_MINOR})" "python3 (<< 3.${next_python})")
list(JOIN CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS)

set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION science)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DATA_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)

set(about_tool "tracker of articulated objects with a depth camera"
    "Estimates for every frame of a depth camera or recording where an object is,"
    "and how each of its doors, drawers and sliders stands, with its uncertainty.")
set(about_libraries "libraries that track articulated objects in depth images"
    "The libraries behind the tool lockbox, and what they load on demand: the"
    "virtual depth camera and the recorder for OpenNI2, and the 3D viewer.")
set(about_data "models, scenes and sensor profiles for lockbox"
    "Articulated objects as URDF files with meshes, scenes for simulated recordings,"
    "what is known of the noise of depth cameras, and figures of another tracker.")
set(about_development "headers of the libraries of lockbox"
    "For programs that track articulated objects, alone or in place of PCL's ICP."
    "CMake and pkg-config find the libraries.")
set(about_python "tracker of articulated objects for Python"
    "Gives Python programs the models, sources, tracker and evaluation of lockbox,"
    "with numpy arrays.")

# What packages of programs that were linked with a library depend on. CPack would want versions of
# what is loaded on demand, too.
get_property(modules GLOBAL PROPERTY LOCKBOX_MODULES)
list(TRANSFORM modules REPLACE "(.+)" "liblockbox_\\1 ${interface} ${library_package} ${same}\n"
     OUTPUT_VARIABLE shlibs)
string(CONCAT shlibs ${shlibs})
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/debian/shlibs CONTENT "${shlibs}" @ONLY)

configure_file(cmake/debian/changelog.in ${PROJECT_BINARY_DIR}/debian/changelog @ONLY)
execute_process(COMMAND gzip -9 --no-name --force --keep ${PROJECT_BINARY_DIR}/debian/changelog
                COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS components)
  set(package ${package_of_${component}})
  string(TOUPPER ${component} COMPONENT)
  list(POP_FRONT about_${component} summary)
  list(JOIN about_${component} "\n" description)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${COMPONENT}_DESCRIPTION "${summary}\n${description}")
  # What Debian wants in packages, and nobody in a prefix of his own.
  install(FILES cmake/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
  set(overrides cmake/debian/lintian-overrides.${component})
  if(EXISTS ${PROJECT_SOURCE_DIR}/${overrides})
    install(FILES ${overrides} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
            RENAME ${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
  endif()
endforeach()

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # it would come before that of each package
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGE_CONTACT ${LOCKBOX_PACKAGE_CONTACT})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
include(CPack)
