# SPDX-License-Identifier: BSD-3-Clause

# What the project's own code is compiled with. No -march: Debian's PCL is plain x86-64, and Eigen
# objects that cross that boundary with another alignment kill the process (docs/architecture.md).
add_library(lockbox_options INTERFACE)
target_compile_features(lockbox_options INTERFACE cxx_std_20)
target_compile_options(lockbox_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
# GCC 12 sees overlapping copies in `"text" + std::string` that are not there (GCC bug 105651).
target_compile_options(lockbox_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# Sources that are compiled together (CMAKE_UNITY_BUILD) are taken for headers by this one.
target_compile_options(lockbox_options INTERFACE
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
if(LOCKBOX_WARNINGS_AS_ERRORS)
  target_compile_options(lockbox_options INTERFACE -Werror)
endif()
set(LOCKBOX_SLOWDOWN 1)  # how much longer the tests may take
if(LOCKBOX_SANITIZE)
  set(LOCKBOX_SLOWDOWN 10)
  # Undefined behaviour ends the program, as the other findings do: else tests would pass with it.
  add_compile_options(-fsanitize=${LOCKBOX_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer -g1)
  # With sanitizers GCC 12 takes std::regex's own states for uninitialized.
  target_compile_options(lockbox_options INTERFACE
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  add_link_options(-fsanitize=${LOCKBOX_SANITIZE})
  # Under AddressSanitizer Eigen would not believe that malloc aligns, and free what PCL allocated
  # with another function.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(LOCKBOX_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "LOCKBOX_BUILD_FUZZERS needs Clang: cmake --preset fuzz")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)  # what inputs reach, all of the library counts
endif()
math(EXPR LOCKBOX_TEST_TIMEOUT "300 * ${LOCKBOX_SLOWDOWN}")  # seconds

# The build folder is laid out as an installation is (LockboxHardening.cmake). Programs and libraries
# find each other wherever the prefix is moved to.
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR})
file(RELATIVE_PATH library_folder ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set(CMAKE_INSTALL_RPATH $ORIGIN $ORIGIN/${library_folder})
# Components are loaded when they are asked for, from this folder beside the libraries
# (lockbox/core/component.hpp). Those of two versions can be installed, as their libraries can.
set(LOCKBOX_INTERFACE ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(LOCKBOX_COMPONENT_FOLDER lockbox/${LOCKBOX_INTERFACE})
set(LOCKBOX_COMPONENTS ${CMAKE_INSTALL_LIBDIR}/${LOCKBOX_COMPONENT_FOLDER})

# lockbox_add_module(<name> [PUBLIC_HEADERS ...] [INTERNAL_HEADERS_FOR modules...] SOURCES ...
#                    [PUBLIC targets...] [PRIVATE targets...])
# makes the library lockbox::<name> from src/. Its headers are of three kinds:
#   include/lockbox/<name>/   for users; named after PUBLIC_HEADERS, and installed
#   internal/lockbox/<name>/  for the modules named after INTERNAL_HEADERS_FOR, which are added
#                             later, for programs and for tests (lockbox_see_internals)
#   src/                      for the module itself
function(lockbox_add_module name)
  cmake_parse_arguments(ARG "" "" "PUBLIC_HEADERS;INTERNAL_HEADERS_FOR;SOURCES;PUBLIC;PRIVATE"
                        ${ARGN})
  set(target lockbox_${name})
  add_library(${target} ${ARG_SOURCES})
  add_library(lockbox::${name} ALIAS ${target})
  list(TRANSFORM ARG_PUBLIC_HEADERS PREPEND include/lockbox/${name}/)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${ARG_PUBLIC_HEADERS})
  set(internal ${CMAKE_CURRENT_SOURCE_DIR}/internal)
  get_property(internals_of_others GLOBAL PROPERTY lockbox_internals_for_${name})
  target_include_directories(${target} PRIVATE ${internal} ${internals_of_others})
  foreach(user IN LISTS ARG_INTERNAL_HEADERS_FOR ITEMS any_program)
    set_property(GLOBAL APPEND PROPERTY lockbox_internals_for_${user} ${internal})
  endforeach()
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Nobody replaces functions of a module by their own: calls within it may be inlined.
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE}
                                         $<BUILD_INTERFACE:lockbox_options>)
  # Before 1.0 each minor version may break programs that were linked with the one before.
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
                        SOVERSION ${LOCKBOX_INTERFACE})
  set_property(GLOBAL APPEND PROPERTY LOCKBOX_MODULES ${name})
  lockbox_ship(${target})
  install(TARGETS ${target} EXPORT lockboxTargets
          LIBRARY COMPONENT libraries NAMELINK_COMPONENT development
          ARCHIVE COMPONENT development FILE_SET HEADERS COMPONENT development)
endfunction()

# lockbox_see_internals(<target>) lets a program of this project include internal headers of all
# modules. What it does not link is still not there.
function(lockbox_see_internals target)
  get_property(internals GLOBAL PROPERTY lockbox_internals_for_any_program)
  target_include_directories(${target} PRIVATE ${internals})
endfunction()

# lockbox_keep_libraries(<target>) has a program that draws keep the graphics driver loaded, where
# leaks are looked for: of an unloaded one they would be of a module without a name.
function(lockbox_keep_libraries target)
  if(LOCKBOX_SANITIZE MATCHES address)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/sanitizers/keep_libraries.cpp)
  endif()
endfunction()

# lockbox_add_test(<name> SOURCES ... [LIBRARIES targets...] [DEFINITIONS ...] [PROPERTIES ...])
# makes one GoogleTest program and registers each of its tests with CTest, with the label `fast` if
# LOCKBOX_FAST_TESTS is set.
function(lockbox_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;DEFINITIONS;PROPERTIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest GTest::gmock
                                        GTest::gtest_main lockbox_options)
  target_compile_definitions(${name} PRIVATE ${ARG_DEFINITIONS})
  lockbox_see_internals(${name})
  set(labels)
  if(LOCKBOX_FAST_TESTS)
    set(labels LABELS fast)
    add_dependencies(lockbox_fast_tests ${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 DISCOVERY_MODE PRE_TEST
                       PROPERTIES TIMEOUT ${LOCKBOX_TEST_TIMEOUT} ${labels} ${ARG_PROPERTIES})
endfunction()

# lockbox_add_test_with_display(<name> COMMAND ...) registers a test that opens windows, with an X
# server of its own: nothing but its own windows is there. It runs alone: drawing, in software and at
# a low priority, would starve beside another test.
function(lockbox_add_test_with_display name)
  cmake_parse_arguments(ARG "" "" "COMMAND" ${ARGN})
  find_program(XVFB_RUN xvfb-run)
  set(launcher)
  if(XVFB_RUN)
    set(launcher ${XVFB_RUN} -a -s "-screen 0 1280x960x24")
  endif()
  add_test(NAME ${name} COMMAND ${launcher} ${ARG_COMMAND})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${LOCKBOX_TEST_TIMEOUT}
                                          SKIP_REGULAR_EXPRESSION "SKIPPED" RUN_SERIAL ON)
endfunction()
