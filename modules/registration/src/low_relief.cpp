// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/low_relief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/surface_levers.hpp"
#include "lockbox/registration/joint_prominence.hpp"

namespace lockbox {
namespace {

constexpr int kPixelsAround = 4;
constexpr double kPixelsPulled = 16.0;  // by points, at most
constexpr double kScanPixels = 0.75;    // from one position to the next over the whole range
constexpr int kMostPositions = 128;
constexpr double kSettlePixels = 0.5;  // on each side, for the derivative
constexpr double kLeastGain = 9.0;     // of chi^2

/// Within the limits, each once.
void put_between(const VariableLimits& limits, std::vector<double>& positions) {
  for (double& position : positions) position = std::clamp(position, limits.lower, limits.upper);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
}

std::size_t best(const std::vector<double>& costs) {
  return static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

/// Of a chi^2 that is larger than its pixels, the noise is larger than assumed, or less alike.
double excess(double chi_squared, int pixels) {
  return std::max(1.0, chi_squared / pixels);
}

}  // namespace

LowRelief::LowRelief(const ArticulatedModel& model, const RegistrationOptions& options)
    : model_(model),
      noise_(options.noise),
      prominences_(joint_prominences(model)),
      levers_(surface_levers(model.tree).tail(model.tree.variables())),
      patch_(model.tree, options.noise, options.cut) {}

/// Along the optical axis, of what the joint moves first.
double LowRelief::distance(int variable, const Configuration& configuration) {
  const auto joint =
      static_cast<std::size_t>(model_.tree.variable_joint[static_cast<std::size_t>(variable)]);
  const auto body = static_cast<std::size_t>(model_.tree.joints[joint].child_body);
  forward_kinematics(model_.tree, configuration, poses_);
  return poses_[body].translation().z();
}

double LowRelief::prominence(int variable, const Configuration& configuration) {
  const double z = distance(variable, configuration);
  return z > 0.0 ? prominences_[variable] / noise_.sigma_z(z)
                 : std::numeric_limits<double>::infinity();
}

/// How far the variable moves when surfaces move by a pixel.
double LowRelief::pixel_step(const PinholeCamera& camera, const Configuration& configuration,
                             int variable) {
  return distance(variable, configuration) / (camera.fx * levers_[variable]);
}

std::optional<JointSighting> LowRelief::find_near(const TiledCloud& cloud,
                                                  const Configuration& configuration, int variable,
                                                  double before) {
  const double pixel = pixel_step(cloud.camera(), configuration, variable);
  const double start = configuration.q[variable];
  const int way = static_cast<int>(
      std::clamp(std::round((before - start) / pixel), -kPixelsPulled, kPixelsPulled));
  positions_.clear();
  for (int k = std::min(0, way) - kPixelsAround; k <= std::max(0, way) + kPixelsAround; ++k) {
    positions_.push_back(start + k * pixel);
  }
  put_between(variable_limits(model_.tree, variable), positions_);
  if (!compare_positions(cloud, configuration, variable)) return std::nullopt;
  const std::size_t least = best(costs_);
  const double scatter = scatter_around(least, 1.5 * pixel);
  trial_ = configuration;
  trial_.q[variable] = positions_[least];
  auto sighting = settle(cloud, trial_, variable, kSettlePixels * pixel);
  if (sighting) sighting->variance += scatter;
  return sighting;
}

/// costs_: chi^2 of the positions.
bool LowRelief::compare_positions(const TiledCloud& cloud, const Configuration& configuration,
                                  int variable) {
  if (!patch_.draw(cloud, configuration, variable, positions_)) return false;
  costs_.clear();
  for (std::size_t k = 0; k < positions_.size(); ++k) costs_.push_back(patch_.chi_squared(k));
  return true;
}

/// The variance that positions farther than `aside` from the best one add by their likelihood.
double LowRelief::scatter_around(std::size_t least, double aside) const {
  const double scale = excess(costs_[least], patch_.pixels());
  double total = 1.0;
  double scatter = 0.0;
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    const double offset = positions_[k] - positions_[least];
    if (std::abs(offset) < aside) continue;
    const double likelihood = std::exp(-0.5 * (costs_[k] - costs_[least]) / scale);
    total += likelihood;
    scatter += likelihood * offset * offset;
  }
  return scatter / total;
}

std::optional<JointSighting> LowRelief::find_anywhere(const TiledCloud& cloud,
                                                      const Configuration& configuration,
                                                      int variable) {
  const VariableLimits limits = variable_limits(model_.tree, variable);
  const bool is_limited = std::isfinite(limits.upper - limits.lower);
  const double start = configuration.q[variable];
  const double lower = is_limited ? limits.lower : start - std::numbers::pi;
  const double upper = is_limited ? limits.upper : start + std::numbers::pi;
  const double step = kScanPixels * pixel_step(cloud.camera(), configuration, variable);
  const int count = std::clamp(static_cast<int>((upper - lower) / step) + 2, 2, kMostPositions);
  positions_.clear();
  for (int i = 0; i < count; ++i) {
    positions_.push_back(lower + (upper - lower) * i / (count - 1));
  }
  const std::size_t here = positions_.size();
  positions_.push_back(start);
  if (!compare_positions(cloud, configuration, variable)) return std::nullopt;
  const std::size_t least = best(costs_);
  const double gain = costs_[here] - costs_[least];
  if (gain < kLeastGain * excess(costs_[least], patch_.pixels())) return std::nullopt;
  trial_ = configuration;
  trial_.q[variable] = positions_[least];
  return find_near(cloud, Configuration(trial_), variable, positions_[least]);
}

/// From a position that is less than a pixel off.
std::optional<JointSighting> LowRelief::settle(const TiledCloud& cloud,
                                               const Configuration& configuration, int variable,
                                               double step) {
  const VariableLimits limits = variable_limits(model_.tree, variable);
  if (!(limits.upper - limits.lower > 2.0 * step)) return std::nullopt;
  const double start = configuration.q[variable];
  const double middle = std::clamp(start, limits.lower + step, limits.upper - step);
  positions_ = {middle - step, middle, middle + step};
  if (!patch_.draw(cloud, configuration, variable, positions_, 1)) return std::nullopt;
  const PatchLikelihood::Step newton = patch_.step(0, 1, 2);
  if (!(newton.information > 0.0)) return std::nullopt;
  const double scale = excess(patch_.chi_squared(1), patch_.pixels());
  const double change = std::clamp(newton.change, -3.0 * step, 3.0 * step);
  return JointSighting{std::clamp(middle + change, limits.lower, limits.upper),
                       scale / newton.information};
}

}  // namespace lockbox
