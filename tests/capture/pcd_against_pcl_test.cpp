// SPDX-License-Identifier: BSD-3-Clause
// What this reader and PCL's make of the same sound files.
#include <gmock/gmock.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>

#include "lockbox/core/error.hpp"
#include "pcd_reader.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

struct Field {
  std::string name;
  char type = 'F';
  std::size_t size = 4;
  std::size_t count = 1;
};

enum class Data { text, binary, compressed };

/// A sound .pcd file, drawn at random: fields, their order, types and counts, values, line ends.
class RandomPcd {
 public:
  RandomPcd(std::mt19937& random, Data data, bool is_organized) : random_(random), data_(data) {
    width_ = 2 + below(9);
    height_ = is_organized ? 2 + below(9) : 1;
    draw_fields();
    for (std::size_t i = 0; i < width_ * height_; ++i) draw_point();
  }

  std::string content() {
    const std::string end = data_ == Data::text && below(2) == 0 ? "\r\n" : "\n";
    return header(end) + (data_ == Data::text     ? text(end)
                          : data_ == Data::binary ? bytes_by_point()
                                                  : compressed(bytes_by_field()));
  }

 private:
  /// One value: as text, and as bytes.
  struct Value {
    std::string text;
    std::string bytes;
  };

  std::size_t below(std::size_t end) { return random_() % end; }

  void draw_fields() {
    const std::size_t coordinate_size = below(4) == 0 ? 8 : 4;
    for (const char* const name : {"x", "y", "z"}) fields_.push_back({name, 'F', coordinate_size});
    const std::vector<Field> more = {{"rgb"},
                                     {"rgba", 'U'},
                                     {"intensity"},
                                     {"label", 'U', 2},
                                     {"ring", 'I', 1},
                                     {"normal", 'F', 4, 3},
                                     {"histogram", 'F', 4, 1 + below(40)},
                                     {"stamp", 'F', 8},
                                     {"X"},
                                     {"xy", 'I', 4}};
    for (const Field& field : more) {
      if (below(3) == 0) fields_.push_back(field);
    }
    std::shuffle(fields_.begin(), fields_.end(), random_);
  }

  template <typename T>
  Value value(T number) const {
    std::ostringstream text;
    text << std::setprecision(std::numeric_limits<T>::max_digits10) << +number;
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &number, sizeof(T));
    return {text.str(), bytes};
  }

  template <typename T>
  Value real() {
    if (below(8) == 0) return value(std::numeric_limits<T>::quiet_NaN());
    return value(std::uniform_real_distribution<T>(-5, 5)(random_) *
                 (below(8) == 0 ? T(1e-6) : T(1)));
  }

  Value draw_value(const Field& field) {
    if (field.type == 'F') return field.size == 8 ? real<double>() : real<float>();
    if (field.size == 1) return value(static_cast<std::int8_t>(below(256)));
    if (field.size == 2) return value(static_cast<std::uint16_t>(random_()));
    if (field.type == 'U') return value(static_cast<std::uint32_t>(random_()));
    return value(static_cast<std::int32_t>(random_()));
  }

  void draw_point() {
    std::vector<std::vector<Value>> point;
    for (const Field& field : fields_) {
      point.emplace_back();
      for (std::size_t i = 0; i < field.count; ++i) point.back().push_back(draw_value(field));
    }
    points_.push_back(point);
  }

  template <typename Property>
  std::string line(const std::string& key, Property property, const std::string& end) const {
    std::ostringstream out;
    out << key;
    for (const Field& field : fields_) out << ' ' << property(field);
    return out.str() + end;
  }

  std::string header(const std::string& end) {
    const auto number = [](std::size_t n) { return std::to_string(n); };
    const bool all_are_single =
        std::all_of(fields_.begin(), fields_.end(), [](const auto& f) { return f.count == 1; });
    const char* const kinds[] = {"ascii", "binary", "binary_compressed"};
    return (below(2) == 0 ? "# .PCD v.7 - Point Cloud Data file format" + end : "") + "VERSION " +
           (below(2) == 0 ? "0.7" : ".7") + end +
           line(
               "FIELDS", [](const Field& f) { return f.name; }, end) +
           line(
               "SIZE", [](const Field& f) { return f.size; }, end) +
           line(
               "TYPE", [](const Field& f) { return f.type; }, end) +
           (all_are_single && below(2) == 0
                ? ""
                : line(
                      "COUNT", [](const Field& f) { return f.count; }, end)) +
           "WIDTH " + number(width_) + end + "HEIGHT " + number(height_) + end +
           (below(2) == 0 ? "VIEWPOINT 0 0 0 1 0 0 0" + end : "") + "POINTS " +
           number(width_ * height_) + end + "DATA " + kinds[static_cast<int>(data_)] + end;
  }

  std::string text(const std::string& end) {
    std::string all;
    for (const auto& point : points_) {
      std::string row;
      for (const auto& field : point) {
        for (const Value& value : field) row += (row.empty() ? "" : " ") + value.text;
      }
      all += row + end;
    }
    return all;
  }

  std::string bytes_by_point() const {
    std::string all;
    for (const auto& point : points_) {
      for (const auto& field : point) {
        for (const Value& value : field) all += value.bytes;
      }
    }
    return all;
  }

  std::string bytes_by_field() const {
    std::string all;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      for (const auto& point : points_) {
        for (const Value& value : point[i]) all += value.bytes;
      }
    }
    return all;
  }

  static std::string compressed(const std::string& bytes) {
    std::string packed(2 * bytes.size() + 64, '\0');
    const unsigned size = pcl::lzfCompress(bytes.data(), static_cast<unsigned>(bytes.size()),
                                           packed.data(), static_cast<unsigned>(packed.size()));
    EXPECT_GT(size, 0U);
    const std::uint32_t sizes[] = {size, static_cast<std::uint32_t>(bytes.size())};
    std::string head(sizeof(sizes), '\0');
    std::memcpy(head.data(), sizes, sizeof(sizes));
    return head + packed.substr(0, size);
  }

  std::mt19937& random_;
  Data data_;
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::vector<Field> fields_;
  std::vector<std::vector<std::vector<Value>>> points_;  // by point, field, value
};

/// As PCL has read it: a float, or a double.
float coordinate(const pcl::PCLPointCloud2& cloud, std::size_t point, const std::string& name) {
  for (const auto& field : cloud.fields) {
    if (field.name != name) continue;
    const std::uint8_t* const at = &cloud.data[point * cloud.point_step + field.offset];
    if (field.datatype == pcl::PCLPointField::FLOAT64) {
      double value = 0.0;
      std::memcpy(&value, at, sizeof(value));
      return static_cast<float>(value);
    }
    float value = 0.0F;
    std::memcpy(&value, at, sizeof(value));
    return value;
  }
  ADD_FAILURE() << "there is no field " << name;
  return 0.0F;
}

void expect_same(const OrganizedCloud& cloud, const pcl::PCLPointCloud2& expected) {
  ASSERT_EQ(cloud.width, static_cast<int>(expected.width));
  ASSERT_EQ(cloud.height, static_cast<int>(expected.height));
  const std::array<std::string, 3> names = {"x", "y", "z"};
  for (std::size_t i = 0; i < cloud.xyz.size(); ++i) {
    const float other = coordinate(expected, i / 3, names.at(i % 3));
    ASSERT_TRUE(cloud.xyz[i] == other || (std::isnan(cloud.xyz[i]) && std::isnan(other)))
        << names.at(i % 3) << " of point " << i / 3 << ": " << cloud.xyz[i] << ", not " << other;
  }
}

class PcdAgainstPcl : public ::testing::TestWithParam<Data> {
 protected:
  static constexpr int kRounds = 100;

  /// Both are given the same file.
  void write(const std::string& content) {
    write_text(file_, content);
    ASSERT_EQ(pcl::io::loadPCDFile(file_, expected_), 0) << content.substr(0, 400);
  }

  TemporaryFolder folder_;
  std::string file_ = folder_ / "a.pcd";
  pcl::PCLPointCloud2 expected_;
  std::mt19937 random_{20261128};
};

TEST_P(PcdAgainstPcl, SoundImagesAreReadAlike) {
  OrganizedCloud cloud;
  for (int round = 0; round < kRounds; ++round) {
    const std::string content = RandomPcd(random_, GetParam(), true).content();
    SCOPED_TRACE(content.substr(0, 400));
    ASSERT_NO_FATAL_FAILURE(write(content));
    load_pcd(file_, cloud);
    ASSERT_NO_FATAL_FAILURE(expect_same(cloud, expected_));
  }
}

TEST_P(PcdAgainstPcl, WhatPclReadsWithoutRowsIsRefusedAsNoImage) {
  OrganizedCloud cloud;
  for (int round = 0; round < kRounds / 10; ++round) {
    ASSERT_NO_FATAL_FAILURE(write(RandomPcd(random_, GetParam(), false).content()));
    EXPECT_THAT([&] { load_pcd(file_, cloud); },
                ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("not an organized")));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PcdAgainstPcl,
                         ::testing::Values(Data::text, Data::binary, Data::compressed),
                         [](const auto& tested) {
                           return std::string(tested.param == Data::text     ? "Text"
                                              : tested.param == Data::binary ? "Binary"
                                                                             : "Compressed");
                         });

}  // namespace
}  // namespace lockbox
