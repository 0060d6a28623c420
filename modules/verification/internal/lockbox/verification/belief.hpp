// SPDX-License-Identifier: BSD-3-Clause
// How probable it is that an answer is right.
#pragma once

#include <span>

#include "lockbox/verification/evidence_options.hpp"

namespace lockbox {

/// The nats that it takes for a configuration that was sought anywhere to be as probable as not:
/// the logarithm of how many that can be told apart there are.
double least_evidence(const EvidenceOptions& options = {});

/// The nats that are more than a box can show, which any room may have.
double evidence_beyond_a_box(const EvidenceOptions& options = {});

/// Returns the log odds of an answer with this evidence (nats) against one with another.
double log_odds(double evidence, double against, const EvidenceOptions& options = {});

/// The probability of an answer, from its evidence (nats) and that of the other answers: one of
/// them is right, or the object is not in view (docs/verification.md).
double belief(double evidence, std::span<const double> of_others,
              const EvidenceOptions& options = {});

}  // namespace lockbox
