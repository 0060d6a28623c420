// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/whitening.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace lockbox::kernels {
namespace {

using Eigen::Index;

/// More than a vector of any instruction set, and no multiple of one.
constexpr std::size_t kRows = 37;
constexpr std::size_t kColumns = 18;

class Whitening : public ::testing::Test {
 protected:
  Whitening() {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    const Eigen::MatrixXf factor =
        Eigen::MatrixXf::NullaryExpr(kRows, kRows, [&] { return normal(random); });
    C_ = factor * factor.transpose() + 5.0F * Eigen::MatrixXf::Identity(kRows, kRows);
    B_ = Eigen::MatrixXf::NullaryExpr(kRows, kColumns, [&] { return normal(random); });
  }

  /// Of a matrix, with rubbish below the diagonal if it is said to be symmetric.
  static PaddedRows padded_rows(const Eigen::MatrixXf& matrix, bool is_symmetric) {
    PaddedRows rows;
    rows.resize(static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()));
    for (Index i = 0; i < matrix.rows(); ++i) {
      for (Index j = 0; j < matrix.cols(); ++j) {
        rows.row(static_cast<std::size_t>(i))[static_cast<std::size_t>(j)] =
            is_symmetric && j < i ? 1e6F : matrix(i, j);
      }
    }
    return rows;
  }

  static Eigen::MatrixXf matrix(PaddedRows& rows) {
    Eigen::MatrixXf result(rows.rows(), rows.columns());
    for (Index i = 0; i < result.rows(); ++i) {
      for (Index j = 0; j < result.cols(); ++j) {
        result(i, j) = rows.row(static_cast<std::size_t>(i))[static_cast<std::size_t>(j)];
      }
    }
    return result;
  }

  Eigen::MatrixXf C_;
  Eigen::MatrixXf B_;
};

TEST_F(Whitening, SolvesWithTheFactorOnEveryTarget) {
  for (const auto count : {kRows, std::size_t{1}, std::size_t{16}}) {
    const auto n = static_cast<Index>(count);
    const Eigen::MatrixXf expected =
        Eigen::LLT<Eigen::MatrixXf>(C_.topLeftCorner(n, n)).matrixL().solve(B_.topRows(n));
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      PaddedRows covariance = padded_rows(C_.topLeftCorner(n, n), true);
      PaddedRows values = padded_rows(B_, false);
      whiten(covariance, values);
      const Eigen::MatrixXf whitened = matrix(values).topRows(n);
      EXPECT_LT((whitened - expected).cwiseAbs().maxCoeff(), 1e-4F) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST_F(Whitening, MultipliesColumnsOnEveryTarget) {
  const Eigen::MatrixXf expected = B_.topRows(30).transpose() * B_.topRows(30);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    PaddedRows values = padded_rows(B_, false);
    PaddedRows products;
    multiply_columns(30, values, products);
    EXPECT_LT((matrix(products) - expected).cwiseAbs().maxCoeff(), 1e-4F)
        << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
