// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/figure.hpp"
#include "lockbox/evaluation/report.hpp"

namespace lockbox {
namespace {

constexpr const char* kTime = "time (s)";

/// value(frame) times scale against time.
template <typename Value>
Curve curve(const std::string& name, const Evaluation& evaluation, double scale, Value value) {
  Curve result{name, {}, {}};
  for (const FrameErrors& frame : evaluation.frames) {
    result.x.push_back(frame.stamp);
    result.y.push_back(scale * value(frame));
  }
  return result;
}

Figure base_figure(const Evaluation& evaluation) {
  const Curve translation = curve("translation", evaluation, kMillimetres,
                                  [](const FrameErrors& frame) { return frame.translation; });
  const Curve rotation = curve("rotation", evaluation, kDegrees,
                               [](const FrameErrors& frame) { return frame.rotation; });
  return {"Error of the base",
          {{kTime, "translation (mm)", {translation}}, {kTime, "rotation (degrees)", {rotation}}}};
}

Figure joints_figure(const KinematicTree& tree, const Evaluation& evaluation) {
  Panel sliding{kTime, "sliding joints (mm)", {}};
  Panel turning{kTime, "turning joints (degrees)", {}};
  for (const int index : tree.file_order) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(index)];
    const bool slides = joint.type == JointType::prismatic;
    (slides ? sliding : turning)
        .curves.push_back(curve(joint.name, evaluation, slides ? kMillimetres : kDegrees,
                                [index](const FrameErrors& frame) { return frame.joints[index]; }));
  }
  return {"Errors of the joints", {sliding, turning}};
}

}  // namespace

std::string write_error_plots(const std::filesystem::path& folder, const KinematicTree& tree,
                              const Evaluation& evaluation) {
  const std::string problem = write_figure(folder / "base", base_figure(evaluation));
  if (!problem.empty() || tree.joints.empty()) return problem;
  return write_figure(folder / "joints", joints_figure(tree, evaluation));
}

}  // namespace lockbox
