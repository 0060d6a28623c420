// SPDX-License-Identifier: BSD-3-Clause
#include "source_options.hpp"

#include <iostream>
#include <utility>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "lockbox/capture/camera_info.hpp"
#include "lockbox/capture/corrected_source.hpp"
#include "lockbox/capture/depth_mode.hpp"

namespace lockbox::app {

void SourceArguments::add_to(CLI::App& options) {
  add_source(options)->required();
  add_sensor(options);
  options.add_flag("--realtime", realtime_,
                   "Play recordings at recorded speed, dropping frames like a live device");
  options
      .add_option("--patience", patience_,
                  "Seconds to wait for a live device that was unplugged, or delivers nothing")
      ->check(not_negative());
}

void SourceArguments::add_optional_to(CLI::App& options) {
  add_source(options);
  add_sensor(options);
}

void SourceArguments::add_peaceful_to(CLI::App& options) {
  add_source(options)->required();
}

CLI::Option* SourceArguments::add_source(CLI::App& options) {
  CLI::Option* const source =
      options
          .add_option("-s,--source", source_,
                      "openni2:, openni2:<uri>, a .oni file, a folder with depth.txt, or a folder "
                      "of .pcd files")
          ->check(suggested({"openni2:"}))
          ->type_name("SOURCE");
  options
      .add_option("--camera-info", camera_info_,
                  "ROS camera calibration (YAML) to use instead of the source's own intrinsics")
      ->type_name("FILE");
  options
      .add_option(
          "--depth-scale", depth_scale_,
          "Units per metre of depth images in a folder (TUM data sets: 5000; else 1000), or "
          "of clouds (else 1)")
      ->check(positive());
  options
      .add_option(
          "--mode", mode_,
          "Of a live device: WIDTHxHEIGHT@RATE, with ,1mm or ,100um behind it where the "
          "unit matters, such as 320x240@60; default: as near to 640x480@30,1mm as there is")
      ->check(readable(parse_depth_mode))
      ->check(suggested({"640x480@30", "320x240@30", "320x240@60"}))
      ->type_name("MODE");
  return source;
}

void SourceArguments::add_sensor(CLI::App& options) {
  options
      .add_option("--sensor", sensor_,
                  "Profile of the sensor (YAML), or the name of a shipped one: " + sensor_names() +
                      "; auto: noise as the images show it, depths from 0.2 to 5 m")
      ->check(suggested(shipped_sensor_names()))
      ->type_name("NAME|FILE|auto");
}

std::optional<SensorProfile> SourceArguments::sensor() const {
  return sensor_ == "auto" ? std::nullopt : std::optional(find_sensor_profile(sensor_));
}

void SourceArguments::require_existing() const {
  require_source(source_);
  sensor();
  if (!camera_info_.empty()) read_camera_info(camera_info_);
}

SourceOptions SourceArguments::options() const {
  SourceOptions options;
  if (!camera_info_.empty()) options.camera_info = camera_info_;
  options.depth_scale = depth_scale_;
  if (!mode_.empty()) options.mode = parse_depth_mode(mode_);
  options.realtime = realtime_;
  options.patience = patience_;
  options.stop = interruption::requested;
  options.warn = [](const std::string& text) { std::cerr << "lockbox: warning: " << text << '\n'; };
  return options;
}

std::unique_ptr<FrameSource> SourceArguments::open() const {
  auto source = open_source(source_, options());
  const auto profile = sensor();
  if (!profile || !profile->depth_correction) return source;
  return std::make_unique<CorrectedSource>(std::move(source), *profile->depth_correction);
}

}  // namespace lockbox::app
