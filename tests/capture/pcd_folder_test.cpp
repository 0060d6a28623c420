// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/pcd_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr char kAsciiHeader[] =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

/// An organized cloud as text: a slanted plane, z = 1 + 0.001 u + offset.
void write_ascii(const std::filesystem::path& file, double offset, int width = 20,
                 int height = 15) {
  std::ofstream out(file);
  out << kAsciiHeader << "WIDTH " << width << "\nHEIGHT " << height
      << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << width * height << "\nDATA ascii\n";
  out.precision(9);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double z = 1.0 + 0.001 * u + offset;
      if (u == 3 && v == 4) {
        out << "nan nan nan\n";
      } else {
        out << (u - 9.0) / 25.0 * z << ' ' << (v - 7.5) / 26.0 * z << ' ' << z << '\n';
      }
    }
  }
}

TEST(PcdFolder, WrittenFramesComeBackExactly) {
  const TemporaryFolder folder;
  const PcdFolderWriter writer(folder.path());
  for (std::uint64_t number = 0; number < 3; ++number) {
    writer.write(synthetic_frame(number));
  }
  PcdFolderSource source(folder.path());
  EXPECT_EQ(source.frame_count(), 3U);
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 3; ++number) {
    ASSERT_TRUE(source.next(frame));
    const DepthFrame expected = synthetic_frame(number);
    EXPECT_EQ(frame.depth, expected.depth);
    EXPECT_EQ(frame.metres_per_unit, 0.001F);
    EXPECT_NEAR(frame.stamp, expected.stamp, 1e-6);
    EXPECT_NEAR(frame.camera.fx, expected.camera.fx, 1e-3);
    EXPECT_NEAR(frame.camera.fy, expected.camera.fy, 1e-3);
    EXPECT_NEAR(frame.camera.cx, expected.camera.cx, 1e-3);
    EXPECT_NEAR(frame.camera.cy, expected.camera.cy, 1e-3);
    EXPECT_EQ(frame.camera.width, expected.camera.width);
  }
  EXPECT_FALSE(source.next(frame));
}

TEST(PcdFolder, TextCloudsGiveTheirCameraAndHoles) {
  const TemporaryFolder folder;
  write_ascii(folder / "a.pcd", 0.0);
  DepthFrame frame;
  ASSERT_TRUE(PcdFolderSource(folder.path()).next(frame));
  EXPECT_NEAR(frame.camera.fx, 25.0, 1e-3);
  EXPECT_NEAR(frame.camera.fy, 26.0, 1e-3);
  EXPECT_NEAR(frame.camera.cx, 9.0, 1e-3);
  EXPECT_NEAR(frame.camera.cy, 7.5, 1e-3);
  EXPECT_EQ(frame.metres_per_unit, 0.001F);
  EXPECT_EQ(frame.depth[4 * 20 + 3], 0);
  EXPECT_EQ(frame.depth[4 * 20 + 5], 1005);
}

TEST(PcdFolder, FineDepthsAreRoundedToTheFinestUnitThatReaches) {
  const TemporaryFolder folder;
  DepthFrame frame;
  write_ascii(folder / "a.pcd", 0.00037);
  ASSERT_TRUE(PcdFolderSource(folder.path()).next(frame));
  EXPECT_EQ(frame.metres_per_unit, 0.0001F);
  EXPECT_EQ(frame.depth[5], 10054);
  write_ascii(folder / "a.pcd", 10.00037);
  ASSERT_TRUE(PcdFolderSource(folder.path()).next(frame));
  EXPECT_EQ(frame.metres_per_unit, 0.00025F);
  write_ascii(folder / "a.pcd", 30.00037);
  ASSERT_TRUE(PcdFolderSource(folder.path()).next(frame));
  EXPECT_EQ(frame.metres_per_unit, 0.001F);
}

TEST(PcdFolder, StampsComeFromTheNamesThatHoldThem) {
  const auto stamps = [](const std::vector<std::string>& names) {
    const TemporaryFolder folder;
    for (const std::string& name : names) {
      write_ascii(folder / (name + ".pcd"), 0.0);
    }
    PcdFolderSource source(folder.path());
    std::vector<double> result;
    DepthFrame frame;
    while (source.next(frame)) {
      result.push_back(frame.stamp);
    }
    return result;
  };
  using ::testing::DoubleNear;
  using ::testing::ElementsAre;
  EXPECT_THAT(
      stamps({"frame_20121214T142255.814212", "frame_20121214T142256.068683"}),
      ElementsAre(DoubleNear(1355494975.814212, 1e-6), DoubleNear(1355494976.068683, 1e-6)));
  EXPECT_THAT(stamps({"12.25", "12.5"}), ElementsAre(12.25, 12.5));
  EXPECT_THAT(
      stamps({"cloud_1305031102175304", "cloud_1305031103175304"}),
      ElementsAre(DoubleNear(1305031102.175304, 1e-6), DoubleNear(1305031103.175304, 1e-6)));
  EXPECT_THAT(stamps({"0001", "0002"}), ElementsAre(0.0, DoubleNear(1.0 / 30.0, 1e-12)));
  EXPECT_THAT(stamps({"0000000001", "0000000002"}),
              ElementsAre(0.0, DoubleNear(1.0 / 30.0, 1e-12)));
}

/// The depth of pixel 0 of each frame, in millimetres; 0 in frames without any depth.
std::vector<int> first_depths(PcdFolderSource& source) {
  std::vector<int> depths;
  for (DepthFrame frame; source.next(frame);) {
    depths.push_back(static_cast<int>(std::lround(1000.0 * double{frame.metres(0, 0)})));
  }
  return depths;
}

TEST(PcdFolder, NumbersInNamesCountAsNumbers) {
  const TemporaryFolder folder;
  const std::vector<std::string> order{"cloud_0",  "cloud_1",  "cloud_2",     "cloud_007",
                                       "cloud_10", "cloud_11", "cloud_11b_3", "cloud_11b_20"};
  std::vector<int> expected;
  for (std::size_t i = 0; i < order.size(); ++i) {
    write_ascii(folder / (order[i] + ".pcd"), 0.001 * static_cast<double>(i));
    expected.push_back(1000 + static_cast<int>(i));
  }
  write_ascii(folder / "._cloud_0.pcd", 5.0);  // as some systems put beside each file
  PcdFolderSource source(folder.path());
  EXPECT_EQ(first_depths(source), expected);
}

TEST(PcdFolder, StampsInNamesGiveTheOrder) {
  const TemporaryFolder folder;
  write_ascii(folder / "9.5.pcd", 0.0);
  write_ascii(folder / "10.25.pcd", 0.001);
  write_ascii(folder / "10.5.pcd", 0.002);
  PcdFolderSource source(folder.path());
  EXPECT_EQ(first_depths(source), (std::vector<int>{1000, 1001, 1002}));
}

TEST(PcdFolder, TheCameraComesFromTheFirstCloudThatTellsIt) {
  const TemporaryFolder folder;
  std::ofstream empty(folder / "0.pcd");
  empty << kAsciiHeader << "WIDTH 20\nHEIGHT 15\nPOINTS 300\nDATA ascii\n";
  for (int i = 0; i < 300; ++i) {
    empty << "nan nan nan\n";
  }
  empty.close();
  std::ofstream(folder / "1.pcd").close();
  write_ascii(folder / "2.pcd", 0.0);
  write_ascii(folder / "3.pcd", 0.0, 10, 10);
  write_ascii(folder / "4.pcd", 0.001);
  std::filesystem::resize_file(folder / "4.pcd", 2000);
  write_ascii(folder / "5.pcd", 0.002);
  SourceOptions options;
  std::vector<std::string> warnings;
  options.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  PcdFolderSource source(folder.path(), options);
  EXPECT_EQ(first_depths(source), (std::vector<int>{0, 0, 1000, 0, 0, 1002}));
  EXPECT_EQ(source.faults().unreadable, 3U);
  EXPECT_THAT(warnings,
              ::testing::ElementsAre(HasSubstr("1.pcd: is empty"), HasSubstr("3 of 6 frames")));
}

TEST(PcdFolder, CloudsThatAreNoImagesAreRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.pcd";
  const auto expect_refusal = [&](const std::string& text, const std::string& message) {
    std::ofstream(file) << text;
    EXPECT_THAT([&] { PcdFolderSource(folder.path()); },
                ThrowsMessage<InputError>(HasSubstr(message)))
        << text;
  };
  const std::string header(kAsciiHeader);
  expect_refusal("hello", "a.pcd: is not a .pcd file");
  expect_refusal(header + "WIDTH 300\nHEIGHT 1\nPOINTS 300\nDATA ascii\n",
                 "not an organized cloud");
  expect_refusal(header + "WIDTH 20\nHEIGHT 15\nPOINTS 7\nDATA ascii\n",
                 "do not describe an image");
  expect_refusal(header + "WIDTH 20\nHEIGHT 15\nPOINTS 300\nDATA binary\nabc", "truncated");
  expect_refusal(header + "WIDTH 20\nHEIGHT 15\nPOINTS 300\nDATA binary_compressed\nabcdefghijk",
                 "truncated");
  expect_refusal(header + "WIDTH 1e9\nHEIGHT 1e9\nPOINTS 300\nDATA binary\n", "do not describe");
  expect_refusal("FIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 20\nHEIGHT 15\nPOINTS 300\nDATA ascii\n",
                 "do not have coordinates");
}

TEST(PcdFolder, TransformedCloudsAreRefused) {
  const TemporaryFolder folder;
  std::ofstream out(folder / "a.pcd");
  out << kAsciiHeader << "WIDTH 20\nHEIGHT 15\nPOINTS 300\nDATA ascii\n";
  for (int i = 0; i < 300; ++i) {
    out << i % 7 << ' ' << i % 11 << ' ' << 1 + i % 13 << '\n';
  }
  out.close();
  EXPECT_THAT([&] { PcdFolderSource(folder.path()); },
              ThrowsMessage<InputError>(HasSubstr("rays of a pinhole camera")));
  SourceOptions options;
  options.camera = PinholeCamera{20, 15, 25, 25, 9.5, 7};
  DepthFrame frame;
  ASSERT_TRUE(PcdFolderSource(folder.path(), options).next(frame));
  EXPECT_EQ(frame.camera, *options.camera);
}

TEST(PcdFolder, FoldersWithCloudsAreNotOverwritten) {
  const TemporaryFolder folder;
  write_ascii(folder / "a.pcd", 0.0);
  EXPECT_THROW(PcdFolderWriter{folder.path()}, InputError);
}

TEST(PcdFolder, RealCloudsGiveThePlausibleCameraOfTheirSensor) {
  const char* const data = std::getenv("LOCKBOX_TEST_DATA");
  if (data == nullptr) {
    GTEST_SKIP() << "LOCKBOX_TEST_DATA is not set";
  }
  PcdFolderSource source(std::filesystem::path(data) / "organized_pcd");
  DepthFrame frame;
  std::size_t count = 0;
  while (source.next(frame)) {
    ++count;
  }
  EXPECT_EQ(count, 3U);
  EXPECT_EQ(frame.camera.width, 640);
  EXPECT_NEAR(frame.camera.fx, 525.0, 5.0);
  EXPECT_NEAR(frame.camera.cx, 319.5, 1.0);
  EXPECT_NEAR(frame.stamp - 1355494975.0, 1.332395, 1e-5);
}

}  // namespace
}  // namespace lockbox
