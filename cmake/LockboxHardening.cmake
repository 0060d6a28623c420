# SPDX-License-Identifier: BSD-3-Clause
# What is shipped reads files and answers of devices that strangers made. So an overrun that was
# overlooked ends the program instead of running what the file says: with what Debian builds its own
# packages with (dpkg-buildflags, hardening=+all), see docs/architecture.md.
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX)

set(harden_by_default ON)
if(LOCKBOX_SANITIZE)
  set(harden_by_default OFF)  # sanitizers find the same, and replace the functions that would
endif()
option(LOCKBOX_HARDEN "Build what is shipped with stack protector, _FORTIFY_SOURCE, RELRO and PIE"
       ${harden_by_default})

add_library(lockbox_hardening INTERFACE)
if(LOCKBOX_HARDEN)
  target_compile_options(lockbox_hardening INTERFACE -fstack-protector-strong)
  # It needs optimization. Distributions that define it themselves may define another level.
  target_compile_options(lockbox_hardening INTERFACE
                         "$<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  target_link_options(lockbox_hardening INTERFACE LINKER:-z,relro LINKER:-z,now)
endif()

# Everything that is installed, and none of the tests.
add_custom_target(lockbox_shipped)

# lockbox_ship(<target> [RPATH <folder>...]) prepares a program or library for its installation.
# The build folder is laid out as an installation is, and what it holds has the same library path,
# relative to itself. CMake would else leave an empty element in the path of what is built, as room
# for that of the installation, and loaders take that for the working directory.
function(lockbox_ship target)
  cmake_parse_arguments(ARG "" "" "RPATH" ${ARGN})
  add_dependencies(lockbox_shipped ${target})
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:lockbox_hardening>)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON
                        BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH_USE_LINK_PATH ON)
  if(ARG_RPATH)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "${ARG_RPATH}")
  endif()
endfunction()
