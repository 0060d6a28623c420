// SPDX-License-Identifier: BSD-3-Clause
// What `--sensor` changes, and what it refuses.
#include <gmock/gmock.h>

#include <Eigen/Core>
#include <sstream>

#include "block_runs.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::Gt;
using testing::HasSubstr;
using testing::Lt;
using testing::Ne;

class SensorOption : public BlockRuns {
 protected:
  /// Along the optical axis, metres.
  static double last_distance(const std::string& run) {
    std::istringstream row(read_lines(path(run + "/base.tum")).back());
    double stamp = 0.0;
    Eigen::Vector3d position;
    row >> stamp >> position.x() >> position.y() >> position.z();
    return position.z();
  }

  static constexpr double kSimulated = 0.0021;  // 1/metre, of primesense

  /// What the run went by, 1/metre.
  static double quadratic_noise(const std::string& run) {
    const std::string description = read_text(path(run + "/run.yaml"));
    const std::string name = "noise_depth_quadratic: ";
    const std::size_t place = description.find(name);
    return place == std::string::npos ? -1.0 : std::stod(description.substr(place + name.size()));
  }
};

TEST_F(SensorOption, NoiseIsThatOfTheProfileAndSaidInTheRun) {
  const std::string profile = path("mine.yaml");
  write_text(profile, "like: primesense\nnoise: {across_ray: 0.7, correlation_length: 6}\n");
  ASSERT_EQ(run_tool(following("mine", {"--sensor", profile})).status, 0);
  EXPECT_THAT(read_text(path("mine/run.yaml")),
              AllOf(HasSubstr("sensor: " + profile), HasSubstr("noise_lateral_pixels: 0.7"),
                    HasSubstr("noise_correlation_pixels: 6"), HasSubstr("max_depth: 4.5")));
}

TEST_F(SensorOption, ImagesAreAskedWhereNobodyNamesASensor) {
  ASSERT_EQ(run_tool(following("unasked")).status, 0);
  ASSERT_EQ(run_tool(following("asked", {"--sensor", "auto"})).status, 0);
  EXPECT_EQ(rows_without_latency(path("asked/states.csv")),
            rows_without_latency(path("unasked/states.csv")));
}

TEST_F(SensorOption, NoiseThatIsGivenIsNotLookedFor) {
  const auto run = run_tool(following("given", {"--set", "noise_depth_quadratic=0.004"}));
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_DOUBLE_EQ(quadratic_noise("given"), 0.004);
  const auto alike = run_tool(following("alike", {"--set", "contour_correlation=3"}));
  ASSERT_EQ(alike.status, 0) << alike.errors;
  EXPECT_THAT(read_text(path("alike/run.yaml")), HasSubstr("contour_correlation: 3"));
}

TEST_F(SensorOption, AutoTracksEveryFrameWhereImagesDoNotTell) {
  const auto run = run_tool(following("auto", {"--sensor", "auto"}));
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(read_lines(path("auto/states.csv")).size(), kFrames + 1);
  EXPECT_THAT(read_text(path("auto/run.yaml")), HasSubstr("sensor: auto"));
  // Faces of the block are a dozen pixels wide here: images do not tell.
  EXPECT_DOUBLE_EQ(quadratic_noise("auto"), kSimulated);
}

/// Where faces are some dozens of pixels wide, though nothing else is seen.
TEST_F(SensorOption, AutoFindsTheNoiseOutAndDoesNotTakeTheShapeOfTheBlockForIt) {
  ASSERT_EQ(run_tool({"simulate", "--model", "rigid_block", "--trajectory", start_, "--frames", "3",
                      "--sensor", "stereo", "--output", path("fine")})
                .status,
            0);
  const auto run = run_tool(tracking("fine", "fine_run", {"--initial-state", start_}));
  EXPECT_THAT(run.errors, HasSubstr("sensor: noise "));
  constexpr double kStereo = 0.0028;
  EXPECT_THAT(quadratic_noise("fine_run"), AllOf(Gt(kStereo / 1.5), Lt(1.5 * kStereo)));
}

TEST_F(SensorOption, DepthsAreCorrected) {
  // Depths that are told to be a centimetre too long put the block that much nearer.
  const std::string profile = path("long.yaml");
  write_text(profile, "like: primesense\ndepth_correction: {offset: -0.01}\n");
  ASSERT_EQ(run_tool(following("long", {"--sensor", profile})).status, 0);
  ASSERT_EQ(run_tool(following("as_it_is")).status, 0);
  EXPECT_NEAR(last_distance("as_it_is") - last_distance("long"), 0.01, 0.002);
}

TEST_F(SensorOption, RefusesWhatIsNoProfile) {
  const auto unknown = run_tool(following("none", {"--sensor", "xtion"}));
  EXPECT_EQ(unknown.status, 3);
  EXPECT_THAT(unknown.errors, AllOf(HasSubstr("xtion"), HasSubstr("azure-kinect")));
  write_text(path("wrong.yaml"), "noise:\n  own_share: 2\n");
  const auto wrong = run_tool(following("none", {"--sensor", path("wrong.yaml")}));
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.errors, HasSubstr(path("wrong.yaml") + ":2: 'own_share'"));
  write_text(path("lacking.yaml"), "noise: {own_share: 1}\n");
  const auto lacking = simulate(start_, "lacking.oni", {"--sensor", path("lacking.yaml")});
  EXPECT_EQ(lacking.status, 3);
  EXPECT_THAT(lacking.errors, HasSubstr("how to simulate"));
}

}  // namespace
}  // namespace lockbox
