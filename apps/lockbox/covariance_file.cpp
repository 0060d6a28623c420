// SPDX-License-Identifier: BSD-3-Clause
#include "covariance_file.hpp"

#include "lockbox/core/csv_file.hpp"

namespace lockbox::app {
namespace {

Eigen::MatrixXd matrix_of(const CsvRow& row, Eigen::Index unknowns) {
  Eigen::MatrixXd matrix(unknowns, unknowns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    matrix(i / unknowns, i % unknowns) = row.number(static_cast<std::size_t>(i + 1));
  }
  return matrix;
}

}  // namespace

std::vector<Eigen::MatrixXd> read_covariances(const std::filesystem::path& file,
                                              Eigen::Index unknowns) {
  std::vector<Eigen::MatrixXd> matrices;
  if (!std::filesystem::exists(file)) return matrices;
  CsvFile csv(file);
  const Eigen::Index expected = 1 + unknowns * unknowns;
  if (static_cast<Eigen::Index>(csv.columns().size()) != expected) {
    csv.refuse_header("has not the " + std::to_string(expected) +
                      " columns of this model's covariances; was the run of another one?");
  }
  for (CsvRow row; csv.next(row);) matrices.push_back(matrix_of(row, unknowns));
  return matrices;
}

}  // namespace lockbox::app
