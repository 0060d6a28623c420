// SPDX-License-Identifier: BSD-3-Clause
#include "parameters.hpp"

#include <locale>
#include <sstream>

#include "lockbox/terms/collision_mode_name.hpp"

namespace lockbox::app {
namespace {

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

std::string value_of(const CLI::Option& option) {
  if (option.count() == 0) {
    return option.get_expected_max() == 0 ? "false" : option.get_default_str();
  }
  std::string values;
  for (const auto& value : option.results()) values.append(values.empty() ? "" : " ").append(value);
  return values;
}

NamedValues registration_parameters(const RegistrationOptions& registration) {
  return {
      {"max_iterations", text(registration.max_iterations)},
      {"point_budget", text(registration.point_budget)},
      {"noise_depth_floor", text(registration.noise.depth_floor)},
      {"noise_depth_linear", text(registration.noise.depth_linear)},
      {"noise_depth_quadratic", text(registration.noise.depth_quadratic)},
      {"noise_lateral_pixels", text(registration.noise.lateral_pixels)},
      {"noise_own_share", text(registration.noise.own_share)},
      {"noise_correlation_pixels", text(registration.noise.correlation_pixels)},
      {"match_low_prominence", text(registration.match_low_prominence)},
      {"refine_at_edges", text(registration.refine_at_edges)},
      {"noise_correlation", text(registration.noise_correlation)},
      {"contour_correlation", text(registration.contour_correlation)},
      {"gate", text(registration.gate)},
      {"visible_odds", text(registration.visible_odds)},
      {"lambda_free", text(registration.lambda_free)},
      {"free_space_tolerance", text(registration.free_space_tolerance)},
      {"collision", mode_name(registration.collision)},
      {"lambda_collision", text(registration.lambda_collision)},
      {"collision_sigma", text(registration.collision_sigma)},
      {"erosion", text(registration.erosion)},
      {"fixed_base", text(registration.fixed_base)},
      {"locked", text(registration.locked)},
      {"step_tolerance", text(registration.step_tolerance)},
  };
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
  NamedValues values = registration_parameters(options.registration);
  const NamedValues others = {
      {"min_depth", text(options.cloud.min_depth)},
      {"max_depth", text(options.cloud.max_depth)},
      {"flying_pixel_jump", text(options.cloud.flying_pixel_jump)},
      {"threads", text(options.threads)},
      {"start_margin", text(options.start_margin)},
      {"start_sigma", text(options.start_sigma)},
      {"start_iterations", text(options.start_iterations)},
      {"start_joint_sigma", text(options.start_joint_sigma)},
      {"start_joint_iterations", text(options.start_joint_iterations)},
      {"search_anywhere", text(options.search_anywhere)},
      {"search_limit", text(options.search_limit)},
      {"background_search", text(options.background_search)},
      {"try_other_readings", text(options.try_other_readings)},
      {"try_other_units", text(options.try_other_units)},
      {"resting_move", text(options.resting_move)},
      {"further_iterations", text(options.further_iterations)},
      {"most_rounds", text(options.most_rounds)},
      {"least_explained", text(options.least_explained)},
      {"least_agreement", text(options.least_agreement)},
      {"least_body_agreement", text(options.least_body_agreement)},
      {"least_body_pixels", text(options.least_body_pixels)},
      {"most_groups_behind", text(options.most_groups_behind)},
      {"most_continued", text(options.most_continued)},
      {"most_last_move", text(options.most_last_move)},
      {"most_base_sigma", text(options.most_base_sigma)},
      {"most_base_turning_sigma", text(options.most_base_turning_sigma)},
      {"most_rival_distance", text(options.most_rival_distance)},
      {"most_sliding_sigma", text(options.most_sliding_sigma)},
      {"most_turning_sigma", text(options.most_turning_sigma)},
      {"convincing_belief", text(options.convincing_belief)},
      {"frames_between_beliefs", text(options.frames_between_beliefs)},
      {"most_alternatives", text(options.most_alternatives)},
      {"least_of_sought_body", text(options.least_of_sought_body)},
      {"least_margin_of_hidden", text(options.least_margin_of_hidden)},
      {"lost_agreement", text(options.lost_agreement)},
  };
  values.insert(values.end(), others.begin(), others.end());
  return values;
}

}  // namespace lockbox::app
