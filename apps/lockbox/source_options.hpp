// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <optional>
#include <string>

#include "lockbox/capture/frame_source.hpp"
#include "lockbox/sensor/sensor_profile.hpp"

namespace lockbox::app {

/// The options that name a source of depth frames, shared by the subcommands.
class SourceArguments {
 public:
  void add_to(CLI::App& options);

  /// Adds them for a command that can do without a source, and that takes every frame in peace.
  void add_optional_to(CLI::App& options);

  /// Adds them for a command that cannot do without a source.
  void add_peaceful_to(CLI::App& options);

  bool is_given() const { return !source_.empty(); }
  const std::string& name() const { return source_; }

  /// Throws InputError if it is a file or folder that is missing, or if the calibration or the
  /// sensor's profile is.
  void require_existing() const;

  /// What the user says of the sensor; none where its images tell. Throws InputError.
  std::optional<SensorProfile> sensor() const;

  /// Warnings go to standard error. Depths are corrected as the sensor's profile says.
  SourceOptions options() const;
  std::unique_ptr<FrameSource> open() const;

 private:
  CLI::Option* add_source(CLI::App& options);
  void add_sensor(CLI::App& options);

  std::string source_;
  std::string camera_info_;
  std::string sensor_ = "auto";
  std::optional<double> depth_scale_;
  std::string mode_;
  bool realtime_ = false;
  double patience_ = 30.0;  ///< seconds: for who plugs a camera in again
};

}  // namespace lockbox::app
