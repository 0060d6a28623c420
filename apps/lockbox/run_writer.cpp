// SPDX-License-Identifier: BSD-3-Clause
#include "run_writer.hpp"
#include "command_line/output_paths.hpp"
#include "lockbox/core/number_text.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "lockbox/core/error.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/model/told_rotation.hpp"
#include "lockbox/tracking/reported.hpp"

namespace lockbox::app {
namespace {

constexpr int kDigits = 9;  // of quantities that nobody computes with further

std::ofstream open_for_writing(const std::filesystem::path& file) {
  std::ofstream stream(file);
  stream.imbue(std::locale::classic());
  stream.precision(kDigits);
  if (!stream) throw InputError(file.string(), "cannot be written");
  return stream;
}

/// Flushes a finished row and says so if the disk is full.
void end_row(std::ofstream& stream, const std::filesystem::path& file) {
  stream << '\n' << std::flush;
  if (!stream) throw InputError(file.string(), "cannot be written; is there space on the disk?");
}

/// Some libraries would print "-nan".
double plain(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value;
}

void write_covariance_header(std::ofstream& stream, const KinematicTree& tree) {
  stream << "# covariance of a step (v, w, joint variables), row by row: the base moves as\n"
            "# T_camera_base exp(v, w), with v in metres and w in radians in the base's frame\n"
            "timestamp";
  std::vector<std::string> unknowns = {"vx", "vy", "vz", "wx", "wy", "wz"};
  for (const int joint : tree.variable_joint) {
    unknowns.push_back(tree.joints[static_cast<std::size_t>(joint)].name);
  }
  for (const auto& row : unknowns) {
    for (const auto& column : unknowns) stream << ',' << row << ':' << column;
  }
  stream << '\n' << std::flush;
}

/// Whether it holds nothing but the header of a states file.
bool is_without_rows(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string header;
  std::getline(stream, header);
  const bool is_ours = header.empty() || header.starts_with("timestamp,");
  return is_ours && stream.peek() == std::ifstream::traits_type::eof();
}

}  // namespace

std::string alternatives_text(const std::vector<Alternative>& alternatives) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  for (const Alternative& alternative : alternatives) {
    if (&alternative != &alternatives.front()) text << ';';
    text << to_string(alternative.kind) << ':' << alternative.probability;
  }
  return text.str();
}

bool require_no_rows(const std::filesystem::path& folder, bool overwrite) {
  const auto file = folder / "states.csv";
  const bool is_empty_run = std::filesystem::is_regular_file(file) && is_without_rows(file);
  if (!is_empty_run) require_new(file, overwrite);
  return is_empty_run;
}

RunWriter::RunWriter(const std::filesystem::path& folder, const KinematicTree& tree,
                     bool with_covariance)
    : folder_(folder), tree_(tree), unknown_(unknown_configuration(tree)) {
  make_folder(folder);
  states_ = open_for_writing(folder / "states.csv");
  base_ = open_for_writing(folder / "base.tum");
  states_ << states_header(tree) << ",status";
  for (const int joint : tree.file_order) {
    states_ << ',' << tree.joints[static_cast<std::size_t>(joint)].name << ".sigma";
  }
  states_ << ",residual_rms,explained,contradicted,latency_ms,belief,alternatives";
  end_row(states_, folder / "states.csv");
  alternatives_ = open_for_writing(folder / "alternatives.csv");
  alternatives_ << states_header(tree) << ",kind,probability";
  end_row(alternatives_, folder / "alternatives.csv");
  if (with_covariance) {
    covariance_ = open_for_writing(folder / "covariance.csv");
    write_covariance_header(covariance_, tree);
  } else {
    std::filesystem::remove(folder / "covariance.csv");  // of the run that is overwritten
  }
}

void RunWriter::write(const TrackingResult& result) {
  write_state(result);
  if (is_known(result)) write_base(result);
  write_alternatives(result);
  if (covariance_.is_open()) write_covariance(result);
}

void RunWriter::write_state(const TrackingResult& result) {
  states_ << states_row(tree_, result.stamp, is_known(result) ? result.configuration : unknown_)
          << ',' << to_string(result.status);
  for (const int joint : tree_.file_order) {
    states_ << ',' << plain(joint_sigma(tree_.joints[static_cast<std::size_t>(joint)], result));
  }
  states_ << ',' << plain(result.residual_rms) << ',' << plain(result.explained) << ','
          << plain(result.contradicted) << ',' << result.latency_ms << ',' << result.belief << ','
          << alternatives_text(result.alternatives);
  end_row(states_, folder_ / "states.csv");
}

void RunWriter::write_base(const TrackingResult& result) {
  const Eigen::Isometry3d& T = result.configuration.T_camera_base;
  const Eigen::Quaterniond rotation = told_rotation(T);
  base_ << fixed_number_text(result.stamp) << ' ' << T.translation().x() << ' '
        << T.translation().y() << ' ' << T.translation().z() << ' ' << rotation.x() << ' '
        << rotation.y() << ' ' << rotation.z() << ' ' << rotation.w();
  end_row(base_, folder_ / "base.tum");
}

void RunWriter::write_alternatives(const TrackingResult& result) {
  for (const Alternative& alternative : result.alternatives) {
    alternatives_ << states_row(tree_, result.stamp, alternative.configuration) << ','
                  << to_string(alternative.kind) << ',' << alternative.probability;
    end_row(alternatives_, folder_ / "alternatives.csv");
  }
}

void RunWriter::write_covariance(const TrackingResult& result) {
  covariance_ << number_text(result.stamp);
  const Eigen::Index unknowns = tree_.unknowns();
  for (Eigen::Index row = 0; row < unknowns; ++row) {
    for (Eigen::Index column = 0; column < unknowns; ++column) {
      covariance_ << ','
                  << (is_known(result) ? plain(result.covariance(row, column))
                                       : std::numeric_limits<double>::quiet_NaN());
    }
  }
  end_row(covariance_, folder_ / "covariance.csv");
}

}  // namespace lockbox::app
