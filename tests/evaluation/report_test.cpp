// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/report.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "lockbox/core/error.hpp"
#include "lockbox/evaluation/bounds_file.hpp"
#include "lockbox/evaluation/figure.hpp"
#include "slider_and_dial.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Report : public testing::Test {
 protected:
  Report() { fs::create_directory(folder_); }

  /// Two frames: the base 3 mm and the slider 5 mm off, then nothing known.
  Evaluation evaluation() const {
    StatesFile reference{{}, {state_at(0.0, {0, 0, 1}, 0, 0), state_at(0.5, {0, 0, 1}, 0, 0)}};
    StatesFile estimate{{}, {state_at(0.0, {0.003, 0, 1}, 0.005, 0)}};
    return evaluate(tree_, estimate, reference);
  }

  void expect_refusal_of_bounds(const std::string& text, const std::string& problem) const {
    const fs::path file = folder_ / "bounds.csv";
    std::ofstream(file) << text;
    try {
      read_bounds(file, tree_);
      ADD_FAILURE() << "accepted " << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(problem), std::string::npos) << error.what();
    }
  }

  KinematicTree tree_ = slider_and_dial();
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_ / "report's folder";  // a name to be quoted
};

TEST_F(Report, SummarizesAsJson) {
  write_summary(folder_ / "summary.json", tree_, evaluation());
  const auto summary = nlohmann::json::parse(content(folder_ / "summary.json"));
  EXPECT_EQ(summary["frames"], 2);
  EXPECT_EQ(summary["frames_without_estimate"], 1);
  EXPECT_DOUBLE_EQ(summary["status"]["tracking_share"], 0.5);
  EXPECT_NEAR(summary["base"]["translation"]["rmse"], 0.003, 1e-12);
  EXPECT_EQ(summary["joints"]["slider"]["unit"], "m");
  EXPECT_NEAR(summary["joints"]["slider"]["maximum"], 0.005, 1e-12);
  EXPECT_EQ(summary["joints"]["dial"]["unit"], "rad");
  EXPECT_TRUE(summary["joints"]["dial"]["undetermined"]["honest_share"].is_null());
}

TEST_F(Report, ListsErrorsFrameByFrame) {
  write_errors(folder_ / "errors.csv", tree_, evaluation());
  std::ifstream in(folder_ / "errors.csv");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "timestamp,status,translation,rotation,slider,dial");
  std::getline(in, line);
  EXPECT_EQ(line.substr(0, 11), "0,tracking,");
  EXPECT_EQ(line.substr(line.size() - 10), ",0,0.005,0");
  std::getline(in, line);
  EXPECT_EQ(line, "0.5,,nan,nan,nan,nan");
}

TEST_F(Report, NamesTheFileThatCannotBeWritten) {
  EXPECT_THROW(write_errors(folder_ / "missing" / "errors.csv", tree_, evaluation()), InputError);
}

TEST_F(Report, PlotsErrorsAsPngAndSvg) {
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs gnuplot";
  EXPECT_EQ(write_error_plots(folder_, tree_, evaluation()), "");
  for (const char* name : {"base", "joints"}) {
    EXPECT_EQ(content(folder_ / (std::string(name) + ".png")).substr(1, 3), "PNG") << name;
    EXPECT_NE(content(folder_ / (std::string(name) + ".svg")).find("</svg>"), std::string::npos);
  }
  EXPECT_NE(content(folder_ / "joints.svg").find("slider"), std::string::npos);
}

TEST_F(Report, SaysWhenGnuplotIsMissing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const std::string problem = write_error_plots(folder_, tree_, evaluation());
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(problem.find("gnuplot is not installed"), std::string::npos) << problem;
  EXPECT_NE(content(folder_ / "base.gp").find("0 3"), std::string::npos);  // 3 mm at 0 s
}

TEST_F(Report, PlotsAHeatMapBehindItsCurves) {
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs gnuplot";
  Panel panel{"x", "y", {{"contour", {1.5, 2.0}, {0.0, 10.0}}}};
  panel.heat_map = HeatMap{"share (%)", {1.0, 2.0, 3.0}, {0.0, 10.0}, {100, 50, 0, 90, 40, 10}};
  EXPECT_EQ(write_figure(folder_ / "map", {"map", {panel}}), "");
  const std::string picture = content(folder_ / "map.svg");
  EXPECT_NE(picture.find("share (%)"), std::string::npos);
  EXPECT_NE(picture.find("contour"), std::string::npos);
  // Cells reach half way to their neighbours.
  EXPECT_NE(content(folder_ / "map.gp").find("2 10 1.5 2.5 5 15 40"), std::string::npos);
}

TEST_F(Report, PlotsNothingOfNothing) {
  const Figure empty{"nothing", {{"x", "y", {{"no value", {0.0}, {std::nan("")}}}, false}}};
  EXPECT_NE(write_figure(folder_ / "nothing", empty), "");
  EXPECT_FALSE(fs::exists(folder_ / "nothing.gp"));
}

TEST_F(Report, BoundsFilesReadBackWhatWasWritten) {
  const double infinity = std::numeric_limits<double>::infinity();
  FrameBound bound{1.0 / 3.0, Eigen::VectorXd::Constant(8, 1e-5)};
  bound.sigma[7] = infinity;
  write_bounds(folder_ / "bounds.csv", tree_, {bound, {0.5, Eigen::VectorXd::Ones(8)}});
  const auto bounds = read_bounds(folder_ / "bounds.csv", tree_);
  ASSERT_EQ(bounds.size(), 2U);
  EXPECT_EQ(bounds[0].stamp, bound.stamp);
  EXPECT_EQ(bounds[0].sigma, bound.sigma);
}

TEST_F(Report, BoundsFilesOfOtherModelsOrWithOtherNumbersAreRefused) {
  const std::string header = "timestamp,tx,ty,tz,rx,ry,rz,slider,dial\n";
  expect_refusal_of_bounds("timestamp,tx,ty,tz,rx,ry,rz,door\n", "bounds.csv:1");
  expect_refusal_of_bounds(header + "0,1,1,1,1,1,1,1\n", "bounds.csv:2: has 8 fields");
  expect_refusal_of_bounds(header + "0,1,1,1,1,1,1,1,-1\n", "column 'dial': '-1'");
  expect_refusal_of_bounds(header + "0,1,1,1,1,1,1,1,\n", "column 'dial': ''");
  expect_refusal_of_bounds(header + "1,1,1,1,1,1,1,1,1\n1,1,1,1,1,1,1,1,1\n", "bounds.csv:3");
}

}  // namespace
}  // namespace lockbox
