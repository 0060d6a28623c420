// SPDX-License-Identifier: BSD-3-Clause
// What a failed search says to people.
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "lockbox/tracking/search_failure.hpp"

namespace lockbox {
namespace {

/// Share of the pixels with a depth: black, shiny or near scenes have that few. Twice as many are
/// often enough to find a model in.
constexpr double kLittleDepth = 0.1;
/// Share of the depths that lie out of range: an object may be in the rest.
constexpr double kNearlyAll = 0.9;
/// Degrees; the depth cameras that are sold have 40 to 120. Cropped images are narrower.
constexpr double kNarrowestView = 15.0;
constexpr double kWidestView = 140.0;
/// Times what the view spans: of what is larger, no side is seen as a whole.
constexpr double kTooLarge = 1.5;
/// Pixels: fewer show no side of a model.
constexpr double kFewestPixels = 16.0;
/// Times the assumed noise: where small things fill the image, it is estimated 1.8 times too large.
constexpr double kNoisier = 2.0;
/// Metres that objects are usually seen from.
constexpr double kUsuallyNearest = 0.3;
constexpr double kUsuallyFarthest = 4.0;
/// Units per metre that depths come in: millimetres, TUM's, tenths of millimetres, PrimeSense's
/// hundredths, micrometres, centimetres, metres.
constexpr std::array kUsualUnits{1000.0, 5000.0, 1e4, 1e5, 1e6, 100.0, 1.0};

constexpr const char* kOtherUnit =
    "is the mesh in another unit (the scale in the URDF, --mesh-scale), or are the depths "
    "(--depth-scale)?";

std::string number(double value) {
  std::ostringstream text;
  // Two digits are enough, and more are only shown of whole numbers.
  if (std::abs(value) >= 10.0) {
    text << std::lround(value);
  } else {
    text << std::setprecision(2) << value;
  }
  return text.str();
}

std::string units(double per_metre) {
  return number(per_metre) + (per_metre == 1.0 ? " unit per metre" : " units per metre");
}

std::string pixels(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << value;
  return text.str();
}

std::string percent(double share) {
  return number(100.0 * share) + " %";
}

/// Units per metre with which half of the depths would be of a usual size; 0: none is known.
double likely_units(const SearchFailure& failure) {
  for (const double units : kUsualUnits) {
    const double median = failure.median_depth * failure.units_per_metre / units;
    if (median >= kUsuallyNearest && median <= kUsuallyFarthest) return units;
  }
  return 0.0;
}

std::string out_of_range(const SearchFailure& failure) {
  const bool is_far = failure.too_far > failure.too_near;
  std::ostringstream text;
  text << percent(is_far ? failure.too_far : failure.too_near) << " of the depths are "
       << (is_far ? "farther than " : "nearer than ")
       << number(is_far ? failure.max_depth : failure.min_depth)
       << " m and are not used; half of them are " << (is_far ? "beyond " : "within ")
       << number(failure.median_depth) << " m. They are read as " << units(failure.units_per_metre);
  const double likely = likely_units(failure);
  // A tenth: closer units cannot be told apart by how far away things are.
  if (likely > 0.0 && std::abs(likely - failure.units_per_metre) > 0.1 * likely) {
    text << "; if that is wrong, try --depth-scale " << std::lround(likely) << '.';
  } else {
    text << "; is --depth-scale right?";
  }
  return text.str();
}

bool is_out_of_range(const SearchFailure& failure) {
  return failure.too_far + failure.too_near > kNearlyAll;
}

/// What the frame alone proves.
void add_reasons_of_frame(const SearchFailure& failure, std::vector<std::string>& all) {
  if (failure.measured == 0.0) {
    all.emplace_back(
        "No pixel has a depth: is the lens covered, or everything nearer than the camera can "
        "measure?");
    return;
  }
  if (is_out_of_range(failure)) all.push_back(out_of_range(failure));
  if (failure.field_of_view < kNarrowestView || failure.field_of_view > kWidestView) {
    all.push_back("By its focal length the camera sees " + number(failure.field_of_view) +
                  " degrees from left to right, which hardly any depth camera does: is the "
                  "calibration that of these images (--camera-info)?");
  }
  if (failure.view_size > 0.0 && failure.model_size > kTooLarge * failure.view_size) {
    all.push_back("The model is " + number(failure.model_size) +
                  " m across, but the view no more than " + number(failure.view_size) +
                  " m even where it is farthest: " + kOtherUnit);
  }
  if (failure.view_size > 0.0 && failure.model_pixels < kFewestPixels) {
    all.push_back("The model is " + number(failure.model_size) + " m across, which is " +
                  number(failure.model_pixels) +
                  " pixels even where the view is nearest, too few to find it: " + kOtherUnit);
  }
}

std::string of_place(const SearchFailure::Place& place) {
  std::ostringstream text;
  text << "The likeliest place is " << number(place.distance)
       << " m away, but not likely enough: " << percent(place.explained)
       << " of the model's visible surface are measured there, " << percent(place.contradicted)
       << " are seen through or lie elsewhere, " << percent(place.occluded) << " are hidden";
  if (!place.contradicted_body.empty()) {
    text << "; what speaks against it most is '" << place.contradicted_body << "'";
  }
  text << ".";
  // Half: from there on the model may be a part of something larger.
  if (place.continued > 0.5) {
    text << " The surface goes on beyond " << percent(place.continued)
         << " of its contour, as a wall or table does.";
  }
  return text.str();
}

std::string nothing_resembles(const SearchFailure& failure) {
  return "Nothing in view resembles the model: is it in view, between " +
         number(failure.min_depth) + " and " + number(failure.max_depth) + " m from the camera?";
}

std::string looks_the_same(std::size_t others) {
  return "It is found, but looks the same with its base turned and its joints moved to suit, in at "
         "least " +
         number(static_cast<double>(others)) + (others == 1 ? " other way" : " other ways") +
         ", which no image tells apart (column alternatives of states.csv). Say how it stands in "
         "the first frame (--initial-state), hold a joint (--lock-joint), or narrow its limits.";
}

/// What may be wrong and an image cannot tell, each with the figure to compare.
void add_what_to_check(const SearchFailure& failure, std::vector<std::string>& all) {
  all.emplace_back("If the object is in view, and mostly unhidden, check these:");
  all.push_back("- depths: half of them are within " + number(failure.median_depth) +
                " m, read as " + units(failure.units_per_metre) + " (--depth-scale)");
  all.push_back("- camera: it sees " + number(failure.field_of_view) +
                " degrees from left to right by its focal length (--camera-info)");
  all.push_back("- its principal point: cx " + pixels(failure.camera.cx) + ", cy " +
                pixels(failure.camera.cy) + " (--camera-info), where the image's middle is " +
                pixels(0.5 * (failure.camera.width - 1)) + ", " +
                pixels(0.5 * (failure.camera.height - 1)));
  if (failure.noise > kNoisier * failure.assumed_noise) {
    all.push_back("- sensor: depths err by " + number(1e3 * failure.noise) + " mm at " +
                  number(failure.median_depth) + " m, where " +
                  number(1e3 * failure.assumed_noise) +
                  " mm are assumed (--sensor auto, or the name of yours)");
  }
  all.push_back("- model: it is " + number(failure.model_size) +
                " m across; is it this object, and in metres? (lockbox inspect, --mesh-scale)");
}

}  // namespace

bool is_explained(const SearchFailure& failure) {
  std::vector<std::string> all;
  add_reasons_of_frame(failure, all);
  return !all.empty();
}

std::vector<std::string> reasons(const SearchFailure& failure) {
  std::vector<std::string> all;
  if (failure.is_mirrored) {
    all.emplace_back(
        "The model is found in the mirror image of the frame: switch mirroring off where the "
        "images "
        "are made, and record anew, or is the model mirrored (a negative scale)?");
  }
  if (failure.depth_factor != 1.0) {
    all.push_back(
        "Nobody has said in which unit the depths are. Something like the model is seen "
        "if they are read in another one: is --depth-scale " +
        number(failure.units_per_metre / failure.depth_factor) + " the camera's?");
  }
  add_reasons_of_frame(failure, all);
  if (failure.look_alikes > 0) all.push_back(looks_the_same(failure.look_alikes));
  if (!all.empty()) return all;
  if (failure.measured < kLittleDepth) {
    all.push_back("Only " + percent(failure.measured) +
                  " of the pixels have a depth: black, shiny, transparent and very near surfaces, "
                  "and sunlight, give none.");
  }
  if (failure.best) {
    all.push_back(of_place(*failure.best));
  } else {
    all.push_back(nothing_resembles(failure));
  }
  add_what_to_check(failure, all);
  return all;
}

}  // namespace lockbox
