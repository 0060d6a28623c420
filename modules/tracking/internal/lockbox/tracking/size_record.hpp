// SPDX-License-Identifier: BSD-3-Clause
// How large the object looks, over some time.
#pragma once

#include <array>
#include <cstddef>

#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

/// The mean of the last measurements, by precision. While nothing moves they err alike, so that
/// many of them are not taken for more exact than one.
class SizeRecord {
 public:
  /// Once for each frame in which the object is known: whether to measure.
  bool is_due();
  void add(const SizeMeasurement& size);

  /// Returns the mean. Its covariance is infinite until there is a measurement, and that of few
  /// ones larger than they say.
  ApparentSize mean() const;

  /// Adds to what an alignment is unsure of by how much it is off because it takes the size for 1,
  /// as far as that is more than chance; nothing until there is a measurement.
  void add_misfit(RegistrationResult& aligned) const;

 private:
  /// Measurements that the mean is of. Source: not recorded. Doubled, a change of the size is told
  /// twice as late.
  static constexpr std::size_t kKept = 6;

  std::array<SizeMeasurement, kKept> kept_;  ///< in turns
  std::size_t count_ = 0;                    ///< of all measurements
  std::size_t frames_to_next_ = 0;
  Eigen::VectorXd misled_;  ///< how far (base twist, variables) are off
};

}  // namespace lockbox
