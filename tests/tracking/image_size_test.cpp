// SPDX-License-Identifier: BSD-3-Clause
// Images of any size are searched and tracked: buffers are cut from images into tiles, cells and
// coarse views, which small and odd ones do not fill.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

struct ImageSize {
  int width;
  int height;
};

/// The same view in other pixels, as narrow as the image is.
DepthFrame frame_of(const Configuration& configuration, const ImageSize& size, double stamp) {
  const double focal = 0.9 * std::max(size.width, size.height);
  const PinholeCamera camera{
      size.width, size.height, focal, focal, 0.5 * (size.width - 1), 0.5 * (size.height - 1)};
  State state;
  state.stamp = stamp;
  state.configuration = configuration;
  Scene scene;
  scene.planes.push_back({SceneFrame::world, {0.0, 0.0, 1.3}, {0.0, 0.0, -1.0}, {5.0, 5.0}});
  Simulator simulator(mechanism().tree, camera, PlacedScene(scene, {state}),
                      sensor_model("primesense"), 1, Executor(1));
  DepthFrame frame;
  simulator.simulate(state, 0, frame);
  return frame;
}

class ImageSizeTest : public ::testing::TestWithParam<ImageSize> {
 protected:
  static TrackerOptions options() {
    TrackerOptions options;
    options.threads = 1;
    return options;
  }

  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
};

TEST_P(ImageSizeTest, IsFollowed) {
  TrackerOptions nearby = options();
  nearby.search_anywhere = false;
  Tracker tracker(model, nearby);
  tracker.start(truth);
  for (const double stamp : {0.0, 0.033, 0.067}) {
    const DepthFrame frame = frame_of(truth, GetParam(), stamp);
    EXPECT_NO_THROW(tracker.process(frame));
  }
}

/// Of larger images a search takes seconds.
class SmallImageTest : public ImageSizeTest {};

TEST_P(SmallImageTest, IsSearched) {
  Tracker tracker(model, options());
  EXPECT_EQ(tracker.process(frame_of(truth, GetParam(), 0.0)).searches, 1);
}

std::string name_of(const ::testing::TestParamInfo<ImageSize>& size) {
  return std::to_string(size.param.width) + "x" + std::to_string(size.param.height);
}

const auto kSmall = ::testing::Values(ImageSize{1, 1}, ImageSize{17, 13}, ImageSize{31, 29},
                                      ImageSize{639, 5}, ImageSize{3, 480});

INSTANTIATE_TEST_SUITE_P(Odd, SmallImageTest, kSmall, name_of);
INSTANTIATE_TEST_SUITE_P(Odd, ImageSizeTest, kSmall, name_of);
INSTANTIATE_TEST_SUITE_P(Larger, ImageSizeTest,
                         ::testing::Values(ImageSize{161, 121}, ImageSize{512, 424}), name_of);

}  // namespace
}  // namespace lockbox
