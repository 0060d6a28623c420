// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/captioned_picture.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "block_model.hpp"
#include "lockbox/visualization/estimate_caption.hpp"

namespace lockbox {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

const Eigen::Vector3f kRed(1.0F, 0.0F, 0.0F);

/// Rows, counted from 0, that hold a pixel like this one.
template <typename Predicate>
std::vector<int> rows_with(const RgbImage& image, Predicate&& is_wanted) {
  std::vector<int> rows;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const auto at = 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(u));
      if (!is_wanted(image.rgb[at], image.rgb[at + 1], image.rgb[at + 2])) continue;
      rows.push_back(v);
      break;
    }
  }
  return rows;
}

bool is_red(int r, int g, int b) {
  return r > 200 && g < 50 && b < 50;
}

bool is_letter(int r, int g, int b) {
  return r > 150 && g > 150 && b > 150;
}

TEST(CaptionedPicture, LeavesThePictureAndWritesBelowIt) {
  const RgbImage picture(320, 40, 90);
  const auto image = with_caption(picture, {{"HHHH", kRed}, {"HHHH", std::nullopt}}, {2, 4});
  EXPECT_EQ(image.width, 320);
  ASSERT_GT(image.height, 40 + 2 * 13);
  EXPECT_TRUE(std::equal(picture.rgb.begin(), picture.rgb.end(), image.rgb.begin()));
  const auto patch = rows_with(image, is_red);
  const auto letters = rows_with(image, is_letter);
  ASSERT_FALSE(patch.empty());
  ASSERT_FALSE(letters.empty());
  EXPECT_GE(patch.front(), 40);
  EXPECT_GE(letters.front(), 40);
  EXPECT_LT(patch.back(), 40 + 17) << "beside the first line";
  EXPECT_GT(letters.back(), 40 + 17) << "of the second line";
}

TEST(CaptionedPicture, IsOfOneSizeWhateverIsWritten) {
  const RgbImage picture(100, 40, 90);
  const CaptionRoom room = room_for({{"a line that is wider than the picture", kRed}, {"", kRed}});
  EXPECT_EQ(room.lines, 2U);
  const auto full = with_caption(picture, {{std::string(500, 'x'), kRed}, {"y", kRed}}, room);
  const auto empty = with_caption(picture, {}, room);
  EXPECT_GT(full.width, 100);
  EXPECT_EQ(full.width, empty.width);
  EXPECT_EQ(full.height, empty.height);
  EXPECT_THAT(rows_with(empty, is_letter), SizeIs(0));
}

TEST(CaptionedPicture, WritesLargerBelowWiderPictures) {
  const auto rows = [](int width) {
    return rows_with(with_caption(RgbImage(width, 10, 0), {{"HHHH", std::nullopt}}, {1, 4}),
                     is_letter)
        .size();
  };
  EXPECT_EQ(rows(320), rows(640));
  EXPECT_GT(rows(1920), rows(640));
}

TEST(EstimateCaption, SaysWhatIsKnown) {
  const auto tree = block_tree({0.2, 0.2, 0.1}, {1.0F, 0.0F, 0.0F, 1.0F});
  ShownEstimate estimate(one_metre_away());
  estimate.belief = "belief 97 %";
  const auto texts = [&] {
    std::vector<std::string> lines;
    for (const auto& line : estimate_caption(tree, estimate, "frame 3", {kRed})) {
      lines.push_back(line.text);
    }
    return lines;
  };
  EXPECT_THAT(texts(), ElementsAre("frame 3", "belief 97 %", HasSubstr(" at 0.000 0.000 1.000 m")));
  EXPECT_EQ(estimate_caption(tree, estimate, "", {kRed}).back().color, kRed);
  estimate.configuration = unknown_configuration(tree);
  EXPECT_THAT(texts(), ElementsAre("frame 3", "belief 97 %"));
}

}  // namespace
}  // namespace lockbox
