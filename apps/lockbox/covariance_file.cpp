// SPDX-License-Identifier: BSD-3-Clause
#include "covariance_file.hpp"

#include <sstream>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"

namespace lockbox::app {
namespace {

/// What follows the time stamp.
Eigen::MatrixXd matrix_of(const std::string& line, Eigen::Index unknowns,
                          const std::string& where) {
  Eigen::MatrixXd matrix(unknowns, unknowns);
  std::istringstream fields(line);
  std::string field;
  std::getline(fields, field, ',');
  Eigen::Index count = 0;
  for (; std::getline(fields, field, ','); ++count) {
    const auto number = parse_number(field);
    if (!number || count == matrix.size()) break;
    matrix(count / unknowns, count % unknowns) = *number;
  }
  if (count != matrix.size() || std::getline(fields, field, ',')) {
    throw InputError(where, "is not a row of " + std::to_string(matrix.size()) +
                                " covariances of this model; was the run of another one?");
  }
  return matrix;
}

}  // namespace

std::vector<Eigen::MatrixXd> read_covariances(const std::filesystem::path& file,
                                              Eigen::Index unknowns) {
  std::vector<Eigen::MatrixXd> matrices;
  if (!std::filesystem::exists(file)) return matrices;
  std::istringstream lines(read_text_file(file));
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line.starts_with('#') || line.starts_with("timestamp")) continue;
    matrices.push_back(matrix_of(line, unknowns, file.string() + ':' + std::to_string(number)));
  }
  return matrices;
}

}  // namespace lockbox::app
