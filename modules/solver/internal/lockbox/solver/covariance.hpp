// SPDX-License-Identifier: BSD-3-Clause
// How sure the estimate is: the sandwich H^-1 S H^-1 (White 1980), with S summed over image tiles
// (cluster-robust, Liang and Zeger 1986), so that noise which neighbouring pixels share counts as
// what it is, and a systematic floor: what no amount of data averages away, and by how much the
// tiles show the object to be unlike its model.
//
// The estimate has followed the noise of the tiles that determine it, so gradients at the
// solution are smaller than the noise was: of E[g g'] = c H_t there remains c (H_t - H_t H^-1 H_t).
// The rest is put back (as in Bell and McCaffrey 2002), with c measured over all tiles; for a part
// that a single tile sees, it is all there is.
#pragma once

#include <Eigen/Cholesky>
#include <cstddef>
#include <tuple>
#include <vector>

#include "lockbox/solver/bounded_step.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/solver/symmetric_modes.hpp"

namespace lockbox {

/// Owns its memory: once used, it allocates nothing for the same number of unknowns.
class CovarianceEstimator {
 public:
  /// data: the data terms linearised at the solution, divided by noise_correlation. tiles: what
  /// they are the sums of, not divided. Directions with too little information are unknown by a
  /// whole unit; unknowns held have sigma 0.
  void estimate(const NormalEquations& data, const std::vector<TileSystem>& tiles,
                double noise_correlation, const std::vector<BodyJacobian>& jacobians,
                const StepScale& scale, const std::vector<bool>& held);

  /// Replaces what the data says about a joint's unknown by a measurement of contours that tells
  /// nothing about the others. They are off as all contours are.
  void set_independent(Eigen::Index unknown, double variance);

  /// Whether an unknown is known to a tenth of a unit by now.
  bool determines(Eigen::Index unknown) const;

  /// The inverse of the covariance; zero for unknowns held.
  const Eigen::MatrixXd& information();

  /// Adds the information of another source, after information().
  void add_information(const Eigen::MatrixXd& information);

  /// Ends an estimate. motion_scales: metres that surfaces move for a unit of each unknown, at
  /// most.
  void add_floors(const Eigen::VectorXd& motion_scales);

  /// Returns the covariance of (base twist, variables). What follows is valid after add_floors().
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  /// Square roots of its diagonal.
  const Eigen::VectorXd& sigma() const { return sigma_; }
  /// Returns the standard deviations without what the object's misfit adds.
  const Eigen::VectorXd& sigma_of_noise() const { return sigma_of_noise_; }
  /// Returns by unknown whether that is less than a tenth of a unit.
  const std::vector<bool>& observable() const { return observable_; }

 private:
  /// Of what a system is: the tile of the image, the body, how many pixels residuals stand for; and
  /// its number among those given.
  struct Part {
    std::size_t tile;
    int body;
    double pixels;
    std::size_t number;
    bool operator<(const Part& other) const {
      return std::tie(tile, body, pixels, number) <
             std::tie(other.tile, other.body, other.pixels, other.number);
    }
  };
  /// How much more the mean residual of a tile varies than if all its residuals were independent
  /// and as large as assumed: of the tiles whose residuals stand for that many pixels.
  struct Dispersion {
    double pixels;
    double squares;
    double expected;
    int tiles;
  };
  /// Metres by which surfaces are off. Cameras err differently along their rays and across them:
  /// faces tell of the one, contours of the other.
  struct Misfit {
    double along = 0.0;
    double across = 0.0;
  };
  /// Of tiles: how much squared gradients exceed those of noise, and would if surfaces were a metre
  /// off along the ray, or across it; of those that tell of the one, and of the other.
  struct Excess {
    Eigen::Vector2d squares = Eigen::Vector2d::Zero();
    Eigen::Matrix2d of_metre = Eigen::Matrix2d::Zero();
    void add(const TileSystem& tile, double noise_correlation);
    Misfit misfit() const;
  };
  void merge(const std::vector<TileSystem>& tiles);
  void measure_dispersion();
  double dispersion(double pixels) const;
  void measure_misfits(double noise_correlation, std::size_t bodies);
  void carry_misfits(const std::vector<BodyJacobian>& jacobians);
  double misled(Eigen::Index unknown, double motion_scale) const;
  void invert(const Eigen::MatrixXd& matrix, Eigen::MatrixXd& inverse);
  void invert_information(const NormalEquations& data, const StepScale& scale,
                          const std::vector<bool>& held);
  void sum_tiles(const std::vector<BodyJacobian>& jacobians);
  void restore_what_was_followed(double noise_correlation,
                                 const std::vector<BodyJacobian>& jacobians);

  Eigen::MatrixXd covariance_;
  Eigen::VectorXd sigma_;
  Eigen::VectorXd sigma_of_noise_;
  std::vector<bool> observable_;

  std::vector<Part> order_;  ///< in which tiles are merged
  std::vector<TileSystem> merged_;
  Eigen::VectorXd unit_;  ///< by unknown; 0: held
  Eigen::MatrixXd information_;
  // Of a matrix: without one Eigen leaves members unset, and moving them is undefined.
  Eigen::LLT<Eigen::MatrixXd> definite_{Eigen::MatrixXd(0, 0)};
  Eigen::VectorXd tile_gradient_;
  Eigen::MatrixXd scatter_;
  Eigen::MatrixXd scaled_;
  Eigen::MatrixXd bread_;
  Eigen::MatrixXd product_;
  BodyJacobian image_;
  Eigen::VectorXd inverse_;
  Eigen::VectorXd unknown_modes_;
  std::vector<Dispersion> dispersions_;  ///< of all tiles, then by pixels
  std::vector<Excess> excess_;           ///< by body, and of all
  std::vector<Misfit> misfits_;          ///< by body
  std::vector<bool> is_independent_;     ///< by unknown: see set_independent
  Eigen::VectorXd misled_;               ///< by unknown
  Eigen::VectorXd told_;                 ///< information, the same
  std::vector<Matrix6> body_covariances_;
  std::vector<Matrix6> followed_;  ///< by body
  SymmetricModes modes_;
};

}  // namespace lockbox
