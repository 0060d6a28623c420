// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "lockbox/capture/camera_info.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/frame_grabber.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

void write_recording(const std::filesystem::path& file, std::uint64_t count) {
  OniWriter writer(file, small_camera(), 30);
  for (std::uint64_t number = 0; number < count; ++number) {
    writer.write(synthetic_frame(number));
  }
  writer.finish();
}

TEST(OpenSource, WrongSourcesSayWhatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THAT([] { open_source("/nonexistent/a.oni"); },
              ThrowsMessage<InputError>(HasSubstr("/nonexistent/a.oni: no such file or folder")));
  EXPECT_THAT([&] { open_source(folder.path().string()); },
              ThrowsMessage<InputError>(HasSubstr("neither a depth.txt")));
}

TEST(OpenSource, FilesOfOtherKindsAreNamedWithAdvice) {
  const TemporaryFolder folder;
  const std::vector<std::array<std::string, 3>> cases{
      {"a.bag", "#ROSBAG V2.0\n", "is a ROS 1 bag"},
      {"a.mcap", "\x89MCAP0\r\n", "is a ROS 2 bag"},
      {"a.db3", "SQLite format 3", "is a ROS 2 bag"},
      {"a.mkv", "\x1a\x45\xdf\xa3", "Azure Kinect"},
      {"a.pcd", "# .PCD v0.7\n", "give the folder"},
      {"a.ply", "ply\nformat ascii 1.0\n", "pcl_ply2pcd"},
      {"a.png", "\x89PNG\r\n", "depth.txt"},
      {"A.MP4", "ftyp", "is a video"},
      {"a.klg", "any", "Logger2"},
      {"a.urdf", "<robot/>", "--model"},
      {"depth.txt", "0 a.png\n", "give the folder that holds depth.txt"},
      {"renamed.oni", "#ROSBAG V2.0\n", "is a ROS 1 bag"},
  };
  for (const auto& [name, content, message] : cases) {
    write_text(folder / name, content);
    const std::string file = (folder / name).string();
    EXPECT_THAT([&] { open_source(file); }, ThrowsMessage<InputError>(HasSubstr(message))) << name;
  }
}

TEST(OpenSource, FoldersOfOtherKindsAreNamedWithAdvice) {
  const TemporaryFolder folder;
  const std::vector<std::array<std::string, 3>> cases{
      {"bag", "metadata.yaml", "ROS 2 bag"},
      {"images", "1.png", "list them in a depth.txt"},
      {"recordings", "a.oni", "give one of them"},
      {"clouds", "1.ply", "pcl_ply2pcd"},
      {"above/sequence", "depth.txt", "the folder sequence in it does"},
  };
  for (const auto& [path, file, message] : cases) {
    std::filesystem::create_directories(folder / path);
    write_text(folder / path / file, "");
    const std::string source = (folder / path.substr(0, path.find('/'))).string();
    EXPECT_THAT([&] { open_source(source); }, ThrowsMessage<InputError>(HasSubstr(message)))
        << path;
  }
}

TEST(OpenSource, StampsThatDoNotAdvanceAreAdvancedByAFrame) {
  const TemporaryFolder folder;
  {
    DepthFolderWriter writer(folder / "sequence");
    for (std::uint64_t number = 0; number < 6; ++number) {
      writer.write(synthetic_frame(number));
    }
  }
  write_text(folder / "sequence" / "depth.txt",
             "1.0 depth/000000.png\n1.0 depth/000001.png\n1.5 depth/000002.png\n"
             "0.25 depth/000003.png\n0.375 depth/000004.png\n9.0 depth/000005.png\n");
  std::vector<std::string> warnings;
  SourceOptions options;
  options.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  const auto source = open_source((folder / "sequence").string(), options);
  std::vector<double> stamps;
  for (DepthFrame frame; source->next(frame);) {
    EXPECT_EQ(frame.depth, synthetic_frame(stamps.size()).depth);
    stamps.push_back(frame.stamp);
  }
  EXPECT_THAT(stamps, ::testing::ElementsAre(1.0, ::testing::DoubleNear(1.0 + 1.0 / 30.0, 1e-9),
                                             1.5, 2.0, 2.125, 9.0));
  EXPECT_EQ(source->faults().restamped, 3U);
  EXPECT_THAT(warnings, ::testing::ElementsAre(
                            HasSubstr("000001.png: frame 1: its timestamp 1 is not later")));
}

TEST(OpenSource, TellsTheFileOfTheFrameThatWasDeliveredLast) {
  const TemporaryFolder folder;
  {
    DepthFolderWriter writer(folder / "sequence");
    for (std::uint64_t number = 0; number < 2; ++number) writer.write(synthetic_frame(number));
  }
  for (const bool realtime : {false, true}) {
    SourceOptions options;
    options.realtime = realtime;
    const auto source = open_source((folder / "sequence").string(), options);
    EXPECT_EQ(source->file_of_frame(), "");
    DepthFrame frame;
    for (const char* const image : {"depth/000000.png", "depth/000001.png"}) {
      ASSERT_TRUE(source->next(frame));
      EXPECT_EQ(source->file_of_frame(), (folder / "sequence" / image).string());
    }
  }
}

TEST(OpenSource, AFolderSaysItsUnitOnlyIfSomebodyHas) {
  const TemporaryFolder folder;
  const auto sequence = folder / "sequence";
  {
    DepthFolderWriter writer(sequence);
    writer.write(synthetic_frame(0));
  }
  EXPECT_TRUE(open_source(sequence.string())->is_unit_stated());
  SourceOptions options;
  options.camera = synthetic_frame(0).camera;
  EXPECT_FALSE(open_source(sequence.string(), options)->is_unit_stated());
  options.depth_scale = 5000.0;
  EXPECT_TRUE(open_source(sequence.string(), options)->is_unit_stated());
}

TEST(OpenSource, ADepthScaleIsNotUsedWhereTheStreamStatesItsUnit) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 1);
  std::vector<std::string> warnings;
  SourceOptions options;
  options.depth_scale = 5000.0;
  options.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  DepthFrame frame;
  ASSERT_TRUE(open_source((folder / "a.oni").string(), options)->next(frame));
  EXPECT_EQ(frame.metres_per_unit, synthetic_frame(0).metres_per_unit);
  EXPECT_THAT(warnings, ::testing::ElementsAre(HasSubstr("--depth-scale")));
}

TEST(OpenSource, TwoPlayersOfOneFileDoNotDisturbEachOther) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 4);
  const std::unique_ptr<FrameSource> one = open_source((folder / "a.oni").string());
  const std::unique_ptr<FrameSource> two = open_source((folder / "a.oni").string());
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 4; ++number) {
    ASSERT_TRUE(one->next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number).depth);
    ASSERT_TRUE(two->next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number).depth);
  }
}

TEST(OpenSource, AGivenCameraReplacesTheRecordings) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 1);
  SourceOptions options;
  options.camera = PinholeCamera{160, 120, 140.0, 141.0, 78.0, 61.0};
  DepthFrame frame;
  ASSERT_TRUE(open_source((folder / "a.oni").string(), options)->next(frame));
  EXPECT_EQ(frame.camera, *options.camera);
  EXPECT_EQ(frame.depth, synthetic_frame(0).depth);
  options.camera->width = 320;
  EXPECT_THROW(open_source((folder / "a.oni").string(), options), InputError);
}

TEST(OpenSource, RealTimeKeepsThePaceOfTheRecording) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 5);
  SourceOptions options;
  options.realtime = true;
  const std::unique_ptr<FrameSource> source = open_source((folder / "a.oni").string(), options);
  DepthFrame frame;
  EXPECT_TRUE(source->is_realtime());
  EXPECT_FALSE(open_source((folder / "a.oni").string())->is_realtime());
  const auto start = std::chrono::steady_clock::now();
  while (source->next(frame)) {
  }
  EXPECT_EQ(frame.index, 4U);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 130ms);
}

TEST(OpenSource, RealTimeDropsWhatASlowConsumerMisses) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 12);
  SourceOptions options;
  options.realtime = true;
  const std::unique_ptr<FrameSource> source = open_source((folder / "a.oni").string(), options);
  DepthFrame frame;
  ASSERT_TRUE(source->next(frame));
  std::this_thread::sleep_for(150ms);
  ASSERT_TRUE(source->next(frame));
  EXPECT_GE(frame.index, 4U);
  EXPECT_EQ(source->faults().dropped, frame.index - 1);
}

/// Two frames, an hour apart.
void write_recording_with_a_pause(const std::filesystem::path& folder) {
  DepthFolderWriter writer(folder);
  DepthFrame frame = synthetic_frame(0);
  writer.write(frame);
  frame.stamp = 3600.0;
  writer.write(frame);
}

TEST(OpenSource, RealTimeDoesNotWaitThroughAPauseWhenToldToStop) {
  const TemporaryFolder folder;
  write_recording_with_a_pause(folder / "depth");
  const auto start = std::chrono::steady_clock::now();
  SourceOptions options;
  options.realtime = true;
  options.stop = [start] { return std::chrono::steady_clock::now() - start > 150ms; };
  const std::unique_ptr<FrameSource> source = open_source((folder / "depth").string(), options);
  DepthFrame frame;
  ASSERT_TRUE(source->next(frame));
  EXPECT_FALSE(source->next(frame));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 2s);
}

TEST(OpenSource, AGrabberThatWaitsThroughAPauseStops) {
  const TemporaryFolder folder;
  write_recording_with_a_pause(folder / "depth");
  SourceOptions options;
  options.realtime = true;
  FrameGrabber grabber((folder / "depth").string(), options);
  std::promise<void> first;
  grabber.registerCallback<FrameGrabber::FrameCallback>(
      [&first](const std::shared_ptr<const DepthFrame>&) { first.set_value(); });
  std::atomic<bool> ended{false};
  grabber.registerCallback<FrameGrabber::EndCallback>(
      [&ended](const std::string&) { ended = true; });
  grabber.start();
  first.get_future().wait();
  const auto start = std::chrono::steady_clock::now();
  grabber.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
  EXPECT_FALSE(ended);  // not by itself
}

}  // namespace
}  // namespace lockbox
