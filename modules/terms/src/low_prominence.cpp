// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/low_prominence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/motion_scales.hpp"
#include "lockbox/model/variable_range.hpp"
#include "lockbox/view/joint_prominence.hpp"

namespace lockbox {
namespace {

/// Pixels that surfaces move to both sides: how far around it a joint is sought. Source: not
/// recorded. Doubled, about twice as many positions are compared.
constexpr double kPixelsAround = 4.0;
/// Standard deviations of a depth. What stands out less is followed to a dip of the noise as well,
/// where it has left too fast: its whole range is asked each time. Doubled, so are those of a
/// PrimeSense at 1.2 m, which takes half a frame's time for each.
constexpr double kFaint = 2.0;
/// From where it was before, a joint is followed that far without a look at what is around.
/// Doubled, a slider that has moved by 24 mm is taken to be in a dip of the noise half way
/// (FarSlider).
constexpr double kPixelsExpected = 2.0;
constexpr double kPixelsDragged = 16.0;  // by points, at most
constexpr double kScanPixels = 0.75;     // from one position to the next over the whole range
/// Positions of a joint that are compared, about, at most. Source: not recorded. Doubled, long
/// ranges are compared twice as closely, in twice the time.
constexpr int kMostSteps = 127;
constexpr double kLeastGain = 9.0;  // of chi^2
/// Metres that surfaces move to what is another position: half more than what counts as right.
constexpr double kElsewhere = 0.015;
/// Of the rise of chi^2 that is expected to where a part is not. It is 1 where it is there, with a
/// standard deviation of 0.2 for a slider of 12 mm by a PrimeSense at 2 m (0.61 was the least of
/// 40), and 0 in the mean where it is elsewhere, though the best of many dips has 0.3. Doubled, no
/// part is there.
constexpr double kIsThere = 0.6;

/// Puts them within the limits, each once.
void put_between(const VariableLimits& limits, std::vector<double>& positions) {
  for (double& position : positions) position = std::clamp(position, limits.lower, limits.upper);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
}

std::size_t best(std::span<const double> costs) {
  return static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

/// Returns how many times chi^2 is larger than its pixels, if it is: then the noise is larger than
/// assumed, or less alike.
double excess(double chi_squared, int pixels) {
  return std::max(1.0, chi_squared / pixels);
}

}  // namespace

LowProminence::LowProminence(const ArticulatedModel& model, const ViewOptions& options,
                             const Executor& executor)
    : model_(model),
      noise_(options.noise),
      prominences_(joint_prominences(model)),
      motion_scales_(motion_scales(model.tree).tail(model.tree.variables())),
      region_(model.tree, options.noise, options.gate, executor) {}

/// Returns the distance along the optical axis of what the joint moves first.
double LowProminence::distance(int variable, const Configuration& configuration) {
  const auto joint =
      static_cast<std::size_t>(model_.tree.variable_joint[static_cast<std::size_t>(variable)]);
  const auto body = static_cast<std::size_t>(model_.tree.joints[joint].child_body);
  forward_kinematics(model_.tree, configuration, poses_);
  return poses_[body].translation().z();
}

double LowProminence::prominence(int variable, const Configuration& configuration) {
  const double z = distance(variable, configuration);
  return z > 0.0 ? prominences_[variable] / noise_.sigma_z(z)
                 : std::numeric_limits<double>::infinity();
}

double LowProminence::pixel_step(const PinholeCamera& camera, const Configuration& configuration,
                                 int variable) {
  return distance(variable, configuration) / (camera.fx * motion_scales_[variable]);
}

/// Looks around the best position only: a slope is no match, however steep, and where it was not
/// expected, neither is a dip on a slope.
std::optional<JointMatch> LowProminence::find_near(const TiledCloud& cloud,
                                                   const Configuration& configuration, int variable,
                                                   double before) {
  const double pixel = pixel_step(cloud.camera(), configuration, variable);
  const double start = configuration.q[variable];
  const double way =
      std::clamp(std::round((before - start) / pixel), -kPixelsDragged, kPixelsDragged);
  const double elsewhere = std::ceil(kElsewhere / motion_scales_[variable] / pixel);
  const VariableLimits limits = variable_limits(model_.tree, variable);
  double first = std::min(0.0, way) - kPixelsAround;
  double last = std::max(0.0, way) + kPixelsAround;
  while (last - first <= kMostSteps) {
    positions_.clear();
    for (double k = first; k <= last; ++k) positions_.push_back(start + k * pixel);
    put_between(limits, positions_);
    costs_ = region_.compare(cloud, configuration, variable, positions_);
    if (costs_.empty()) return std::nullopt;
    const std::size_t least = best(costs_);
    const double at = (positions_[least] - start) / pixel;
    const double around = std::abs(at - way) < kPixelsExpected ? 1.0 : elsewhere;
    const bool ends_before = at - around < first && positions_.front() > limits.lower;
    const bool ends_beyond = at + around > last && positions_.back() < limits.upper;
    if (!ends_before && !ends_beyond) {
      const JointMatch match = match_at(least);
      const bool is_faint = prominence(variable, configuration) < kFaint;
      if (is_faint && !is_there(cloud, configuration, variable, match.position))
        return std::nullopt;
      return match;
    }
    if (ends_before) first = std::floor(at - around);
    if (ends_beyond) last = std::ceil(at + around);
  }
  return std::nullopt;
}

/// The variance that all positions have by their likelihood.
double LowProminence::scatter_around(std::size_t least) const {
  const double scale = excess(costs_[least], region_.pixels());
  double total = 0.0;
  double scatter = 0.0;
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    const double offset = positions_[k] - positions_[least];
    const double likelihood = std::exp(-0.5 * (costs_[k] - costs_[least]) / scale);
    total += likelihood;
    scatter += likelihood * offset * offset;
  }
  return scatter / total;
}

/// Returns the match at the vertex of the parabola through the best position and its neighbours,
/// whose width adds to the variance.
JointMatch LowProminence::match_at(std::size_t least) const {
  const double at = positions_[least];
  if (least == 0 || least + 1 >= positions_.size()) return {at, scatter_around(least)};
  const double before = positions_[least - 1] - at;
  const double after = positions_[least + 1] - at;
  const double rise_before = (costs_[least - 1] - costs_[least]) / before;
  const double rise_after = (costs_[least + 1] - costs_[least]) / after;
  const double bend = (rise_after - rise_before) / (after - before);
  if (!(bend > 0.0)) return {at, scatter_around(least)};
  const double offset = 0.5 * (before - rise_before / bend);
  return {at + std::clamp(offset, 0.5 * before, 0.5 * after),
          scatter_around(least) + excess(costs_[least], region_.pixels()) / bend};
}

/// Compared with positions all over the range, as far apart as positions have to be that are
/// others.
bool LowProminence::is_there(const TiledCloud& cloud, const Configuration& configuration,
                             int variable, double position) {
  const VariableRange range = variable_range(model_.tree, variable, position);
  const double elsewhere = kElsewhere / motion_scales_[variable];
  positions_ = positions_in(range, step_count(range.extent(), elsewhere, 1, kMostSteps));
  positions_.push_back(position);
  costs_ = region_.compare(cloud, configuration, variable, positions_);
  if (costs_.empty()) return false;
  double rise = 0.0;
  double expected = 0.0;
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    const double way = positions_[k] - position;
    const double apart = range.is_turn ? std::remainder(way, 2.0 * std::numbers::pi) : way;
    if (std::abs(apart) <= elsewhere) continue;
    if (costs_[k] < costs_.back()) return false;
    rise += costs_[k] - costs_.back();
    expected += region_.expected_rises()[k];
  }
  return rise >= kIsThere * expected;
}

RangeMatch LowProminence::find_anywhere(const TiledCloud& cloud, const Configuration& configuration,
                                        int variable) {
  const double start = configuration.q[variable];
  const VariableRange range = variable_range(model_.tree, variable, start);
  const double step = kScanPixels * pixel_step(cloud.camera(), configuration, variable);
  positions_ = positions_in(range, step_count(range.extent(), step, 1, kMostSteps));
  const std::size_t here = positions_.size();
  positions_.push_back(start);
  costs_ = region_.compare(cloud, configuration, variable, positions_);
  if (costs_.empty()) return {};
  const std::size_t least = best(costs_);
  const double gain = costs_[here] - costs_[least];
  RangeMatch result;
  if (gain >= kLeastGain * excess(costs_[least], region_.pixels())) {
    positions_.pop_back();
    costs_ = costs_.first(positions_.size());
    result.better = match_at(best(costs_));
  }
  result.is_told =
      is_there(cloud, configuration, variable, result.better ? result.better->position : start);
  return result;
}

}  // namespace lockbox
