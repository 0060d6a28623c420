// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::size_t write_frames(const std::filesystem::path& file, std::size_t count,
                         const PinholeCamera& camera = small_camera()) {
  std::size_t number = 0;
  return write_oni(file, camera, 30, [&](DepthFrame& frame) {
    if (number == count) {
      return false;
    }
    frame = synthetic_frame(number++, camera);
    return true;
  });
}

/// As long as it lives, files that are written grow no further than this, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

void replace_by_edge_cases(DepthFrame& frame) {
  frame.depth[0] = 65534;  // the greatest that is kept
  frame.depth[1] = 65535;  // comes back as "no measurement"
  std::fill(frame.depth.end() - 31, frame.depth.end(), std::uint16_t{1500});
  frame.depth.back() = 1501;  // the encoder would swap this with its neighbours
}

TEST(OniWriter, FramesComeBackBitForBit) {
  const TemporaryFolder folder;
  EXPECT_EQ(write_frames(folder / "a.oni", 20), 20U);
  OniPlayer player(folder / "a.oni");
  EXPECT_EQ(player.frame_count(), 20U);
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 20; ++number) {
    ASSERT_TRUE(player.next(frame));
    const DepthFrame expected = synthetic_frame(number);
    EXPECT_EQ(frame.depth, expected.depth) << number;
    EXPECT_EQ(frame.camera, expected.camera);
    EXPECT_EQ(frame.metres_per_unit, expected.metres_per_unit);
    EXPECT_EQ(frame.index, number);
    EXPECT_NEAR(frame.stamp, expected.stamp, 2e-6);
  }
  EXPECT_FALSE(player.next(frame));
  EXPECT_FALSE(player.next(frame));
}

TEST(OniWriter, FocalLengthsOfFourDecimalsComeBackExactly) {
  const TemporaryFolder folder;
  for (const double fx : {575.8157, 575.8, 525.0, 607.1785, 365.4568}) {
    const PinholeCamera camera{640, 480, fx, fx - 0.0123, 319.5, 239.5};
    const std::filesystem::path file = folder / "camera.oni";
    write_frames(file, 1, camera);
    DepthFrame frame;
    ASSERT_TRUE(OniPlayer(file).next(frame));
    EXPECT_EQ(frame.camera, camera) << frame.camera.fx << " " << frame.camera.fy;
  }
}

TEST(OniWriter, TenthsOfMillimetresKeepTheirUnit) {
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30, 0.0001F);
  DepthFrame frame = synthetic_frame(0);
  frame.metres_per_unit = 0.0001F;
  writer.write(frame);
  writer.finish();
  DepthFrame back;
  ASSERT_TRUE(OniPlayer(folder / "a.oni").next(back));
  EXPECT_EQ(back.depth, frame.depth);
  EXPECT_EQ(back.metres_per_unit, 0.0001F);
}

TEST(OniWriter, UnevenStampsKeepTheirIntervals) {
  const TemporaryFolder folder;
  const std::vector<double> stamps{12.5, 12.500001, 13.0, 400.25};
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  DepthFrame frame = synthetic_frame(0);
  for (const double stamp : stamps) {
    frame.stamp = stamp;
    writer.write(frame);
  }
  writer.finish();
  OniPlayer player(folder / "a.oni");
  for (const double stamp : stamps) {
    ASSERT_TRUE(player.next(frame));
    EXPECT_NEAR(frame.stamp, stamp - stamps.front(), 1e-6);
  }
}

TEST(OniWriter, WhatTheEncoderCannotHoldBecomesSomethingDefined) {
  const TemporaryFolder folder;
  DepthFrame frame = synthetic_frame(0);
  replace_by_edge_cases(frame);
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  writer.write(frame);
  writer.finish();
  DepthFrame back;
  ASSERT_TRUE(OniPlayer(folder / "a.oni").next(back));
  frame.depth[1] = 0;
  frame.depth.back() = 1500;
  EXPECT_EQ(back.depth, frame.depth);
}

TEST(OniWriter, TheFileEndsWithTheEndMark) {
  const TemporaryFolder folder;
  write_frames(folder / "a.oni", 3);
  EXPECT_EQ(std::filesystem::file_size(folder / "a.oni"), validate_oni(folder / "a.oni").end);
}

TEST(OniWriter, AnAbandonedRecordingIsStillComplete) {
  const TemporaryFolder folder;
  {
    OniWriter writer(folder / "a.oni", small_camera(), 30);
    for (std::uint64_t number = 0; number < 5; ++number) {
      writer.write(synthetic_frame(number));
    }
  }
  EXPECT_EQ(validate_oni(folder / "a.oni").frame_count, 5U);
}

TEST(OniWriter, AFullDiskEndsTheRecordingButDoesNotSpoilIt) {
  const TemporaryFolder folder;
  {
    const FileSizeLimit limit(3'000'000);
    EXPECT_THAT([&] { write_frames(folder / "a.oni", 1000); },
                ThrowsMessage<DeviceError>(HasSubstr("the disk is full")));
  }
  const std::size_t frames = *OniPlayer(folder / "a.oni").frame_count();
  EXPECT_GT(frames, 5U);
  EXPECT_LT(frames, 1000U);
}

TEST(OniWriter, ADiskThatIsFullFromTheStartIsSaid) {
  const TemporaryFolder folder;
  const FileSizeLimit limit(2000);
  EXPECT_THAT([&] { write_frames(folder / "a.oni", 1000); },
              ThrowsMessage<DeviceError>(HasSubstr("the disk is full")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(OniWriter, WhatHadTheNameIsReplacedOnlyByACompleteRecording) {
  const TemporaryFolder folder;
  write_text(folder / "a.oni", "precious");
  {
    OniWriter writer(folder / "a.oni", small_camera(), 30);
    EXPECT_EQ(read_text(folder / "a.oni"), "precious");
    EXPECT_THROW(writer.finish(), InputError);
  }
  EXPECT_EQ(read_text(folder / "a.oni"), "precious");
  write_frames(folder / "a.oni", 2);
  EXPECT_EQ(validate_oni(folder / "a.oni").frame_count, 2U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(OniWriter, WhatIsNotARegularFileIsLeftAlone) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.oni").c_str(), 0600), 0);
  EXPECT_THAT([&] { OniWriter(folder / "a.oni", small_camera(), 30); },
              ThrowsMessage<InputError>(HasSubstr("a.oni: is not a regular file")));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "a.oni"));
}

TEST(OniWriter, PathsLongerThanOpenNisLimitAndWithSpacesWork) {
  const TemporaryFolder folder;
  const std::filesystem::path deep =
      folder.path() / std::string(120, 'a') / std::string(120, 'b') / "with space \xc3\xa4";
  std::filesystem::create_directories(deep);
  write_frames(deep / "a.oni", 2);
  EXPECT_EQ(OniPlayer(deep / "a.oni").frame_count(), 2U);
}

TEST(OniWriter, CamerasThatOpenNiCannotDescribeAreRefused) {
  const TemporaryFolder folder;
  PinholeCamera camera = small_camera();
  camera.cx += 2.0;
  EXPECT_THAT([&] { OniWriter(folder / "a.oni", camera, 30); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("81.5"), HasSubstr("depth folder"))));
  EXPECT_THAT([&] { OniWriter(folder / "a.oni", small_camera(), 30, 0.0002F); },
              ThrowsMessage<InputError>(HasSubstr("1 mm and 0.1 mm")));
}

TEST(OniWriter, ACameraThatWasRecoveredFromRoundedNumbersIsHeld) {
  const TemporaryFolder folder;
  DepthFrame frame = synthetic_frame(0);
  frame.camera.cx += 2e-4;
  OniWriter writer(folder / "a.oni", frame.camera, 30);
  writer.write(frame);
  writer.finish();
  DepthFrame read;
  ASSERT_TRUE(OniPlayer(folder / "a.oni").next(read));
  EXPECT_EQ(read.depth, frame.depth);
}

TEST(OniWriter, FoldersThatDoNotExistAreNamed) {
  EXPECT_THAT([] { OniWriter("/nonexistent/a.oni", small_camera(), 30); },
              ThrowsMessage<InputError>(HasSubstr("/nonexistent/a.oni: cannot be written")));
}

TEST(OniWriter, StampsThatDoNotIncreaseAreRefused) {
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  writer.write(synthetic_frame(1));
  EXPECT_THROW(writer.write(synthetic_frame(1)), InputError);
}

TEST(OniWriter, ARecordingWithoutFramesIsRefusedAndLeavesNoFile) {
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  EXPECT_THROW(writer.finish(), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.oni"));
  EXPECT_THROW(write_frames(folder / "b.oni", 0), InputError);
}

TEST(OniWriter, ASecondWriterIntoOneFileIsRefusedAndDoesNoHarm) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.oni";
  {
    OniWriter first(file, small_camera(), 30);
    first.write(synthetic_frame(0));
    EXPECT_THAT([&] { OniWriter(file, small_camera(), 30); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr("a.oni: another run is recording"), HasSubstr("choose"))));
    first.write(synthetic_frame(1));
    first.finish();
    EXPECT_THROW(OniWriter(file, small_camera(), 30), InputError) << "it may still be compared";
  }
  EXPECT_EQ(validate_oni(file).frame_count, 2U);
  EXPECT_EQ(write_frames(file, 3), 3U);
}

TEST(OniWriter, WhatAnotherOneHasLeftUnfinishedIsWrittenAnew) {
  const TemporaryFolder folder;
  write_text(folder / "a.oni.part", "killed");
  EXPECT_EQ(write_frames(folder / "a.oni", 3), 3U);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.oni.part"));
}

}  // namespace
}  // namespace lockbox
