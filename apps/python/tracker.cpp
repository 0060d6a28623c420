// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/tracker.hpp"

#include <cmath>
#include <optional>

#include "../lockbox/plausible_states.hpp"
#include "bindings.hpp"
#include "calls.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/sensor/sensor_profile.hpp"
#include "lockbox/tracking/reported.hpp"
#include "lockbox/tracking/search_failure.hpp"
#include "poses.hpp"
#include "result.hpp"

namespace lockbox::python {
namespace {

constexpr double kFramePeriod = 1.0 / 30.0;  // seconds, as of sources that tell no times

std::string in_lines(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "\n") + sentence;
  return text;
}

struct Settings {
  std::optional<Eigen::Matrix3d> intrinsics;
  std::optional<State> initial_state;
  double depth_scale = 1000.0;
};

class PythonTracker {
 public:
  PythonTracker(ModelPointer model, Settings settings, TrackerOptions options)
      : model_(std::move(model)), settings_(std::move(settings)), options_(std::move(options)) {
    options_.stop_request = [this] { return calls_.requested(); };
    reset(settings_.initial_state);
  }

  void reset(const std::optional<State>& initial_state) {
    std::optional<Configuration> start;
    if (initial_state) {
      start = to_configuration(model_->tree, *initial_state);
      app::require_plausible("initial_state", model_->tree, {state_of(*start)});
    }
    calls_.run([&] {
      tracker_ = std::make_unique<Tracker>(*model_, options_);
      if (start) tracker_->start(*start);
      time_.reset();
      return true;
    });
    settings_.initial_state = initial_state;
  }

  Result track(DepthFrame frame) {
    return calls_.run([&] {
      if (time_ && !(frame.stamp > *time_)) {
        throw InputError("time", "is not later than that of the frame before; reset() begins anew");
      }
      const TrackingResult& tracked = tracker_->process(frame);
      Result result = to_result(model_->tree, tracked);
      const auto& failure = tracker_->search_failure();
      if (failure && !is_known(tracked)) result.reason = in_lines(reasons(*failure));
      time_ = frame.stamp;
      return result;
    });
  }

  Result track(const py::object& image, const std::optional<double>& time) {
    const py::array depth(image);  // as numpy.asarray() makes it of a list
    if (time && !std::isfinite(*time)) {
      throw InputError("time", "is not a finite number of seconds");
    }
    if (!settings_.intrinsics) {
      throw InputError("intrinsics", "are needed for arrays; give them to the Tracker");
    }
    DepthFrame frame = to_frame(depth, *settings_.intrinsics, settings_.depth_scale);
    frame.stamp = time.value_or(time_ ? *time_ + kFramePeriod : 0.0);
    return track(std::move(frame));
  }

  const std::optional<State>& initial_state() const { return settings_.initial_state; }
  Model model() const { return {model_}; }

 private:
  static lockbox::State state_of(const Configuration& configuration) {
    lockbox::State state;
    state.configuration = configuration;
    return state;
  }

  ModelPointer model_;
  Settings settings_;
  TrackerOptions options_;
  Interruptible calls_;
  std::optional<double> time_;  ///< of the last frame
  std::unique_ptr<Tracker> tracker_;
};

std::vector<bool> locked_variables(const KinematicTree& tree,
                                   const std::vector<std::string>& joints) {
  std::vector<bool> locked(static_cast<std::size_t>(tree.variables()), false);
  for (const auto& name : joints) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(joint_index(tree, name))];
    locked[static_cast<std::size_t>(joint.variable)] = true;
  }
  return locked;
}

std::unique_ptr<PythonTracker> make_tracker(
    const Model& model, const std::optional<Eigen::Matrix3d>& intrinsics,
    const std::optional<State>& initial_state, const std::string& sensor, double depth_scale,
    int iterations, std::size_t point_budget, bool fixed_base,
    const std::vector<std::string>& locked_joints, bool background_search, int threads) {
  if (!(depth_scale > 0.0)) throw InputError("depth_scale", "is not a positive number");
  if (iterations < 1) throw InputError("iterations", "is not a positive number");
  if (threads < 0) throw InputError("threads", "is neither 0 nor positive");
  if (intrinsics) require_camera(*intrinsics);
  TrackerOptions options;
  if (sensor != "auto") assume_sensor(find_sensor_profile(sensor), options);
  options.registration.max_iterations = iterations;
  options.registration.point_budget = point_budget;
  options.registration.fixed_base = fixed_base;
  options.registration.locked = locked_variables(model.model->tree, locked_joints);
  options.background_search = background_search;
  options.threads = threads;
  return std::make_unique<PythonTracker>(model.model,
                                         Settings{intrinsics, initial_state, depth_scale}, options);
}

}  // namespace

void bind_tracker(py::module_& module) {
  bind_result(module);
  py::class_<PythonTracker>(module, "Tracker", "Follows an object from frame to frame.")
      .def(
          py::init(&make_tracker), py::arg("model"), py::arg("intrinsics") = py::none(),
          py::kw_only(), py::arg("initial_state") = py::none(), py::arg("sensor") = "auto",
          py::arg("depth_scale") = 1000.0, py::arg("iterations") = 3,
          py::arg("point_budget") = RegistrationOptions().point_budget,
          py::arg("fixed_base") = false, py::arg("locked_joints") = std::vector<std::string>(),
          py::arg("background_search") = false, py::arg("threads") = 0,
          "intrinsics: the 3x3 camera matrix (pixels) of arrays that track() is given; frames of a "
          "source bring their own. initial_state: the start; None: found, no guess needed. sensor: "
          "name or file of a profile; auto: noise as the images show it. depth_scale: units per "
          "metre of uint16 arrays. iterations: "
          "linearisations a frame. point_budget: points used a frame, at most about; 0: all. "
          "fixed_base: the base does not move. locked_joints: names of joints that are held. "
          "background_search: frames do not wait for searches, as for live sources. threads: 0 for "
          "all cores. Raises InputError.")
      .def("track", py::overload_cast<DepthFrame>(&PythonTracker::track), py::arg("frame"),
           "Takes the next frame of a source. Returns a Result. A search of the whole image may "
           "take seconds; Ctrl-C ends it, and the frame then counts as not seen.")
      .def(
          "track",
          py::overload_cast<const py::object&, const std::optional<double>&>(&PythonTracker::track),
          py::arg("depth"), py::arg("time") = py::none(),
          "Takes the next depth image (rows x columns): uint16 in millimetres (see depth_scale) or "
          "floats in metres; 0 and NaN are no measurement. time: seconds, increasing; None: 1/30 s "
          "after the frame before. Returns a Result. Raises InputError.")
      .def("reset", &PythonTracker::reset, py::arg("initial_state") = py::none(),
           "Forgets all frames, and begins with this state; None: it is found.")
      .def_property_readonly(
          "initial_state", [](const PythonTracker& self) { return self.initial_state(); },
          "The State that it began with; None if it was to be found.")
      .def_property_readonly(
          "model", [](const PythonTracker& self) { return self.model(); }, "The Model.");
}

}  // namespace lockbox::python
