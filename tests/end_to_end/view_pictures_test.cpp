// SPDX-License-Identifier: BSD-3-Clause
// Pictures and videos of the 3D viewer, on a real (virtual) X display.
#include <png.h>

#include <cstdio>

#include "viewed_run.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

/// Colours of a picture, three bytes a pixel.
std::vector<std::uint8_t> read_png(const std::string& file) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, file.c_str()) == 0) return {};
  header.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(header));
  png_image_finish_read(&header, nullptr, rgb.data(), 0, nullptr);
  return rgb;
}

/// Share of pixels of which the predicate holds.
template <typename Predicate>
double share_of(const std::vector<std::uint8_t>& rgb, Predicate&& predicate) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    count += predicate(int{rgb[i]}, int{rgb[i + 1]}, int{rgb[i + 2]}) ? 1 : 0;
  }
  return 3.0 * static_cast<double>(count) / static_cast<double>(rgb.size());
}

TEST_F(View, DrawsTheModelInItsColorsIntoAPicture) {
  const auto file = path("model.png");
  const auto result =
      run_tool({"view", "--model", "rigid_block", "--screenshot", file, "--size", "320x240"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto picture = read_png(file);
  ASSERT_THAT(picture, SizeIs(3 * 320 * 240));
  // The block's material is a warm colour; the background is bluish.
  const double block = share_of(picture, [](int r, int, int b) { return r > b + 30; });
  EXPECT_GT(block, 0.05);
  EXPECT_LT(block, 0.9);
}

TEST_F(View, DrawsTheErrorsOfAFrame) {
  ASSERT_EQ(run_tool(viewing({"--frame", "7", "--screenshot", path("plain.png")})).status, 0);
  ASSERT_EQ(
      run_tool(viewing({"--frame", "7", "--color", "errors", "--screenshot", path("errors.png")}))
          .status,
      0);
  const auto is_blue = [](int r, int, int b) { return b > 150 && b > r + 40; };
  const auto is_red = [](int r, int g, int b) { return r > 150 && r > g + 40 && r > b + 40; };
  const auto plain = read_png(path("plain.png"));
  const auto errors = read_png(path("errors.png"));
  EXPECT_LT(share_of(plain, is_blue), 1e-3);
  EXPECT_GT(share_of(errors, is_blue), 5e-3);
  EXPECT_GT(share_of(errors, is_red), 5e-3);
}

TEST_F(View, DrawsTheAlternativesOfARun) {
  std::filesystem::create_directory(path("doubted"));
  write_text(path("doubted/states.csv"),
             "timestamp,tx,ty,tz,qx,qy,qz,qw,status\n0,0,0,1,0,0,0,1,uncertain\n");
  const std::vector<std::string> view = {
      "view",         "--model",           "rigid_block", "--states", path("doubted/states.csv"),
      "--screenshot", path("doubted.png"), "--overwrite"};
  ASSERT_EQ(run_tool(view).status, 0);
  const auto is_orange = [](int r, int g, int b) { return r > g + 25 && g > b + 5; };
  const double alone = share_of(read_png(path("doubted.png")), is_orange);
  write_text(path("doubted/alternatives.csv"),
             "timestamp,tx,ty,tz,qx,qy,qz,qw,kind,probability\n"
             "0,0.25,0,1,0,0,0,1,elsewhere,0.2\n");
  const auto result = run_tool(view);
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_GT(share_of(read_png(path("doubted.png")), is_orange), alone + 0.01);
  write_text(path("doubted/alternatives.csv"), "timestamp,tx,ty,tz,qx,qy,qz,qw\n");
  const auto refused = run_tool(view);
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.errors, HasSubstr("alternatives.csv:1: the columns 'kind'"));
}

/// Share of the pixels in these columns of pictures, 640 pixels wide, that differ.
double share_changed(const std::vector<std::uint8_t>& one, const std::vector<std::uint8_t>& other,
                     std::size_t first, std::size_t last) {
  std::size_t pixels = 0;
  std::size_t changed = 0;
  for (std::size_t i = 0; i + 2 < one.size(); i += 3) {
    const std::size_t column = i / 3 % 640;
    if (column < first || column >= last) continue;
    ++pixels;
    const auto at = static_cast<std::ptrdiff_t>(i);
    changed += std::equal(one.begin() + at, one.begin() + at + 3, other.begin() + at) ? 0 : 1;
  }
  return static_cast<double>(changed) / static_cast<double>(pixels);
}

TEST_F(View, ColoursSayWhatIsAsked) {
  const auto drawn = [](const std::string& color) {
    EXPECT_EQ(run_tool(viewing({"--frame", "7", "--color", color, "--size", "640x480",
                                "--screenshot", path(color + ".png")}))
                  .status,
              0);
    return read_png(path(color + ".png"));
  };
  // The colour of the first body, that of points on the surface, and any of the scale.
  const auto is_orange = [](int r, int g, int b) { return r > 200 && g > 130 && b < 40; };
  const auto is_green = [](int r, int g, int b) { return r < 90 && g > 130 && b < 140; };
  EXPECT_GT(share_of(drawn("bodies"), is_orange), 0.02);
  EXPECT_GT(share_of(drawn("terms"), is_green), 0.02);
  const auto uncertain = drawn("uncertainty");
  EXPECT_LT(share_of(uncertain, is_orange), 0.01);
  EXPECT_NE(uncertain, drawn("plain"));
  EXPECT_EQ(run_tool(viewing({"--color", "rainbow"})).status, 2);
}

TEST_F(View, ShowsTwoRunsSideBySide) {
  const std::string aside = path("aside.csv");
  write_text(aside,
             "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0.1,0.1,1.2,1,0,0,0\n");  // one for all frames
  const auto drawn = [&](const std::string& beside) {
    EXPECT_EQ(run_tool(viewing({"--frame", "7", "--beside", beside, "--size", "640x480",
                                "--screenshot", path("beside.png")}))
                  .status,
              0);
    return read_png(path("beside.png"));
  };
  const auto same = drawn(path("run/states.csv"));
  const auto different = drawn(aside);
  ASSERT_THAT(same, SizeIs(3 * 640 * 480));
  // How deep both reach together moves a few points before others.
  EXPECT_LT(share_changed(same, different, 0, 320), 0.01) << "the run";
  EXPECT_GT(share_changed(same, different, 320, 640), 0.02) << "the other";
}

TEST_F(View, DrawsASeriesOfPictures) {
  const auto drawing =
      viewing({"--frame", "27", "--pictures", path("series"), "--size", "320x240"});
  ASSERT_EQ(run_tool(drawing).status, 0);
  const auto name = [](int frame) {
    return path("series/frame_0000" + std::to_string(frame) + ".png");
  };
  for (const int frame : {27, 28, 29}) EXPECT_THAT(read_png(name(frame)), SizeIs(3 * 320 * 240));
  EXPECT_FALSE(std::filesystem::exists(name(26)));
  const auto again = run_tool(drawing);
  EXPECT_EQ(again.status, 3);
  EXPECT_THAT(again.errors, HasSubstr("--overwrite"));
}

TEST_F(View, MakesAVideoThatLastsAsLongAsTheRecording) {
  const auto video = path("run.mp4");
  const auto drawing = viewing({"--video", video, "--size", "321x241"});  // odd, on purpose
  if (std::system("command -v ffprobe >/dev/null") != 0) GTEST_SKIP() << "there is no ffmpeg";
  const auto result = run_tool(drawing);
  ASSERT_EQ(result.status, 0) << result.errors;
  FILE* const probe =
      popen(("ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames "
             "-of csv=p=0 " +
             video)
                .c_str(),
            "r");
  int width = 0;
  int height = 0;
  int frames = 0;
  EXPECT_EQ(fscanf(probe, "%d,%d,%d", &width, &height, &frames), 3);
  pclose(probe);
  EXPECT_EQ(width, 322);
  EXPECT_EQ(height, 242);
  EXPECT_NEAR(frames, static_cast<int>(kFrames), 1);
}

TEST_F(View, SaysWhereVideosComeFromIfThereIsNoFfmpeg) {
  const auto result =
      run_tool(viewing({"--video", path("none.mp4"), "--size", "320x240"}), {"PATH=/nowhere"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("apt-get install ffmpeg"));
  EXPECT_THAT(result.errors, HasSubstr("--pictures DIR"));
}

TEST_F(View, RefusesFramesThatAreNotThere) {
  const auto result = run_tool(viewing({"--frame", "30", "--screenshot", path("beyond.png")}));
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("30 frames"));
}

}  // namespace
}  // namespace lockbox
