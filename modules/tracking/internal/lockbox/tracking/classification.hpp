// SPDX-License-Identifier: BSD-3-Clause
// Is the estimate believable?
#pragma once

#include <vector>

#include "lockbox/initialization/initializer.hpp"
#include "lockbox/tracking/answer.hpp"
#include "lockbox/tracking/tracker_options.hpp"
#include "lockbox/tracking/tracking_status.hpp"

namespace lockbox {

/// Returns a score to compare answers in one frame by: Agreement::score, but what may be a piece of
/// a wall, for the scene goes on beyond its contour, explains nothing.
double score(const RegistrationResult& registered, const TrackerOptions& options);

/// Whether the image was asked, and speaks for it (lockbox/verification/belief.hpp), and enough of
/// the model is explained: of a small part much else may be right.
bool is_believed(const Answer& answer, const TrackerOptions& options);

/// Whether enough of the model is explained, and nothing that is seen contradicts it, of any body,
/// however small it is beside the others; or whether it is believed to be the object though some of
/// it does: objects differ from their models. It may still not be determined where it is.
bool agrees(const Answer& answer, const TrackerOptions& options);

/// Returns by unknown whether the frame determines it well enough to be reported as known, and
/// nothing contradicts what it moves.
std::vector<bool> known_unknowns(const RegistrationResult& registered, const KinematicTree& tree,
                                 const TrackerOptions& options);

/// Whether it has come to rest: what still moves may end anywhere.
bool rests(const RegistrationResult& registered, const TrackerOptions& options);

/// Whether it agrees, and the surface does not go on beyond the contour, as that of a wall does; or
/// whether it is believed, for evidence knows what contours say.
bool is_believable(const Answer& answer, const TrackerOptions& options);

/// Returns `tracking`, `uncertain` or `lost`. What is not believable, of which too little is seen
/// to know where the base is, or was still on its way, is `uncertain` at best.
TrackingStatus classify(const Answer& answer, const TrackerOptions& options);

/// Whether there is nothing to be sought: the answer is `tracking`, or rests and agrees while the
/// estimate is kept (is_kept), even where the image does not determine it.
bool needs_no_search(const Answer& answer, bool is_kept, const TrackerOptions& options);

/// Whether the camera sees through what the body should hide: much of it, or some groups.
bool is_contradicted(const Agreement& body, const TrackerOptions& options);

/// Whether a joint that was sought over its whole range may as well stand elsewhere: what it moves
/// is lost in the noise, or most of it is hidden, and what stands before that may pass for it at
/// many positions.
bool is_doubtful(const RegistrationResult& registered, int variable, const JointMargins& margins,
                 const KinematicTree& tree, const TrackerOptions& options);

/// Returns them in order; the first one, the base, is among them also where the whole is hardly
/// explained, or contradicted.
std::vector<int> contradicted_bodies(const RegistrationResult& registered,
                                     const TrackerOptions& options);

/// The joint variables, but for locked ones, that move a body which is contradicted.
std::vector<int> contradicted_variables(const RegistrationResult& registered,
                                        const KinematicTree& tree, const TrackerOptions& options);

}  // namespace lockbox
