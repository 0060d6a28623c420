// SPDX-License-Identifier: BSD-3-Clause
#include "covariance_file.hpp"

#include <sstream>
#include <string>

#include "lockbox/core/csv_fields.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"

namespace lockbox::app {
namespace {

/// What follows the time stamp.
Eigen::MatrixXd matrix_of(const std::string& line, Eigen::Index unknowns,
                          const std::string& where) {
  Eigen::MatrixXd matrix(unknowns, unknowns);
  const std::vector<std::string_view> fields = split_fields(line);
  bool is_row = static_cast<Eigen::Index>(fields.size()) == matrix.size() + 1;
  for (Eigen::Index i = 0; is_row && i < matrix.size(); ++i) {
    const auto number = parse_number(fields[static_cast<std::size_t>(i + 1)]);
    is_row = number.has_value();
    if (is_row) matrix(i / unknowns, i % unknowns) = *number;
  }
  if (!is_row) {
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
