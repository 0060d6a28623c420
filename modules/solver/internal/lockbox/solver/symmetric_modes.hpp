// SPDX-License-Identifier: BSD-3-Clause
// Eigenvalues and eigenvectors of a symmetric matrix, in memory that is reused:
// Eigen::SelfAdjointEigenSolver takes a vector from the heap each time it unrolls its reflections.
#pragma once

#include <Eigen/Eigenvalues>

namespace lockbox {

class SymmetricModes {
 public:
  void compute(const Eigen::MatrixXd& matrix) {
    tridiagonal_.compute(matrix);
    workspace_.resize(matrix.rows());
    basis_.resize(matrix.rows(), matrix.cols());
    tridiagonal_.matrixQ().evalTo(basis_, workspace_);
    diagonal_ = tridiagonal_.diagonal();
    off_diagonal_ = tridiagonal_.subDiagonal();
    solver_.computeFromTridiagonal(diagonal_, off_diagonal_);
    eigenvectors_.noalias() = basis_ * solver_.eigenvectors();
  }

  /// Ascending.
  const Eigen::VectorXd& eigenvalues() const { return solver_.eigenvalues(); }

  /// Unit columns, in the order of the eigenvalues.
  const Eigen::MatrixXd& eigenvectors() const { return eigenvectors_; }

 private:
  Eigen::Tridiagonalization<Eigen::MatrixXd> tridiagonal_;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd off_diagonal_;
  Eigen::VectorXd workspace_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd eigenvectors_;
};

}  // namespace lockbox
