// SPDX-License-Identifier: BSD-3-Clause
#include "m3t_figures.hpp"

#include <limits>

namespace lockbox::app {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kBest = "M3T best";
constexpr const char* kFast = "M3T fast";

}  // namespace

// `static` and `moving` over five seeds of noise, the others one run each.
const std::vector<AccuracyRow>& m3t_accuracy() {
  static const std::vector<AccuracyRow> rows = {
      {"static", kBest, {.32, 1.9, 3.2}, {.05, kNone, .25}, {.02, kNone, .10}, {.34, 2.0, 3.1}},
      {"static",
       kFast,
       {1.23, 10.7, 11.5},
       {.24, kNone, 1.50},
       {.07, kNone, .40},
       {1.9, 15.3, 15.7}},
      {"moving", kBest, {.29, 2.1, 2.5}, {.05, kNone, .30}, {.03, kNone, .11}, {.35, 2.5, 3.4}},
      {"moving", kFast, {1.92, 8.4, 8.7}, {.21, kNone, .86}, {.08, kNone, .35}, {2.6, 8.6, 8.9}},
      {"occluded", kBest, {.33, 2.2, 4.4}, {.04, kNone, .18}, {.03, kNone, .08}, {.30, kNone, 4.8}},
      {"occluded",
       kFast,
       {1.36, 10.5, 10.8},
       {.23, kNone, 1.3},
       {.07, kNone, .34},
       {2.2, kNone, 14.0}},
      {"sl_static",
       kBest,
       {.41, 3.0, 4.5},
       {.08, kNone, .60},
       {.03, kNone, .12},
       {.40, kNone, 4.3}},
      {"sl_static",
       kFast,
       {1.5, 10.7, 11.4},
       {.25, kNone, 1.4},
       {.08, kNone, .38},
       {2.3, kNone, 15.7}},
      {"sl_moving",
       kBest,
       {.65, 3.1, 6.2},
       {.09, kNone, .68},
       {.04, kNone, .21},
       {.81, kNone, 7.0}},
      {"sl_moving",
       kFast,
       {2.4, 8.2, 8.5},
       {.22, kNone, 1.0},
       {.09, kNone, .37},
       {2.4, kNone, 9.6}},
  };
  return rows;
}

const std::vector<TimeRow>& m3t_times() {
  static const std::vector<TimeRow> rows = {{kBest, 4.42, 4.6, 4.09}, {kFast, .69, kNone, .69}};
  return rows;
}

const std::vector<CaptureRow>& m3t_capture() {
  static const std::vector<CaptureRow> rows = {
      {"8 cm", 30, 75},
      {"15 degrees", 100, 100},
      {"10 degrees and 6.7 cm", 80, 100},
      {"door 20 degrees", 100, 100},
      {"slide 8 cm", 0, 100},
  };
  return rows;
}

const std::vector<FastMotionRow>& m3t_fast_motion() {
  static const std::vector<FastMotionRow> rows = {{1, "1.92", ".29"},
                                                  {2, "4.6", "holds"},
                                                  {3, "13 (maximum 34)", "holds"},
                                                  {6, "lost silently", ".29"},
                                                  {10, "lost silently", "lost silently"}};
  return rows;
}

}  // namespace lockbox::app
