// SPDX-License-Identifier: BSD-3-Clause
#include "joint_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "lockbox/model/variable_range.hpp"

namespace lockbox {
namespace {

/// Steps over a joint's range, at least and at most. Source: not recorded. Doubled, the most are
/// twice as close on long ranges, and take twice the time.
constexpr int kFewestSteps = 2;
constexpr int kMostSteps = 63;
constexpr std::size_t kMostPeaks = 3;  // of what carries others
/// Joints in a row, each on the one before, of which several positions are tried. Beyond, in long
/// chains, the best one is taken: each more triples the time.
constexpr int kMostNested = 2;
/// Nor is more than one tried of a joint that carries more than so many others: all of these are
/// sought at each.
constexpr std::size_t kMostCarried = 10;
constexpr double kLeastGain = 1.0;  // pixels: worth moving for
constexpr std::size_t kBeside = 2;  // positions that are nearly the same
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Positions of a variable, equally far from each other.
struct Positions {
  std::vector<double> values;
  double step;   ///< from one to the next
  bool is_turn;  ///< the last is as far from the first

  std::size_t size() const { return values.size(); }
};

/// How many positions lie between two of them, the shorter way of a turn.
std::size_t apart(const Positions& positions, std::size_t a, std::size_t b) {
  const std::size_t way = a < b ? b - a : a - b;
  return positions.is_turn ? std::min(way, positions.size() - way) : way;
}

/// Returns by how much the best of the positions' scores exceeds all that are not beside it;
/// infinite where nothing is seen that could tell them apart.
double margin_of(const Positions& positions, const std::vector<double>& scores) {
  const auto begin = scores.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(positions.size());
  const auto best = std::max_element(begin, end);
  if (*best == *std::min_element(begin, end)) return kInfinity;
  const auto at_best = static_cast<std::size_t>(best - begin);
  double rival = -kInfinity;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (apart(positions, i, at_best) > kBeside) rival = std::max(rival, scores[i]);
  }
  return *best - rival;
}

/// Returns those whose neighbours are no better, the best first.
std::vector<std::size_t> best_peaks(const Positions& positions, const std::vector<double>& scores) {
  const std::size_t last = positions.size() - 1;
  const auto beyond = [&](std::size_t i) { return positions.is_turn ? scores[i] : -kInfinity; };
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i <= last; ++i) {
    const bool rises = scores[i] > (i == 0 ? beyond(last) : scores[i - 1]);
    const bool falls = scores[i] >= (i == last ? beyond(0) : scores[i + 1]);
    if (rises && falls) peaks.push_back(i);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  peaks.resize(std::min(peaks.size(), kMostPeaks));
  return peaks;
}

/// Scans variables of one tree in one view.
class JointScan {
 public:
  JointScan(const KinematicTree& tree, const ModelExtent& extent, ViewScore& score,
            const std::vector<int>& variables, double slack, const ScanSteps& steps,
            std::size_t held)
      : tree_(tree),
        held_(held),
        score_(score),
        variables_(variables),
        slack_(search_length(extent, slack)),
        steps_{search_length(extent, steps.metres), steps.halvings},
        extent_(extent.variables),
        nothing_(tree.bodies.size(), 0) {
    for (int v = 0; v < tree.variables(); ++v) moved_.push_back(moved_bodies(tree, v, held));
    if (held == 0) return;  // the order of the tree is outward from its base
    const auto bodies = [&](int v) {
      const auto& moved = moved_[static_cast<std::size_t>(v)];
      return std::count(moved.begin(), moved.end(), std::uint8_t{1});
    };
    std::stable_sort(variables_.begin(), variables_.end(),
                     [&](int a, int b) { return bodies(a) > bodies(b); });
  }

  /// Tells of all.
  void scan_all(Configuration& configuration, ScannedJoints& scanned) {
    scan_each(variables_, configuration, scanned);
  }

 private:
  /// Tells of those that are listed.
  void scan_each(const std::vector<int>& variables, Configuration& configuration,
                 ScannedJoints& scanned) {
    std::vector<std::uint8_t> is_done(static_cast<std::size_t>(tree_.variables()), 0);
    for (const int variable : variables) {
      if (is_done[static_cast<std::size_t>(variable)] != 0) continue;
      const std::vector<int> carried = carried_by(variable);
      scan(variable, carried, configuration, scanned);
      for (const int other : carried) is_done[static_cast<std::size_t>(other)] = 1;
    }
  }

  /// Returns those of the list that move some of what this one moves, and nothing else.
  std::vector<int> carried_by(int variable) const {
    const auto& moved = moved_[static_cast<std::size_t>(variable)];
    std::vector<int> carried;
    for (const int other : variables_) {
      const auto& own = moved_[static_cast<std::size_t>(other)];
      const bool is_part = own != moved && std::equal(own.begin(), own.end(), moved.begin(),
                                                      [](auto a, auto b) { return a <= b; });
      if (is_part) carried.push_back(other);
    }
    return carried;
  }

  void scan(int variable, const std::vector<int>& carried, Configuration& configuration,
            ScannedJoints& scanned) {
    const Positions positions = whole_range(variable, configuration);
    if (positions.size() == 0) return;
    if (!carried.empty()) {
      scan_with_carried(variable, positions, carried, configuration, scanned);
      return;
    }
    const auto& values = positions.values;
    const std::vector<double> scores = scores_at(values, variable, nothing_, configuration);
    tell(variable, positions, scores, scanned);
    const bool has_moved = move_to_best(values, variable, scores, kLeastGain, configuration);
    look_closer(positions.step, variable, nothing_, has_moved ? 0.0 : kLeastGain, configuration);
  }

  /// What is carried may stand anywhere yet, and would speak for or against every position: it is
  /// left out until the best ones are known, then scanned at each of them.
  void scan_with_carried(int variable, const Positions& positions, const std::vector<int>& carried,
                         Configuration& configuration, ScannedJoints& scanned) {
    const std::vector<std::uint8_t> left_out = moved_by(carried);
    const std::vector<double> scores =
        scores_at(positions.values, variable, left_out, configuration);
    tell(variable, positions, scores, scanned);
    std::vector<std::size_t> peaks = best_peaks(positions, scores);
    const bool follows_all = nested_ < kMostNested && carried.size() <= kMostCarried;
    if (!follows_all) peaks.resize(std::min<std::size_t>(1, peaks.size()));
    std::vector<Configuration> trials{configuration};
    if (follows_all || peaks.empty()) trials.push_back(configuration);
    for (const std::size_t peak : peaks) {
      Configuration& trial = trials.emplace_back(configuration);
      move_to(positions.values[peak], variable, trial);
      look_closer(positions.step, variable, left_out, 0.0, trial);
    }
    std::vector<ScannedJoints> scanned_there(trials.size(), scanned);
    nested_ += follows_all ? 1 : 0;
    for (std::size_t i = 1; i < trials.size(); ++i) {
      scan_each(carried, trials[i], scanned_there[i]);
    }
    nested_ -= follows_all ? 1 : 0;
    const std::vector<double> totals =
        score_.scan(trials, moved_[static_cast<std::size_t>(variable)], nothing_, slack_);
    const auto best =
        static_cast<std::size_t>(std::max_element(totals.begin(), totals.end()) - totals.begin());
    scanned = scanned_there[std::max<std::size_t>(best, 1)];  // the first trial is as it was
    if (totals[best] - totals.front() > kLeastGain) configuration = trials[best];
  }

  static void tell(int variable, const Positions& positions, const std::vector<double>& scores,
                   ScannedJoints& scanned) {
    const auto v = static_cast<std::size_t>(variable);
    scanned.margins[v] = margin_of(positions, scores);
    scanned.peaks[v].clear();
    for (const std::size_t peak : best_peaks(positions, scores)) {
      scanned.peaks[v].push_back(positions.values[peak]);
    }
  }

  std::vector<std::uint8_t> moved_by(const std::vector<int>& variables) const {
    std::vector<std::uint8_t> all = nothing_;
    for (const int variable : variables) {
      const auto& moved = moved_[static_cast<std::size_t>(variable)];
      std::transform(moved.begin(), moved.end(), all.begin(), all.begin(),
                     [](auto a, auto b) { return std::max(a, b); });
    }
    return all;
  }

  /// None if the variable moves nothing.
  Positions whole_range(int variable, const Configuration& configuration) {
    const VariableRange range = variable_range(tree_, variable, configuration.q[variable]);
    const double reach = range.extent() * motion_of(variable, configuration);
    if (!(reach > 0.0)) return {{}, 0.0, false};
    const int steps = step_count(reach, steps_.metres, kFewestSteps, kMostSteps);
    return {positions_in(range, steps), range.extent() / steps, range.is_turn};
  }

  /// Returns the scores of the positions and, last, of where the variable is.
  std::vector<double> scores_at(const std::vector<double>& positions, int variable,
                                const std::vector<std::uint8_t>& left_out,
                                const Configuration& configuration) {
    trials_.assign(positions.size() + 1, configuration);
    for (std::size_t i = 0; i < positions.size(); ++i) move_to(positions[i], variable, trials_[i]);
    return score_.scan(trials_, moved_[static_cast<std::size_t>(variable)], left_out, slack_);
  }

  /// If it is better by more than that.
  bool move_to_best(const std::vector<double>& positions, int variable,
                    const std::vector<double>& scores, double least_gain,
                    Configuration& configuration) {
    const auto best = std::max_element(scores.begin(), scores.end() - 1);
    if (!(*best - scores.back() > least_gain)) return false;
    move_to(positions[static_cast<std::size_t>(best - scores.begin())], variable, configuration);
    return true;
  }

  /// The held body stays where it is: if the variable moves it, the base goes the other way.
  void move_to(double position, int variable, Configuration& configuration) {
    const bool moves_base = moved_[static_cast<std::size_t>(variable)][0] != 0;
    Eigen::Isometry3d T_camera_held;
    if (moves_base) {
      forward_kinematics(tree_, configuration, poses_);
      T_camera_held = poses_[held_];
    }
    configuration.q[variable] = position;
    if (!moves_base) return;
    forward_kinematics(tree_, configuration, poses_);
    configuration.T_camera_base = T_camera_held * poses_[held_].inverse() * poses_[0];
  }

  /// Metres that the farthest surface moves for a unit of the variable.
  double motion_of(int variable, const Configuration& configuration) {
    const std::vector<std::uint8_t>& moved = moved_[static_cast<std::size_t>(variable)];
    if (moved[0] == 0) return extent_[variable];
    constexpr double kStep = 0.01;  // radians or metres, small against a turn
    Configuration other = configuration;
    move_to(configuration.q[variable] + kStep, variable, other);
    BodyPoses before;
    forward_kinematics(tree_, configuration, before);
    forward_kinematics(tree_, other, poses_);
    double farthest = 0.0;
    for (std::size_t b = 0; b < moved.size(); ++b) {
      if (moved[b] == 0) continue;
      farthest =
          std::max(farthest, farthest_corner(bounds(tree_.bodies[b].mesh), before[b], poses_[b]));
    }
    return farthest / kStep;
  }

  /// Halves the steps around where the variable is.
  void look_closer(double step, int variable, const std::vector<std::uint8_t>& left_out,
                   double least_gain, Configuration& configuration) {
    const VariableLimits limits = variable_limits(tree_, variable);
    for (int level = 0; level < steps_.halvings; ++level) {
      step *= 0.5;
      const VariableRange closer{std::max(limits.lower, configuration.q[variable] - step),
                                 std::min(limits.upper, configuration.q[variable] + step), false};
      const std::vector<double> positions = positions_in(closer, 2);
      const auto scores = scores_at(positions, variable, left_out, configuration);
      if (move_to_best(positions, variable, scores, least_gain, configuration)) least_gain = 0.0;
    }
  }

  const KinematicTree& tree_;
  std::size_t held_;
  ViewScore& score_;
  std::vector<int> variables_;  ///< outward from the held body
  double slack_;
  ScanSteps steps_;
  const Eigen::VectorXd& extent_;
  std::vector<std::vector<std::uint8_t>> moved_;  ///< by variable and body
  std::vector<std::uint8_t> nothing_;             ///< left out, by body
  std::vector<Configuration> trials_;
  BodyPoses poses_;
  int nested_ = 0;  ///< joints under way that carry the one that is scanned
};

}  // namespace

ScannedJoints scan_joints(const KinematicTree& tree, const ModelExtent& extent, ViewScore& score,
                          const std::vector<int>& variables, double slack, const ScanSteps& steps,
                          Configuration& configuration, std::size_t held) {
  const auto count = static_cast<std::size_t>(tree.variables());
  ScannedJoints scanned{std::vector<double>(count, kInfinity),
                        std::vector<std::vector<double>>(count)};
  JointScan(tree, extent, score, variables, slack, steps, held).scan_all(configuration, scanned);
  return scanned;
}

}  // namespace lockbox
