// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/bounds_file.hpp"
#include "lockbox/core/csv_fields.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"
#include "lockbox/evaluation/unknowns.hpp"
#include "output_file.hpp"

namespace lockbox {
namespace {

std::string header(const KinematicTree& tree) {
  std::string line = "timestamp";
  for (const std::string& name : unknown_names(tree)) line += "," + name;
  return line;
}

FrameBound parse_row(const std::string& file, int line, const std::string& text,
                     std::size_t columns) {
  const auto fields = split_fields(text);
  if (fields.size() != columns) {
    throw InputError(file, line,
                     "has " + std::to_string(fields.size()) + " columns, but the header " +
                         std::to_string(columns));
  }
  FrameBound bound;
  bound.sigma.resize(static_cast<Eigen::Index>(columns - 1));
  for (std::size_t i = 0; i < columns; ++i) {
    const auto value = parse_number(fields[i]);
    const bool valid = value && (i == 0 ? std::isfinite(*value) : *value >= 0.0);
    if (!valid) {
      throw InputError(file, line,
                       "'" + std::string(fields[i]) + "' in column " + std::to_string(i + 1) +
                           (i == 0 ? " is no time; write seconds"
                                   : " is no standard deviation; write a number that "
                                     "is not negative, or inf"));
    }
    (i == 0 ? bound.stamp : bound.sigma[static_cast<Eigen::Index>(i - 1)]) = *value;
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
  std::istringstream in(read_text_file(file));
  std::string text;
  std::getline(in, text);
  const std::string expected = header(tree);
  if (trimmed(text) != expected) {
    throw InputError(file.string(), 1, "is not the header of this model's bounds: " + expected);
  }
  const std::size_t columns = split_fields(expected).size();
  std::vector<FrameBound> bounds;
  for (int line = 2; std::getline(in, text); ++line) {
    if (trimmed(text).empty()) continue;
    bounds.push_back(parse_row(file.string(), line, std::string(trimmed(text)), columns));
    if (bounds.size() > 1 && bounds.back().stamp <= bounds[bounds.size() - 2].stamp) {
      throw InputError(file.string(), line, "its time is not after that of the row before");
    }
  }
  return bounds;
}

}  // namespace lockbox
