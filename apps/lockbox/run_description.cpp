// SPDX-License-Identifier: BSD-3-Clause
#include "run_description.hpp"

#include <yaml-cpp/yaml.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "command_line/version.hpp"
#include "command_line/whole_file.hpp"

namespace lockbox::app {
namespace {

constexpr std::array kAllStatuses = {TrackingStatus::initializing, TrackingStatus::tracking,
                                     TrackingStatus::uncertain, TrackingStatus::lost};

void emit_values(YAML::Emitter& out, const std::string& key, const NamedValues& values) {
  out << YAML::Key << key << YAML::Value << YAML::BeginMap;
  for (const auto& [name, value] : values) out << YAML::Key << name << YAML::Value << value;
  out << YAML::EndMap;
}

void emit_camera(YAML::Emitter& out, const PinholeCamera& camera) {
  out << YAML::Key << "camera" << YAML::Value << YAML::Flow << YAML::BeginMap;
  out << YAML::Key << "width" << YAML::Value << camera.width;
  out << YAML::Key << "height" << YAML::Value << camera.height;
  out << YAML::Key << "fx" << YAML::Value << camera.fx;
  out << YAML::Key << "fy" << YAML::Value << camera.fy;
  out << YAML::Key << "cx" << YAML::Value << camera.cx;
  out << YAML::Key << "cy" << YAML::Value << camera.cy << YAML::EndMap;
}

void emit_versions(YAML::Emitter& out) {
  emit_values(out, "versions",
              {{"lockbox", kVersion},
               {"compiler", kCompiler},
               {"pcl", kPclVersion},
               {"openni2", kOpenNi2Version},
               {"eigen", kEigenVersion}});
}

void emit_totals(YAML::Emitter& out, const RunTotals& totals, const std::string& end,
                 double seconds) {
  out << YAML::Key << "end" << YAML::Value << end;
  out << YAML::Key << "seconds" << YAML::Value << seconds;
  out << YAML::Key << "frames" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "total" << YAML::Value << totals.frames();
  for (const auto status : kAllStatuses) {
    out << YAML::Key << to_string(status) << YAML::Value << totals.frames_with(status);
  }
  out << YAML::Key << "unreadable" << YAML::Value << totals.faults().unreadable;
  out << YAML::Key << "restamped" << YAML::Value << totals.faults().restamped;
  out << YAML::Key << "dropped" << YAML::Value << totals.faults().dropped;
  out << YAML::EndMap;
  out << YAML::Key << "outages" << YAML::Value << totals.faults().outages;
  if (totals.frames() == 0) return;  // nothing was measured
  out << YAML::Key << "latency_ms" << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const int percent : {50, 95, 99, 100}) {
    out << YAML::Key << std::string("p").append(std::to_string(percent)) << YAML::Value
        << totals.latency_percentile(0.01 * percent);
  }
  out << YAML::EndMap;
}

void emit_size(YAML::Emitter& out, const ApparentSize& size) {
  if (!size.covariance.allFinite()) return;  // it was never measured
  const Eigen::Vector2d sigma = size.covariance.diagonal().cwiseSqrt();
  out << YAML::Key << "apparent_size" << YAML::Value << YAML::Flow << YAML::BeginMap;
  out << YAML::Key << "across" << YAML::Value << size.value[0];
  out << YAML::Key << "across_sigma" << YAML::Value << sigma[0];
  out << YAML::Key << "along" << YAML::Value << size.value[1];
  out << YAML::Key << "along_sigma" << YAML::Value << sigma[1] << YAML::EndMap;
}

void emit_published(YAML::Emitter& out, const std::vector<Publication>& published) {
  if (published.empty()) return;
  out << YAML::Key << "published" << YAML::Value << YAML::BeginSeq;
  for (const auto& publication : published) {
    out << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "target" << YAML::Value << publication.target;
    out << YAML::Key << "readers" << YAML::Value << publication.readers;
    out << YAML::Key << "dropped" << YAML::Value << publication.dropped;
    out << YAML::Key << "address" << YAML::Value << publication.address << YAML::EndMap;
  }
  out << YAML::EndSeq;
}

}  // namespace

void RunTotals::add(const TrackingResult& result, const SourceFaults& faults) {
  faults_ = faults;
  latencies_.push_back(result.latency_ms);
  statuses_.push_back(result.status);
  if (!result.size.covariance.allFinite()) return;
  const Eigen::Matrix2d precision = result.size.covariance.inverse();
  ++frames_measured_;
  size_precision_ += precision;
  weighted_size_ += precision * result.size.value;
}

ApparentSize RunTotals::size() const {
  ApparentSize size;
  if (frames_measured_ > 0.0) {
    size.value = size_precision_.ldlt().solve(weighted_size_);
    size.covariance = frames_measured_ * size_precision_.inverse();
  }
  return size;
}

std::size_t RunTotals::frames_with(TrackingStatus status) const {
  return static_cast<std::size_t>(std::count(statuses_.begin(), statuses_.end(), status));
}

double RunTotals::latency_percentile(double share) const {
  auto sorted = latencies_;
  std::sort(sorted.begin(), sorted.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

void write_run_description(const std::filesystem::path& file, const RunDescription& description,
                           const RunTotals& totals, const std::vector<Publication>& published,
                           const std::string& end, double seconds) {
  constexpr std::size_t kDigits = 10;
  YAML::Emitter out;
  out.SetDoublePrecision(kDigits);
  out << YAML::BeginMap;
  for (const auto& [name, value] : description.origin) {
    out << YAML::Key << name << YAML::Value << value;
  }
  out << YAML::Key << "model" << YAML::Value
      << std::filesystem::absolute(description.model).string();
  out << YAML::Key << "source" << YAML::Value << description.source;
  emit_camera(out, description.camera);
  emit_values(out, "options", description.options);
  emit_values(out, "parameters", description.parameters);
  emit_versions(out);
  emit_totals(out, totals, end, seconds);
  emit_size(out, totals.size());
  emit_published(out, published);
  out << YAML::EndMap;
  write_whole_file(file, std::string(out.c_str()) + '\n');
}

}  // namespace lockbox::app
