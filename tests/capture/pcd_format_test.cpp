// SPDX-License-Identifier: BSD-3-Clause
// What counts as a .pcd file, and what damaged ones do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <sstream>

#include "lockbox/capture/pcd_folder.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int kWidth = 16;
constexpr int kHeight = 12;
const PinholeCamera kCloudCamera{kWidth, kHeight, 20, 20, 7.5, 5.5};

/// A slanted plane in front of kCloudCamera, one value a coordinate.
template <typename Real>
std::vector<Real> plane(double scale = 1.0) {
  std::vector<Real> xyz;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double z = scale * (1.0 + 0.01 * u);
      xyz.push_back(static_cast<Real>((u - kCloudCamera.cx) / kCloudCamera.fx * z));
      xyz.push_back(static_cast<Real>((v - kCloudCamera.cy) / kCloudCamera.fy * z));
      xyz.push_back(static_cast<Real>(z));
    }
  }
  return xyz;
}

const std::string kFields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
const std::string kCloudSize = "WIDTH 16\nHEIGHT 12\nPOINTS 192\n";

/// before and after: further values of each point.
std::string text_data(const std::string& before = "", const std::string& after = "") {
  std::ostringstream out;
  const std::vector<double> xyz = plane<double>();
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    out << before << xyz[i] << ' ' << xyz[i + 1] << '\t' << xyz[i + 2] << after << '\n';
  }
  return out.str();
}

template <typename Real>
std::string binary_data(double scale = 1.0) {
  const std::vector<Real> xyz = plane<Real>(scale);
  std::string bytes(xyz.size() * sizeof(Real), '\0');
  std::memcpy(bytes.data(), xyz.data(), bytes.size());
  return bytes;
}

class PcdFormat : public ::testing::Test {
 protected:
  void write(const std::string& content) const {
    std::filesystem::remove(folder_ / "a.pcd");  // some file systems write replaced ones to disk
    write_text(folder_ / "a.pcd", content);
  }

  void expect_plane(const std::string& content) const {
    write(content);
    PcdFolderSource source(folder_.path());
    DepthFrame frame;
    ASSERT_TRUE(source.next(frame));
    EXPECT_NEAR(frame.camera.fx, kCloudCamera.fx, 1e-3);
    EXPECT_EQ(frame.depth[0], 1000);
    EXPECT_EQ(frame.depth[kWidth + 3], 1030);
    EXPECT_EQ(frame.depth.back(), 1150);
  }

  void expect_refusal(const std::string& content, const std::string& message) const {
    write(content);
    EXPECT_THAT([&] { PcdFolderSource(folder_.path()); },
                ThrowsMessage<InputError>(HasSubstr(message)))
        << content.substr(0, 200);
  }

  TemporaryFolder folder_;
};

TEST_F(PcdFormat, HeadersAreReadInTheDialectsThatThereAre) {
  expect_plane("# comment\n\nVERSION .7\n" + kFields + kCloudSize + "VIEWPOINT 0 0 0 1 0 0 0\n" +
               "DATA ascii\n" + text_data());
  expect_plane(
      "# .PCD v.5\r\nCOLUMNS x y z\r\nSIZE 4 4 4\r\nWIDTH\t16\r\nHEIGHT 12\r\nDATA ascii\r\n" +
      text_data());
  expect_plane(
      "version 0.7\nfields x y z\nsize 4 4 4\ntype f f f\nwidth 16\nheight 12\n"
      "points 192\ndata binary\n" +
      binary_data<float>());
  expect_plane("FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\n" + kCloudSize + "DATA binary\n" +
               binary_data<double>());
  expect_plane("FIELDS rgb x y z normal\nSIZE 4 4 4 4 4\nTYPE U F F F F\nCOUNT 1 1 1 1 3\n" +
               kCloudSize + "DATA ascii\n" + text_data("4294967295 ", " nan -1.#IND 0"));
}

TEST_F(PcdFormat, PointsThatWindowsCallsUndefinedAreHoles) {
  std::string data = text_data();
  data.replace(0, data.find('\n'), "1.#QNAN -1.#IND -nan(ind)");
  write(kFields + kCloudSize + "DATA ascii\n" + data.replace(data.find("-nan(ind)"), 9, "NaN"));
  DepthFrame frame;
  ASSERT_TRUE(PcdFolderSource(folder_.path()).next(frame));
  EXPECT_EQ(frame.depth[0], 0);
  EXPECT_EQ(frame.depth[1], 1010);
}

TEST_F(PcdFormat, HeadersThatSayTwoThingsAreRefused) {
  for (const char* const line : {"WIDTH 50000", "HEIGHT 30000", "POINTS 192", "DATA binary",
                                 "SIZE 8 8 8", "FIELDS x y z", "width 16"}) {
    std::string key = std::string(line).substr(0, std::string(line).find(' '));
    if (key == "width") key = "WIDTH";
    if (key == "DATA") continue;  // the first one ends the header
    expect_refusal(kFields + kCloudSize + line + "\nDATA ascii\n" + text_data(),
                   "more than one line " + key);
  }
  expect_refusal("FIELDS x y z x\nSIZE 4 4 4 4\nTYPE F F F F\n" + kCloudSize + "DATA ascii\n" +
                     text_data("", " 1"),
                 "coordinates");
}

TEST_F(PcdFormat, SizesAreCheckedBeforeMemoryIsTaken) {
  expect_refusal(kFields + "WIDTH 16384\nHEIGHT 16384\nDATA ascii\n", "do not describe an image");
  expect_refusal(kFields + "WIDTH 4096\nHEIGHT 4096\nDATA binary_compressed\n" +
                     std::string("\x04\0\0\0\0\0\0\x0c....", 12),
                 "truncated or damaged");
  expect_refusal(
      "FIELDS x y z a\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1000\nWIDTH 4096\n"
      "HEIGHT 4096\nDATA binary_compressed\n",
      "more than 1 GB");
  expect_refusal(
      "FIELDS x y z a\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1e9\n" + kCloudSize + "DATA ascii\n",
      "bytes each");
}

TEST_F(PcdFormat, TextThatIsNotAsLongAsTheHeaderSaysIsRefused) {
  const std::string head = kFields + kCloudSize + "DATA ascii\n";
  expect_refusal(head + text_data() + "1 2 3\n", "not as long");
  const std::string data = text_data();
  expect_refusal(head + data.substr(0, data.size() / 2), "not as long");
  expect_refusal(head + "x" + data, "is not a number");
}

TEST_F(PcdFormat, CloudsInMillimetresAreRecognised) {
  const std::string head = kFields + kCloudSize + "DATA binary\n";
  expect_refusal(head + binary_data<float>(1000.0), "--depth-scale 1000");
  SourceOptions options;
  options.depth_scale = 1000.0;
  DepthFrame frame;
  ASSERT_TRUE(PcdFolderSource(folder_.path(), options).next(frame));
  EXPECT_EQ(frame.depth[3], 1030);
  std::vector<std::string> warnings;
  options.depth_scale.reset();
  options.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  write(head + binary_data<float>(30.0));  // implausible, but in reach
  ASSERT_TRUE(PcdFolderSource(folder_.path(), options).next(frame));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("farther than")));
}

/// Damages a file as disks, editors and bad programs do.
std::string damaged(std::string content, std::mt19937& random) {
  static const std::vector<std::string> words{
      "WIDTH 99999\n", "COUNT 0 0 0\n", "-1",           "1e9",  "4294967295", "\n",
      "DATA binary\n", "DATA ascii\n",  "SIZE 1 2 4\n", "\xff", "x y z ",     "TYPE U I F\n",
      "POINTS 0\n"};
  const auto any = [&random](std::size_t count) {
    return random() % std::max<std::size_t>(count, 1);
  };
  for (std::size_t changes = 1 + any(3); changes > 0; --changes) {
    // Half of all changes hit the header.
    const std::size_t at =
        any(random() % 2 == 0 ? std::min<std::size_t>(content.size(), 160) : content.size());
    switch (any(4)) {
      case 0:
        content.resize(at);
        break;
      case 1:
        content.insert(at, words[any(words.size())]);
        break;
      case 2:
        content.erase(at, any(40));
        break;
      default:
        if (!content.empty()) content[at] = static_cast<char>(random());
    }
  }
  return content;
}

TEST_F(PcdFormat, DamagedFilesAreRefusedOrGiveAnImageOfTheirSize) {
  const PcdFolderWriter writer(folder_ / "compressed");
  writer.write(synthetic_frame(0, kCloudCamera));
  const std::vector<std::string> sound{
      kFields + kCloudSize + "DATA ascii\n" + text_data(),
      kFields + kCloudSize + "DATA binary\n" + binary_data<float>(),
      read_text(folder_ / "compressed" / "00000000000.000000.pcd")};
  ASSERT_FALSE(sound.back().empty());
  std::mt19937 random(20240817);
  SourceOptions options;
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    write(damaged(sound.at(static_cast<std::size_t>(round) % 3), random));
    options.camera = kCloudCamera;
    try {
      PcdFolderSource source(folder_.path(), options);
      DepthFrame frame;
      ASSERT_TRUE(source.next(frame));
      ASSERT_EQ(frame.depth.size(), static_cast<std::size_t>(kWidth * kHeight));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 1900);
}

}  // namespace
}  // namespace lockbox
