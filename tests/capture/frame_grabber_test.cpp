// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/frame_grabber.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <future>

#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;

void write_folder(const std::filesystem::path& folder, std::uint64_t count) {
  DepthFolderWriter writer(folder);
  for (std::uint64_t number = 0; number < count; ++number) {
    writer.write(synthetic_frame(number));
  }
}

/// Waits for the end that the grabber signals.
class End {
 public:
  explicit End(FrameGrabber& grabber) {
    grabber.registerCallback<FrameGrabber::EndCallback>(
        [this](const std::string& error) { promise_.set_value(error); });
  }
  std::string wait() { return promise_.get_future().get(); }

 private:
  std::promise<std::string> promise_;
};

TEST(FrameGrabber, SignalsEveryFrameOfARecordingAndItsEnd) {
  const TemporaryFolder folder;
  write_folder(folder / "depth", 6);
  FrameGrabber grabber((folder / "depth").string());
  std::vector<std::uint64_t> indices;
  grabber.registerCallback<FrameGrabber::FrameCallback>(
      [&indices](const std::shared_ptr<const DepthFrame>& frame) {
        indices.push_back(frame->index);
        std::this_thread::sleep_for(2ms);
      });
  End end(grabber);
  grabber.start();
  EXPECT_EQ(end.wait(), "");
  EXPECT_EQ(indices, (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_FALSE(grabber.isRunning());
  EXPECT_NEAR(grabber.getFramesPerSecond(), 30.0, 0.1);
  EXPECT_EQ(grabber.getName(), "lockbox::FrameGrabber");
}

TEST(FrameGrabber, CloudsAreOrganizedAndInTheOpticalFrame) {
  const TemporaryFolder folder;
  write_folder(folder / "depth", 1);
  FrameGrabber grabber((folder / "depth").string());
  pcl::PointCloud<pcl::PointXYZ>::ConstPtr cloud;
  grabber.registerCallback<FrameGrabber::CloudCallback>(
      [&cloud](const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& received) { cloud = received; });
  End end(grabber);
  grabber.start();
  EXPECT_EQ(end.wait(), "");
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->width, 160U);
  ASSERT_EQ(cloud->height, 120U);
  const DepthFrame frame = synthetic_frame(0);
  for (int v = 0; v < 120; v += 7) {
    for (int u = 0; u < 160; u += 7) {
      const pcl::PointXYZ& point = cloud->at(u, v);
      const double z = frame.metres(u, v);
      if (z == 0.0) {
        EXPECT_TRUE(std::isnan(point.x) && std::isnan(point.y) && std::isnan(point.z));
      } else {
        EXPECT_LT(
            (point.getVector3fMap().cast<double>() - frame.camera.back_project(u, v, z)).norm(),
            1e-6);
      }
    }
  }
}

/// A camera that is unplugged after two frames.
class FailingSource : public FrameSource {
 public:
  bool next(DepthFrame& frame) override {
    if (number_ == 2) {
      throw DeviceError("the camera was unplugged");
    }
    frame = synthetic_frame(number_++);
    return true;
  }
  std::optional<std::size_t> frame_count() const override { return std::nullopt; }
  std::string description() const override { return "a failing camera"; }

 private:
  std::uint64_t number_ = 0;
};

TEST(FrameGrabber, AFailureInTheMiddleReachesTheEndCallback) {
  FrameGrabber grabber([] { return std::make_unique<FailingSource>(); });
  End end(grabber);
  grabber.start();
  EXPECT_EQ(end.wait(), "the camera was unplugged");
}

TEST(FrameGrabber, WrongSourcesThrowAtConstruction) {
  EXPECT_THROW(FrameGrabber("/nonexistent.oni"), InputError);
}

TEST(FrameGrabber, StartsFromTheBeginningAgain) {
  const TemporaryFolder folder;
  write_folder(folder / "depth", 2);
  FrameGrabber grabber((folder / "depth").string());
  std::atomic<int> frames{0};
  std::atomic<int> ends{0};
  grabber.registerCallback<FrameGrabber::FrameCallback>(
      [&frames](const std::shared_ptr<const DepthFrame>&) { ++frames; });
  grabber.registerCallback<FrameGrabber::EndCallback>([&ends](const std::string&) { ++ends; });
  for (int round = 1; round <= 3; ++round) {
    grabber.start();
    while (ends < round) {
      std::this_thread::sleep_for(1ms);
    }
  }
  EXPECT_EQ(frames, 6);
}

/// Where its own thread has ended, the system gives the next one the same id.
TEST(FrameGrabber, IsStartedByAThreadThatCameAfterItsOwn) {
  const TemporaryFolder folder;
  write_folder(folder / "depth", 2);
  FrameGrabber grabber((folder / "depth").string());
  std::atomic<int> frames{0};
  grabber.registerCallback<FrameGrabber::FrameCallback>(
      [&frames](const std::shared_ptr<const DepthFrame>&) { ++frames; });
  std::atomic<int> ends{0};
  grabber.registerCallback<FrameGrabber::EndCallback>([&ends](const std::string&) { ++ends; });
  const auto play = [&grabber, &ends](int rounds) {
    grabber.start();
    const auto patience = std::chrono::steady_clock::now() + 10s;
    while (ends < rounds && std::chrono::steady_clock::now() < patience) {
      std::this_thread::sleep_for(1ms);
    }
  };
  play(1);
  grabber.stop();
  std::thread(play, 2).join();
  EXPECT_EQ(frames, 4);
}

TEST(FrameGrabber, ACallbackMayStopIt) {
  const TemporaryFolder folder;
  write_folder(folder / "depth", 5);
  FrameGrabber grabber((folder / "depth").string());
  std::atomic<int> frames{0};
  grabber.registerCallback<FrameGrabber::FrameCallback>(
      [&](const std::shared_ptr<const DepthFrame>&) {
        ++frames;
        grabber.stop();
      });
  grabber.start();
  while (grabber.isRunning()) {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(frames, 1);
}

// The phases in which pcl::io::OpenNI2Grabber crashes: stopping near the arrival of a frame.
TEST(FrameGrabber, StoppingAndDestroyingAtAnyMomentIsSafe) {
  constexpr int kCycles = 200;
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  for (std::uint64_t number = 0; number < 30; ++number) {
    writer.write(synthetic_frame(number));
  }
  writer.finish();
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    FrameGrabber grabber((folder / "a.oni").string());
    std::atomic<bool> stopped{false};
    std::atomic<bool> late{false};
    grabber.registerCallback<FrameGrabber::FrameCallback>(
        [&](const std::shared_ptr<const DepthFrame>&) { late = late || stopped; });
    grabber.start();
    std::this_thread::sleep_for(std::chrono::microseconds(37 * cycle));
    if (cycle % 2 == 0) {
      grabber.stop();
      stopped = true;
      EXPECT_FALSE(grabber.isRunning());
    }
    EXPECT_FALSE(late);
  }
}

}  // namespace
}  // namespace lockbox
