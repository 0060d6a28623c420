// SPDX-License-Identifier: BSD-3-Clause
#include "linearization.hpp"

namespace lockbox {

bool Linearization::Place::is(const PredictedView& view, const Configuration& configuration,
                              double sigma) const {
  return view_ == &view && sigma_ == sigma && configuration_.q == configuration.q &&
         configuration_.T_camera_base.matrix() == configuration.T_camera_base.matrix();
}

bool Linearization::Place::is_near(const PredictedView& view, const Configuration& configuration,
                                   double sigma, double metres, const MotionMetric& moves) const {
  return view_ == &view && sigma <= sigma_ && moves.between(configuration_, configuration) < metres;
}

void Linearization::Place::set(const PredictedView& view, const Configuration& configuration,
                               double sigma) {
  view_ = &view;
  configuration_ = configuration;
  sigma_ = sigma;
}

void Linearization::begin(bool goes_on) {
  linearized_at.forget();
  ahead_at.forget();
  if (!goes_on) selected_at.forget();
}

void SolutionSystem::forget(Eigen::Index unknown) {
  data.forget(unknown);
  for (BodyJacobian& jacobian : jacobians) jacobian.col(unknown).setZero();
}

}  // namespace lockbox
