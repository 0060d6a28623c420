// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/report.hpp"
#include "lockbox/core/number_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "output_file.hpp"

namespace lockbox {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? Json(nullptr) : Json(static_cast<double>(part) / static_cast<double>(whole));
}

Json to_json(const Statistics& statistics, const char* unit) {
  return {{"unit", unit},
          {"frames", statistics.count},
          {"rmse", number(statistics.rmse)},
          {"median", number(statistics.median)},
          {"percentile_95", number(statistics.percentile_95)},
          {"maximum", number(statistics.maximum)}};
}

Json to_json(const StatusCount& statuses, std::size_t frames) {
  return {{"tracking_share", ratio(statuses.tracking, frames)},
          {"tracking", statuses.tracking},
          {"tracking_but_wrong", statuses.tracking_but_wrong},
          {"right", statuses.right},
          {"right_but_not_tracking", statuses.right_but_not_tracking}};
}

}  // namespace

std::string summary_text(const KinematicTree& tree, const Evaluation& evaluation) {
  Json joints = Json::object();
  for (const JointSummary& summary : evaluation.joints) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(summary.joint)];
    Json entry = to_json(summary.errors, joint.type == JointType::prismatic ? "m" : "rad");
    entry["undetermined"] = {
        {"frames", summary.honesty.frames},
        {"honest_share", ratio(summary.honesty.honest, summary.honesty.frames)}};
    joints[joint.name] = entry;
  }
  const Json summary = {{"model", tree.name},
                        {"frames", evaluation.frames.size()},
                        {"frames_without_estimate", evaluation.unmatched},
                        {"status", to_json(evaluation.statuses, evaluation.frames.size())},
                        {"base",
                         {{"translation", to_json(evaluation.translation, "m")},
                          {"rotation", to_json(evaluation.rotation, "rad")}}},
                        {"joints", joints}};
  return summary.dump(2) + '\n';
}

void write_summary(const std::filesystem::path& file, const KinematicTree& tree,
                   const Evaluation& evaluation) {
  OutputFile out(file);
  out.stream() << summary_text(tree, evaluation);
  out.close();
}

void write_errors(const std::filesystem::path& file, const KinematicTree& tree,
                  const Evaluation& evaluation) {
  OutputFile out(file);
  out.stream() << "timestamp,status,translation,rotation";
  for (const int joint : tree.file_order) {
    out.stream() << ',' << tree.joints[static_cast<std::size_t>(joint)].name;
  }
  out.stream() << '\n';
  for (const FrameErrors& frame : evaluation.frames) {
    out.stream() << number_text(frame.stamp) << ',' << frame.status << ','
                 << number_text(frame.translation) << ',' << number_text(frame.rotation);
    for (const int joint : tree.file_order) out.stream() << ',' << number_text(frame.joints[joint]);
    out.stream() << '\n';
  }
  out.close();
}

}  // namespace lockbox
