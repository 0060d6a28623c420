// SPDX-License-Identifier: BSD-3-Clause
#include "result.hpp"

#include <cmath>

#include "lockbox/tracking/reported.hpp"

namespace lockbox::python {
namespace {

/// The rows of the base, then those of the variables in the order of the file.
Eigen::MatrixXd in_order_of_file(const KinematicTree& tree, const Eigen::MatrixXd& covariance) {
  std::vector<int> rows = {0, 1, 2, 3, 4, 5};
  for (const int variable : variables_of_file(tree)) rows.push_back(unknown_of(variable));
  return covariance(rows, rows);
}

py::tuple pickled_result(const Result& result) {
  return py::make_tuple(result.time, result.status, result.belief, result.state, result.sigma,
                        result.covariance, result.reason, result.residual_rms, result.explained,
                        result.contradicted, result.alternatives, result.apparent_size,
                        result.seconds);
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
          parts[11].cast<std::optional<ApparentSize>>(),
          parts[12].cast<double>()};
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

void bind_apparent_size(py::module_& module) {
  py::class_<ApparentSize>(module, "ApparentSize",
                           "How large the object looks, as a multiple of its model, over the last "
                           "measurements.")
      .def_property_readonly(
          "across", [](const ApparentSize& self) { return self.value[0]; },
          "Across the optical axis, at the distance that is measured.")
      .def_property_readonly(
          "along", [](const ApparentSize& self) { return self.value[1]; },
          "Along the optical axis: its relief.")
      .def_property_readonly(
          "across_sigma", [](const ApparentSize& self) { return std::sqrt(self.covariance(0, 0)); },
          "Standard deviation of `across`.")
      .def_property_readonly(
          "along_sigma", [](const ApparentSize& self) { return std::sqrt(self.covariance(1, 1)); },
          "Standard deviation of `along`.")
      .def_property_readonly(
          "is_implausible", &ApparentSize::is_implausible,
          "Whether `across` is off, beyond doubt, by more than 3 %. Such an object is `uncertain` "
          "at best.")
      .def_property_readonly("may_be_scale", &ApparentSize::may_be_scale,
                             "Whether the scale of the model, or of the depths, may be why it is "
                             "off; no image tells these two apart.")
      .def_property_readonly("may_be_focal_length", &ApparentSize::may_be_focal_length,
                             "Whether the focal length may be why it is off.")
      .def(py::pickle(
          [](const ApparentSize& self) { return py::make_tuple(self.value, self.covariance); },
          [](const py::tuple& parts) {
            return ApparentSize{parts[0].cast<Eigen::Vector2d>(), parts[1].cast<Eigen::Matrix2d>()};
          }))
      .def("__repr__", [](const ApparentSize& self) {
        return "<lockbox.ApparentSize " + std::to_string(self.value[0]) + " across, " +
               std::to_string(self.value[1]) + " along>";
      });
}

}  // namespace

Result to_result(const KinematicTree& tree, const TrackingResult& result) {
  const bool is_told = is_known(result);
  const Eigen::Index unknowns = tree.unknowns();
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
  if (result.size.covariance.allFinite()) copy.apparent_size = result.size;
  copy.seconds = 1e-3 * result.latency_ms;
  return copy;
}

void bind_result(py::module_& module) {
  bind_alternative(module);
  bind_apparent_size(module);
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
      .def_readonly("apparent_size", &Result::apparent_size,
                    "How large the object looks beside its model, as an ApparentSize; None until "
                    "it was measured.")
      .def_readonly("seconds", &Result::seconds, "How long the frame took, seconds.")
      .def(py::pickle(&pickled_result, &unpickled_result))
      .def("__repr__", [](const Result& self) {
        return "<lockbox.Result at " + std::to_string(self.time) + " s: " + self.status + ">";
      });
}

}  // namespace lockbox::python
