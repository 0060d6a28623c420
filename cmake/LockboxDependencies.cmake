# SPDX-License-Identifier: BSD-3-Clause
# Every third-party library in one place; which module may use which: docs/architecture.md.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(HWY REQUIRED NAMES HWY hwy)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel FiltersCore
                                         InteractionStyle RenderingAnnotation RenderingCore
                                         RenderingFreeType RenderingOpenGL2)
find_package(X11 REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS EGL)
find_package(GLEW REQUIRED)
find_package(Threads REQUIRED)
# PCL's package would look for all of VTK again and hand it to everything that links PCL.
set(CMAKE_DISABLE_FIND_PACKAGE_VTK TRUE)
find_package(PCL 1.13 REQUIRED COMPONENTS common search kdtree octree sample_consensus filters
                                          features segmentation registration)
set(CMAKE_DISABLE_FIND_PACKAGE_VTK FALSE)
find_package(yaml-cpp REQUIRED)
find_package(PNG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(OPENNI2 REQUIRED IMPORTED_TARGET libopenni2)
pkg_check_modules(URDFDOM REQUIRED IMPORTED_TARGET urdfdom)
pkg_check_modules(TINYXML2 REQUIRED IMPORTED_TARGET tinyxml2)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Boost REQUIRED)
# Debian's own, for which its packages (pytest, numpy, pybind11) are, whatever else is in the path.
find_program(Python3_EXECUTABLE NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_package(Python3 COMPONENTS Interpreter Development.Module)
set(PYBIND11_NOPYTHON ON)  # it would look for another Python
find_package(pybind11 CONFIG QUIET)
set(python_is_there OFF)
# Python itself would have to be built with the sanitizers.
if(Python3_Development.Module_FOUND AND pybind11_FOUND AND NOT LOCKBOX_SANITIZE)
  set(python_is_there ON)
endif()
option(LOCKBOX_PYTHON "Build the Python package" ${python_is_there})
set(LOCKBOX_PYTHON_FOLDER lib/python3/dist-packages
    CACHE STRING "Where below the prefix the Python package is installed")
