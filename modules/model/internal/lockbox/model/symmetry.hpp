// SPDX-License-Identifier: BSD-3-Clause
// Motions after which nobody can tell that the model has moved.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// The motions T_base_base that map the whole model, joints at rest, onto itself within the
/// tolerance (metres), the identity first. Looked for among the rotations by multiples of 15
/// degrees about the axes of the base and about the principal axes of the surface, through its
/// centre, and their products.
std::vector<Eigen::Isometry3d> find_symmetries(const ArticulatedModel& model,
                                               double tolerance = 0.0005);

/// Returns those of them that map it onto itself wherever its joints stand, too: a box of equal
/// halves on a hinge looks the same back to front at rest alone.
std::vector<Eigen::Isometry3d> find_lasting_symmetries(const ArticulatedModel& model,
                                                       double tolerance = 0.0005);

/// Finds the same for one body alone, in its own frame, and of its surface at least that share: the
/// foot of a lamp is round, and so is most of a mug. The identity alone for a body without a field.
std::vector<Eigen::Isometry3d> find_body_symmetries(const ArticulatedModel& model, std::size_t body,
                                                    double share = 1.0, double tolerance = 0.0005);

/// Into how many equal parts of a full turn what a joint variable moves may be turned about the
/// joint's axis and look the same within the tolerance (metres), wherever other joints stand: 2 for
/// a knob with a bar across it, 1 if none. At most 24, which is round. 1 for a prismatic joint, and
/// for a variable that drives several.
int count_joint_turns(const ArticulatedModel& model, int variable, double tolerance = 0.0005);

/// The axes, in the base's frame, about which the body of the base is round: turned about them by
/// however much, its surface stays within the tolerance (metres). One for a bottle, several for a
/// ball, and for a base of which nothing is seen.
std::vector<Eigen::Vector3d> find_round_axes(const ArticulatedModel& model,
                                             double tolerance = 0.0005);

/// Whether the model, joints as in the configuration, looks the same in a mirror (within the
/// tolerance, metres), however it is turned. Looked for among the mirrors normal to those axes,
/// together with those turns.
bool is_own_mirror_image(const ArticulatedModel& model, const Configuration& configuration,
                         double tolerance = 0.0005);

}  // namespace lockbox
