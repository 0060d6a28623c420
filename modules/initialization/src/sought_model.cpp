// SPDX-License-Identifier: BSD-3-Clause
#include "sought_model.hpp"

#include <algorithm>
#include <utility>

#include "box_turns.hpp"
#include "lockbox/model/drawn_mesh.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/symmetry.hpp"
#include "lockbox/model/variable_range.hpp"
#include "model_sides.hpp"

namespace lockbox {
namespace {

/// Of the surface: then planes tell more than points. Bottles and mugs have a tenth, furniture and
/// boards eight tenths and more.
constexpr double kMostlyFlat = 0.5;
/// Of the base's surface: a mug's without its handle. Doubled in what it leaves, twice as many
/// turns are tried.
constexpr double kMostlyAlike = 0.75;

/// Triangles of a body that are drawn in no time.
constexpr std::size_t kFewTriangles = 200;
/// What they may be off by, metres: half a pixel of the finer view at 1 m.
constexpr double kMostOff = 0.0017;

KinematicTree seen_from_afar(const ArticulatedModel& model) {
  KinematicTree tree = model.tree;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    TriangleMesh& mesh = tree.bodies[b].mesh;
    if (model.fields[b]) mesh = drawn_mesh(mesh, *model.fields[b], kFewTriangles, kMostOff);
  }
  return tree;
}

}  // namespace

SoughtModel::SoughtModel(const ArticulatedModel& articulated_model,
                         const RegistrationOptions& options, const EvidenceOptions& of_evidence,
                         std::shared_ptr<const LookAlikes> known)
    : model(articulated_model),
      evidence(of_evidence),
      from_afar(seen_from_afar(articulated_model)),
      is_flat(flat_share(model.tree) > kMostlyFlat),
      extent(model_extent(model.tree)),
      symmetries(find_lasting_symmetries(model)),
      turns(box_turns(extent, symmetries)),
      look_alikes(known ? std::move(known)
                        : std::make_shared<const LookAlikes>(model, options.locked)),
      variables(options.free_variables(model.tree.variables())),
      all_bodies(model.tree.bodies.size(), 1) {
  add_turns_of_base(extent, find_body_symmetries(model, 0), symmetries, turns);
  if (is_flat) return;  // its contour tells
  add_turns_of_base(extent, find_body_symmetries(model, 0, kMostlyAlike), symmetries, round_turns);
  add_near_turns(extent, round_turns);
}

std::vector<Hypothesis> with_body_at(const SoughtModel& sought, const Configuration& held,
                                     std::size_t body, const Eigen::Isometry3d& T_camera_body,
                                     int steps) {
  const KinematicTree& tree = sought.model.tree;
  const std::vector<int>& variables = sought.variables;
  Hypothesis hypothesis{held, std::vector<std::uint8_t>(tree.bodies.size(), 0)};
  // Base and body alone: how other joints stand is not known yet.
  hypothesis.bodies[0] = 1;
  hypothesis.bodies[body] = 1;
  const int joint = tree.bodies[body].parent_joint;
  const int variable = joint < 0 ? -1 : tree.joints[static_cast<std::size_t>(joint)].variable;
  const bool is_free = std::find(variables.begin(), variables.end(), variable) != variables.end();
  std::vector<Hypothesis> hypotheses;
  std::vector<Eigen::Isometry3d> poses;
  Configuration& configuration = hypothesis.configuration;
  for (const double position :
       is_free ? positions_in(variable_range(tree, variable), steps) : std::vector<double>{0.0}) {
    if (is_free) configuration.q[variable] = position;
    configuration.T_camera_base.setIdentity();
    forward_kinematics(tree, configuration, poses);
    configuration.T_camera_base = T_camera_body * poses[body].inverse();
    hypotheses.push_back(hypothesis);
  }
  return hypotheses;
}

Hypothesis with_body_held(const SoughtModel& sought, const Configuration& held, std::size_t body,
                          const Eigen::Isometry3d& T_camera_body) {
  const KinematicTree& tree = sought.model.tree;
  Hypothesis hypothesis{held, std::vector<std::uint8_t>(tree.bodies.size(), 0), 0.0, body};
  hypothesis.bodies[body] = 1;
  hypothesis.configuration.T_camera_base.setIdentity();
  BodyPoses poses;
  forward_kinematics(tree, hypothesis.configuration, poses);
  hypothesis.configuration.T_camera_base = T_camera_body * poses[body].inverse();
  return hypothesis;
}

}  // namespace lockbox
