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

namespace lockbox::python {
namespace {

constexpr double kFramePeriod = 1.0 / 30.0;  // seconds, as of sources that tell no times

struct Alternative {
  std::string kind;
  State state;
  double probability;
};

struct Result {
  double time;
  std::string status;
  double belief;
  State state;        ///< NaN while nothing is known
  JointValues sigma;  ///< see joint_sigma()
  Eigen::MatrixXd covariance;
  std::optional<std::string> reason;  ///< why nothing is known
  double residual_rms;
  double explained;
  double contradicted;
  std::vector<Alternative> alternatives;
  double seconds;
};

/// The rows of the base, then those of the variables in the order of the file.
Eigen::MatrixXd in_order_of_file(const KinematicTree& tree, const Eigen::MatrixXd& covariance) {
  std::vector<int> rows = {0, 1, 2, 3, 4, 5};
  for (const int variable : variables_of_file(tree)) rows.push_back(6 + variable);
  return covariance(rows, rows);
}

Result to_result(const KinematicTree& tree, const TrackingResult& result) {
  const bool is_told = is_known(result);
  const Eigen::Index unknowns = 6 + tree.variables();
  Result copy;
  copy.time = result.stamp;
  copy.status = to_string(result.status);
  copy.belief = result.belief;
  copy.state = to_state(tree, is_told ? result.configuration : unknown_configuration(tree));
  if (!is_told) copy.state.base.topRows<3>().setConstant(TrackingResult::kNothingFound);
  for (const int index : tree.file_order) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(index)];
    copy.sigma.emplace_back(joint.name, joint_sigma(joint, result));
  }
  copy.covariance =
      is_told ? in_order_of_file(tree, result.covariance)
              : Eigen::MatrixXd::Constant(unknowns, unknowns, TrackingResult::kNothingFound);
  copy.residual_rms = result.residual_rms;
  copy.explained = result.explained;
  copy.contradicted = result.contradicted;
  for (const lockbox::Alternative& other : result.alternatives) {
    copy.alternatives.push_back(
        {to_string(other.kind), to_state(tree, other.configuration), other.probability});
  }
  copy.seconds = 1e-3 * result.latency_ms;
  return copy;
}

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
  assume_sensor(find_sensor_profile(sensor), options);
  options.registration.max_iterations = iterations;
  options.registration.point_budget = point_budget;
  options.registration.fixed_base = fixed_base;
  options.registration.locked = locked_variables(model.model->tree, locked_joints);
  options.background_search = background_search;
  options.threads = threads;
  return std::make_unique<PythonTracker>(model.model,
                                         Settings{intrinsics, initial_state, depth_scale}, options);
}

py::tuple pickled_result(const Result& result) {
  return py::make_tuple(result.time, result.status, result.belief, result.state, result.sigma,
                        result.covariance, result.reason, result.residual_rms, result.explained,
                        result.contradicted, result.alternatives, result.seconds);
}

Result unpickled_result(const py::tuple& parts) {
  return {parts[0].cast<double>(),
          parts[1].cast<std::string>(),
          parts[2].cast<double>(),
          parts[3].cast<State>(),
          parts[4].cast<JointValues>(),
          parts[5].cast<Eigen::MatrixXd>(),
          parts[6].cast<std::optional<std::string>>(),
          parts[7].cast<double>(),
          parts[8].cast<double>(),
          parts[9].cast<double>(),
          parts[10].cast<std::vector<Alternative>>(),
          parts[11].cast<double>()};
}

void bind_alternative(py::module_& module) {
  py::class_<Alternative>(module, "Alternative",
                          "Where the object may be as well, as far as the frame tells.")
      .def_readonly("kind", &Alternative::kind,
                    "`flip` (in the same place, turned) or `elsewhere` (in another place).")
      .def_readonly("state", &Alternative::state, "Base and joints as a State.")
      .def_readonly("probability", &Alternative::probability, "How probable it is, 0 to 1.")
      .def(py::pickle(
          [](const Alternative& self) {
            return py::make_tuple(self.kind, self.state, self.probability);
          },
          [](const py::tuple& parts) {
            return Alternative{parts[0].cast<std::string>(), parts[1].cast<State>(),
                               parts[2].cast<double>()};
          }))
      .def("__repr__", [](const Alternative& self) {
        return "<lockbox.Alternative " + self.kind + ": " + std::to_string(self.probability) + ">";
      });
}

void bind_result(py::module_& module) {
  py::class_<Result>(module, "Result", "What a frame told.")
      .def_readonly("time", &Result::time, "Time of the frame, seconds.")
      .def_readonly(
          "status", &Result::status,
          "`initializing` (no estimate yet), `tracking`, `uncertain` (too much is hidden, "
          "or a part is contradicted) or `lost`.")
      .def_property_readonly(
          "base", [](const Result& self) { return self.state.base; },
          "The 4x4 pose of the base in the camera's frame, metres; NaN while nothing is known.")
      .def_property_readonly(
          "joints", [](const Result& self) { return to_dict(self.state.joints); },
          "Positions by name in the order of `Model.joints`, radians or metres; NaN while nothing "
          "is known.")
      .def_readonly("state", &Result::state, "Base and joints as a State.")
      .def_property_readonly(
          "sigma", [](const Result& self) { return to_dict(self.sigma); },
          "Standard deviations of the joints by name in the order of `Model.joints`, radians or "
          "metres; inf where the frame does not determine a joint, 0 for held ones, NaN while "
          "nothing is known.")
      .def_readonly(
          "covariance", &Result::covariance,
          "The covariance ((6 + variables) square) of base twist and joint variables, "
          "which are in the order of `Model.variables`. The twist (v, w) moves the base as base @ "
          "exp(v, w): metres and radians, in the base's frame.")
      .def_readonly("reason", &Result::reason,
                    "Why a search has found nothing, and what to do: lines of text, the surest "
                    "reason first. None while something is known, and before the first search.")
      .def_readonly("residual_rms", &Result::residual_rms,
                    "The whitened residual: 1 where the sensor errs as assumed; NaN where nothing "
                    "was found.")
      .def_readonly("explained", &Result::explained,
                    "The share of the model's visible surface that the image confirms.")
      .def_readonly("contradicted", &Result::contradicted,
                    "The share of the model's visible surface that the image sees through.")
      .def_readonly("belief", &Result::belief,
                    "The probability that the base is where it is reported; 0 while nothing is "
                    "known.")
      .def_readonly("alternatives", &Result::alternatives,
                    "What a search could not tell from what is reported: Alternatives, the most "
                    "probable first.")
      .def_readonly("seconds", &Result::seconds, "How long the frame took, seconds.")
      .def(py::pickle(&pickled_result, &unpickled_result))
      .def("__repr__", [](const Result& self) {
        return "<lockbox.Result at " + std::to_string(self.time) + " s: " + self.status + ">";
      });
}

}  // namespace

void bind_tracker(py::module_& module) {
  bind_alternative(module);
  bind_result(module);
  py::class_<PythonTracker>(module, "Tracker", "Follows an object from frame to frame.")
      .def(
          py::init(&make_tracker), py::arg("model"), py::arg("intrinsics") = py::none(),
          py::kw_only(), py::arg("initial_state") = py::none(), py::arg("sensor") = "primesense",
          py::arg("depth_scale") = 1000.0, py::arg("iterations") = 3,
          py::arg("point_budget") = RegistrationOptions().point_budget,
          py::arg("fixed_base") = false, py::arg("locked_joints") = std::vector<std::string>(),
          py::arg("background_search") = false, py::arg("threads") = 0,
          "intrinsics: the 3x3 camera matrix (pixels) of arrays that track() is given; frames of a "
          "source bring their own. initial_state: the start; None: found, no guess needed. sensor: "
          "name or file of a profile. depth_scale: units per metre of uint16 arrays. iterations: "
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
