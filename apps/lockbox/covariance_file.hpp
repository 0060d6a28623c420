// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace lockbox::app {

/// The matrices of a covariance.csv of `lockbox track`, row by row, of so many unknowns each; empty
/// if there is no such file. Throws InputError with file and line if it holds something else.
std::vector<Eigen::MatrixXd> read_covariances(const std::filesystem::path& file,
                                              Eigen::Index unknowns);

}  // namespace lockbox::app
