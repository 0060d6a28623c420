// SPDX-License-Identifier: BSD-3-Clause
// The extension module `lockbox._lockbox`.
#include <pybind11/pybind11.h>

#include <exception>
#include <filesystem>
#include <utility>

#include "bindings.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox::python {
namespace {

namespace py = pybind11;

void register_errors(py::module_& module) {
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError).doc() =
      "An input is missing or invalid. The text says where, what is wrong, and what to do.";
  py::register_exception<DeviceError>(module, "DeviceError", PyExc_RuntimeError).doc() =
      "A camera has failed, or has stopped delivering frames.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const std::filesystem::filesystem_error& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    }
  });
}

}  // namespace
}  // namespace lockbox::python

PYBIND11_MODULE(_lockbox, module) {
  using namespace lockbox::python;
  module.attr("__version__") = LOCKBOX_VERSION;
  module.doc() = "Tracks articulated objects with a depth camera.";
  register_errors(module);
  bind_model(module);
  bind_frames(module);
  bind_tracker(module);
  bind_evaluation(module);
}
