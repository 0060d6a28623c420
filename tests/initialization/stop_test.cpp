// SPDX-License-Identifier: BSD-3-Clause
// A search that is asked to stop, at any of its stages.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "lockbox/initialization/initializer.hpp"
#include "registration/mechanism.hpp"
#include "seen_model.hpp"

namespace lockbox {
namespace {

constexpr int kNever = std::numeric_limits<int>::max();

/// Stops after it was asked so often.
class Stopper {
 public:
  StopRequest request() {
    return [this] { return asked_++ >= most_; };
  }
  void stop_after(int most) {
    asked_ = 0;
    most_ = most;
  }
  int asked() const { return asked_; }

 private:
  int most_ = kNever;
  std::atomic<int> asked_{0};
};

class StopTest : public ::testing::Test {
 protected:
  Initializer initializer(const ArticulatedModel& model) {
    InitializerOptions options;
    options.stop_request = stopper.request();
    return {model, options, Executor(1)};
  }

  Stopper stopper;
};

TEST_F(StopTest, EndsASearchAtAnyOfItsStages) {
  const ArticulatedModel& model = bracket();
  const Configuration truth = mechanism_start(model);
  const TiledCloud cloud = cloud_of(measured(model, truth, "primesense", 1));
  Initializer searching = initializer(model);
  for (const int most : {0, 10, 100}) {
    stopper.stop_after(most);
    EXPECT_THROW(searching.find(cloud), Stopped) << most;
  }
  stopper.stop_after(kNever);
  const auto found = searching.find(cloud);
  EXPECT_GT(stopper.asked(), 150) << "the last one was not stopped in the midst";
  ASSERT_FALSE(found.empty());
  const Eigen::Vector3d place = found.front().configuration.T_camera_base.translation();
  EXPECT_LT((place - truth.T_camera_base.translation()).norm(), 0.005);
}

TEST_F(StopTest, EndsASearchForJoints) {
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const TiledCloud cloud = cloud_of(measured(model, truth, "primesense", 1));
  Initializer searching = initializer(model);
  stopper.stop_after(5);
  EXPECT_THROW(searching.find_joints(cloud, truth, {0, 1, 2}), Stopped);
}

}  // namespace
}  // namespace lockbox
