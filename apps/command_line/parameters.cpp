// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/parameters.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <vector>

#include "command_line/nearest_name.hpp"
#include "command_line/option_checks.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/terms/collision_mode_name.hpp"

namespace lockbox::app {
namespace {

/// What numbers a parameter may have.
enum class Range { not_negative, positive };

std::string text(double value) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(12);
  stream << value;
  return stream.str();
}

std::string text(int value) {
  return std::to_string(value);
}

std::string text(std::size_t value) {
  return std::to_string(value);
}

std::string text(bool value) {
  return value ? "true" : "false";
}

std::string text(const std::vector<bool>& values) {
  std::string list;
  for (const bool value : values) list.append(list.empty() ? "" : " ").append(text(value));
  return list;
}

std::string text(CollisionMode value) {
  return mode_name(value);
}

std::string value_of(const CLI::Option& option) {
  if (option.count() == 0) {
    return option.get_expected_max() == 0 ? "false" : option.get_default_str();
  }
  std::string values;
  for (const auto& value : option.results()) values.append(values.empty() ? "" : " ").append(value);
  return values;
}

/// Calls visit(name, value) for all parameters, and visit(name, value, Range::positive) for those
/// that something is divided by, or that must happen at all.
template <typename Visit>
void visit_registration(RegistrationOptions& registration, const Visit& visit) {
  visit("max_iterations", registration.max_iterations, Range::positive);
  visit("point_budget", registration.point_budget);
  visit("noise_depth_floor", registration.noise.depth_floor);
  visit("noise_depth_linear", registration.noise.depth_linear);
  visit("noise_depth_quadratic", registration.noise.depth_quadratic, Range::positive);
  visit("noise_lateral_pixels", registration.noise.lateral_pixels);
  visit("noise_own_share", registration.noise.own_share);
  visit("noise_correlation_pixels", registration.noise.correlation_pixels);
  visit("match_low_prominence", registration.match_low_prominence);
  visit("refine_at_edges", registration.refine_at_edges);
  visit("noise_correlation", registration.noise_correlation, Range::positive);
  visit("contour_correlation", registration.contour_correlation, Range::positive);
  visit("gate", registration.gate, Range::positive);
  visit("visible_odds", registration.visible_odds, Range::positive);
  visit("lambda_free", registration.lambda_free);
  visit("free_space_tolerance", registration.free_space_tolerance);
  visit("collision", registration.collision);
  visit("lambda_collision", registration.lambda_collision);
  visit("collision_sigma", registration.collision_sigma, Range::positive);
  visit("erosion", registration.erosion);
  visit("fixed_base", registration.fixed_base);
  visit("locked", registration.locked);
  visit("step_tolerance", registration.step_tolerance);
}

template <typename Visit>
void visit_evidence(EvidenceOptions& evidence, const Visit& visit) {
  visit("evidence_model_tolerance", evidence.model_tolerance);
  visit("evidence_most_model_tolerance", evidence.most_model_tolerance);
  visit("evidence_least_model_tolerance", evidence.least_model_tolerance, Range::positive);
  visit("evidence_contour_tolerance", evidence.contour_tolerance);
  visit("evidence_contour_pixels", evidence.contour_pixels);
  visit("evidence_line", evidence.line, Range::positive);
  visit("evidence_least_line", evidence.least_line, Range::positive);
  visit("evidence_alike", evidence.alike, Range::positive);
  visit("evidence_flush", evidence.flush, Range::positive);
  visit("evidence_faint", evidence.faint);
  visit("evidence_unmodelled", evidence.unmodelled, Range::positive);
  visit("evidence_contours", evidence.contours, Range::positive);
  visit("evidence_outliers", evidence.outliers, Range::positive);
  visit("evidence_face", evidence.face, Range::positive);
  visit("evidence_occluder_edge", evidence.occluder_edge);
  visit("evidence_least_seen", evidence.least_seen);
  visit("evidence_inverse_range", evidence.inverse_range, Range::positive);
  visit("evidence_agree", evidence.agree, Range::positive);
  visit("evidence_places", evidence.places);
  visit("evidence_beyond_a_box", evidence.beyond_a_box);
  visit("evidence_most_contradicted", evidence.most_contradicted);
}

template <typename Visit>
void visit_parameters(TrackerOptions& options, const Visit& visit) {
  visit_registration(options.registration, visit);
  visit_evidence(options.evidence, visit);
  visit("min_depth", options.cloud.min_depth);
  visit("max_depth", options.cloud.max_depth, Range::positive);
  visit("flying_pixel_jump", options.cloud.flying_pixel_jump);
  visit("threads", options.threads);
  visit("start_margin", options.start_margin);
  visit("start_sigma", options.start_sigma);
  visit("start_iterations", options.start_iterations);
  visit("start_joint_sigma", options.start_joint_sigma);
  visit("start_joint_iterations", options.start_joint_iterations);
  visit("search_anywhere", options.search_anywhere);
  visit("search_limit", options.search_limit, Range::positive);
  visit("background_search", options.background_search);
  visit("try_other_readings", options.try_other_readings);
  visit("try_other_units", options.try_other_units);
  visit("resting_move", options.resting_move);
  visit("further_iterations", options.further_iterations);
  visit("most_rounds", options.most_rounds);
  visit("least_explained", options.least_explained);
  visit("least_agreement", options.least_agreement);
  visit("least_body_agreement", options.least_body_agreement);
  visit("least_body_pixels", options.least_body_pixels);
  visit("most_groups_behind", options.most_groups_behind);
  visit("most_continued", options.most_continued);
  visit("most_last_move", options.most_last_move);
  visit("most_base_sigma", options.most_base_sigma);
  visit("most_base_turning_sigma", options.most_base_turning_sigma);
  visit("most_rival_distance", options.most_rival_distance);
  visit("most_sliding_sigma", options.most_sliding_sigma);
  visit("most_turning_sigma", options.most_turning_sigma);
  visit("convincing_belief", options.convincing_belief);
  visit("frames_between_beliefs", options.frames_between_beliefs, Range::positive);
  visit("frames_between_noises", options.frames_between_noises);
  visit("most_alternatives", options.most_alternatives);
  visit("least_of_sought_body", options.least_of_sought_body);
  visit("least_margin_of_hidden", options.least_margin_of_hidden);
  visit("lost_agreement", options.lost_agreement);
}

[[noreturn]] void refuse(const std::string& name, const std::string& value,
                         const std::string& expected) {
  throw InputError("parameter " + name, in_quotes(value) + " is " + expected);
}

void read(const std::string& name, const std::string& value, Range range, double& number) {
  const auto read = parse_number(value);
  if (!read || std::isnan(*read)) refuse(name, value, "not a number");
  if (*read < 0.0) refuse(name, value, "negative");
  if (range == Range::positive && *read == 0.0) refuse(name, value, "not above 0");
  number = *read;
}

template <typename Integer>
void read_integer(const std::string& name, const std::string& value, Range range, Integer& number) {
  double read_number = 0.0;
  read(name, value, range, read_number);
  constexpr double kMost = std::numeric_limits<int>::max();
  if (read_number != std::floor(read_number) || read_number > kMost) {
    refuse(name, value, "not a whole number of this size");
  }
  number = static_cast<Integer>(read_number);
}

void read(const std::string& name, const std::string& value, Range range, int& number) {
  read_integer(name, value, range, number);
}

void read(const std::string& name, const std::string& value, Range range, std::size_t& number) {
  read_integer(name, value, range, number);
}

void read(const std::string& name, const std::string& value, Range /*range*/, bool& is_so) {
  if (value != "true" && value != "false") refuse(name, value, "neither true nor false");
  is_so = value == "true";
}

void read(const std::string& name, const std::string& value, Range /*range*/, CollisionMode& mode) {
  for (const CollisionMode one :
       {CollisionMode::off, CollisionMode::literal, CollisionMode::eroded}) {
    if (mode_name(one) != value) continue;
    mode = one;
    return;
  }
  refuse(name, value, "none of off, literal and eroded");
}

void read(const std::string& name, const std::string& /*value*/, Range /*range*/,
          std::vector<bool>& /*held*/) {
  throw InputError("parameter " + name, "is set by --lock-joint");
}

}  // namespace

NamedValues options_in_force(const CLI::App& options) {
  NamedValues values;
  for (const CLI::Option* option : options.get_options()) {
    const bool is_setting = option != options.get_help_ptr() && !option->get_lnames().empty();
    if (is_setting) values.emplace_back(option->get_lnames().front(), value_of(*option));
  }
  return values;
}

NamedValues parameters_in_force(const TrackerOptions& options) {
  NamedValues values;
  TrackerOptions copy = options;
  visit_parameters(copy, [&values](const char* name, const auto& value, Range = {}) {
    values.emplace_back(name, text(value));
  });
  return values;
}

void set_parameter(const std::string& setting, TrackerOptions& options) {
  const std::size_t end = setting.find('=');
  if (end == std::string::npos) {
    throw InputError(in_quotes(setting), "a parameter is set by NAME=VALUE");
  }
  const std::string name = setting.substr(0, end);
  const std::string value = setting.substr(end + 1);
  bool is_known = false;
  std::vector<std::string> names;
  visit_parameters(options, [&](const char* of, auto& parameter, Range range = {}) {
    names.emplace_back(of);
    if (name != of) return;
    is_known = true;
    read(name, value, range, parameter);
  });
  if (is_known) return;
  throw InputError("parameter " + in_quotes(name),
                   "there is none of that name" + did_you_mean(name, names));
}

void add_set_option(CLI::App& options, std::vector<std::string>& settings) {
  options
      .add_option("--set", settings,
                  "Set a parameter of the tracker (docs/parameters.md), whatever else sets it: "
                  "gate=3 (repeatable)")
      ->check(readable([](const std::string& text) {
        TrackerOptions any;
        set_parameter(text, any);
      }))
      ->type_name("NAME=VALUE")
      ->default_str("");
}

}  // namespace lockbox::app
