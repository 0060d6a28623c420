// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/bounds_file.hpp"

#include <cmath>
#include <string>

#include "lockbox/core/csv_file.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/evaluation/unknowns.hpp"
#include "output_file.hpp"

namespace lockbox {
namespace {

std::string header(const KinematicTree& tree) {
  std::string line = "timestamp";
  for (const std::string& name : unknown_names(tree)) line += "," + name;
  return line;
}

FrameBound bound_of(const CsvRow& row) {
  FrameBound bound;
  bound.stamp = row.number(0);
  if (!std::isfinite(bound.stamp))
    row.refuse(0, in_quotes(row.field(0)) + " is no time; write seconds");
  bound.sigma.resize(static_cast<Eigen::Index>(row.fields().size() - 1));
  for (std::size_t i = 1; i < row.fields().size(); ++i) {
    double& sigma = bound.sigma[static_cast<Eigen::Index>(i - 1)];
    sigma = row.number(i);
    if (!(sigma >= 0.0)) {
      row.refuse(i, in_quotes(row.field(i)) +
                        " is no standard deviation; write a number that is not negative, or inf");
    }
  }
  return bound;
}

}  // namespace

void write_bounds(const std::filesystem::path& file, const KinematicTree& tree,
                  const std::vector<FrameBound>& bounds) {
  OutputFile out(file);
  out.stream() << header(tree) << '\n';
  for (const FrameBound& bound : bounds) {
    out.stream() << number_text(bound.stamp);
    for (const double sigma : bound.sigma) out.stream() << ',' << number_text(sigma);
    out.stream() << '\n';
  }
  out.close();
}

std::vector<FrameBound> read_bounds(const std::filesystem::path& file, const KinematicTree& tree) {
  CsvFile csv(file);
  csv.require_header(header(tree), "this model's bounds");
  std::vector<FrameBound> bounds;
  for (CsvRow row; csv.next(row);) {
    bounds.push_back(bound_of(row));
    if (bounds.size() > 1 && bounds.back().stamp <= bounds[bounds.size() - 2].stamp) {
      row.refuse("its time is not after that of the row before");
    }
  }
  return bounds;
}

}  // namespace lockbox
