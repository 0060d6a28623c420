// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bindings.hpp"
#include "calls.hpp"
#include "lockbox/capture/depth_mode.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/core/error.hpp"
#include "poses.hpp"

namespace lockbox::python {
namespace {

using Units = py::array_t<std::uint16_t, py::array::c_style | py::array::forcecast>;
using Metres = py::array_t<float, py::array::c_style | py::array::forcecast>;

constexpr double kMostUnits = std::numeric_limits<std::uint16_t>::max();

bool is_measured(float z) {
  return std::isfinite(z) && z > 0.0F;
}

/// Metres: a millimetre if all depths are whole ones, as most cameras give them; else a tenth of
/// it, unless that does not reach the farthest point.
float unit_of(const float* depth, std::size_t count) {
  float farthest = 0.0F;
  bool is_whole = true;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_measured(depth[i])) continue;
    farthest = std::max(farthest, depth[i]);
    const double millimetres = 1e3 * double{depth[i]};
    is_whole = is_whole && std::abs(millimetres - std::round(millimetres)) <= 1e-3;
  }
  return is_whole || double{farthest} > kMostUnits * 1e-4 ? 1e-3F : 1e-4F;
}

/// What is beyond the reach of the unit was not measured.
void set_depth(const Metres& depth, DepthFrame& frame) {
  const float* const from = depth.data();
  frame.depth.resize(static_cast<std::size_t>(depth.size()));
  frame.metres_per_unit = unit_of(from, frame.depth.size());
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const double units =
        is_measured(from[i]) ? std::round(double{from[i]} / double{frame.metres_per_unit}) : 0.0;
    frame.depth[i] = units <= kMostUnits ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
  }
}

/// A source that is iterated over.
struct Source {
  std::shared_ptr<Interruptible> calls = std::make_shared<Interruptible>();
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();
  std::shared_ptr<FrameSource> source;  ///< null: closed
  std::string name;
  std::optional<std::size_t> frame_count;
  std::string description;
  bool is_at_end = false;
};

Source open(const std::filesystem::path& name,
            const std::optional<std::filesystem::path>& camera_info,
            const std::optional<double>& depth_scale, bool realtime,
            const std::optional<std::string>& mode) {
  if (depth_scale && !(*depth_scale > 0.0)) {
    throw InputError("depth_scale", "is not a positive number");
  }
  Source result;
  SourceOptions options;
  options.camera_info = camera_info;
  options.depth_scale = depth_scale;
  options.realtime = realtime;
  if (mode) options.mode = parse_depth_mode(*mode);
  options.stop = [calls = result.calls] { return calls->requested(); };
  options.warn = [warnings = result.warnings](const std::string& text) { warnings->add(text); };
  result.source = result.calls->run(
      [&] { return std::shared_ptr<FrameSource>(open_source(name.string(), options)); });
  result.warnings->issue();
  result.name = name.string();
  result.frame_count = result.source->frame_count();
  result.description = result.source->description();
  return result;
}

void close(Source& self) {
  self.calls->run([&] {
    self.source.reset();
    return true;
  });
}

/// Serves `for`, which would silently do nothing at the end of the source.
Source& begin(Source& self) {
  if (self.is_at_end) {
    throw InputError(self.name, "all of its frames were taken; open_source() opens it anew");
  }
  return self;
}

DepthFrame next(Source& self) {
  DepthFrame frame;
  const bool is_there = self.calls->run([&] {
    if (!self.source) throw InputError(self.name, "was closed; open_source() opens it anew");
    return self.source->next(frame);
  });
  self.is_at_end = !is_there;
  self.warnings->issue();
  if (!is_there) throw py::stop_iteration();
  return frame;
}

/// What would be written into it would be lost.
template <typename Number>
py::array_t<Number> read_only(py::array_t<Number> array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array_t<std::uint16_t> depth_of(const DepthFrame& frame) {
  return read_only(
      py::array_t<std::uint16_t>({frame.camera.height, frame.camera.width}, frame.depth.data()));
}

py::array_t<float> metres_of(const DepthFrame& frame) {
  py::array_t<float> result({frame.camera.height, frame.camera.width});
  float* const to = result.mutable_data();
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    to[i] = static_cast<float>(frame.depth[i]) * frame.metres_per_unit;
  }
  return read_only(std::move(result));
}

}  // namespace

DepthFrame to_frame(const py::array& depth, const Eigen::Matrix3d& intrinsics,
                    double units_per_metre) {
  if (depth.ndim() != 2 || depth.size() == 0) {
    throw InputError("depth", "is not an image: an array of rows x columns is needed");
  }
  if (std::max(depth.shape(0), depth.shape(1)) > std::numeric_limits<std::uint16_t>::max()) {
    throw InputError("depth", "is too large for an image");
  }
  DepthFrame frame;
  frame.camera =
      to_camera(intrinsics, static_cast<int>(depth.shape(1)), static_cast<int>(depth.shape(0)));
  const char kind = depth.dtype().kind();
  if (kind == 'f') {
    set_depth(Metres(depth), frame);
  } else if (kind == 'u' && depth.itemsize() == sizeof(std::uint16_t)) {
    const Units units(depth);
    frame.metres_per_unit = static_cast<float>(1.0 / units_per_metre);
    frame.depth.assign(units.data(), units.data() + units.size());
  } else {
    throw InputError("depth", "is an array of " + py::str(depth.dtype()).cast<std::string>() +
                                  "; uint16 (millimetres) or floats (metres) are needed");
  }
  return frame;
}

void bind_frames(py::module_& module) {
  py::class_<DepthFrame>(module, "Frame", "A depth image with its camera and its time.")
      .def_property_readonly("depth", &depth_of,
                             "Depths (rows x columns, uint16) in `metres_per_unit`; 0 is no "
                             "measurement. It cannot be written to. To take points away: "
                             "depth = frame.depth.copy(); depth[mask] = 0; "
                             "tracker.track(depth, time=frame.time).")
      .def_property_readonly("metres", &metres_of,
                             "Depths (rows x columns, float32) in metres; 0 is no measurement. It "
                             "cannot be written to.")
      .def_readonly("metres_per_unit", &DepthFrame::metres_per_unit, "The unit of `depth`, metres.")
      .def_property_readonly(
          "intrinsics", [](const DepthFrame& frame) { return to_matrix(frame.camera); },
          "The 3x3 camera matrix, pixels; centres of pixels are whole numbers.")
      .def_readonly("time", &DepthFrame::stamp, "Its time, seconds.")
      .def_readonly("index", &DepthFrame::index, "Its number in its source, from 0.");
  py::class_<Source>(module, "Source",
                     "Depth frames, one after the other: iterate over it, once. `with` closes it.")
      .def("__iter__", &begin, py::return_value_policy::reference)
      .def("__next__", &next)
      .def("__enter__", [](py::object self) { return self; })
      .def("__exit__", [](Source& self, const py::args&) { close(self); })
      .def("close", &close, "Gives the device or the files back. Closing it again does nothing.")
      .def_readonly("frame_count", &Source::frame_count,
                    "The number of frames of a recording; None of a live source.")
      .def_readonly("description", &Source::description, "What it is, for people.");
  module.def("open_source", &open, py::arg("source"), py::arg("camera_info") = py::none(),
             py::arg("depth_scale") = py::none(), py::arg("realtime") = false,
             py::arg("mode") = py::none(),
             "Opens `openni2:`, `openni2:<uri>`, a .oni file, a folder with depth.txt, or a folder "
             "of .pcd files. camera_info: file of a ROS camera calibration (YAML), used instead of "
             "the source's own. depth_scale: units per metre of images in a folder. realtime: "
             "recordings come at recorded speed. mode: of a live device, such as '320x240@60' or "
             "'640x480@30,100um'. Raises InputError or DeviceError.");
}

}  // namespace lockbox::python
