// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <optional>

#include "lockbox/core/error.hpp"
#include "mesh_readers.hpp"
#include "tokens.hpp"

namespace lockbox {
namespace {

std::string_view without_comment(std::string_view line) {
  return line.substr(0, line.find('#'));
}

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, std::string_view content)
      : soup_(file.string()), lines_(content) {}

  PolygonSoup read() {
    while (lines_.next()) {
      rest_ = without_comment(lines_.text());
      number_ = lines_.number();
      statement(next_word());
    }
    if (static_cast<std::size_t>(last_.index) > soup_.vertices().size()) {
      refuse_vertex(last_.index, last_.line);
    }
    return std::move(soup_);
  }

 private:
  /// What is not geometry, and what goes on from such a line, begins with no word known here.
  void statement(std::string_view keyword) {
    if (keyword == "v") {
      vertex();
    } else if (keyword == "f" || keyword == "fo") {
      face();
    } else if (keyword == "surf") {
      throw InputError(soup_.file(), number_,
                       "free-form surfaces ('surf') are not read; export the part as polygons");
    }
  }

  /// The statement's next word, be it on the next line.
  std::string_view next_word() {
    while (true) {
      std::string_view word = take_word(rest_);
      std::string_view behind = rest_;
      if (!word.ends_with('\\') || !take_word(behind).empty()) {
        return word;
      }
      word.remove_suffix(1);
      rest_ = lines_.next() ? without_comment(lines_.text()) : std::string_view();
      if (!word.empty()) {
        return word;
      }
    }
  }

  /// A weight or a colour may follow the coordinates.
  void vertex() {
    Eigen::Vector3d position;
    for (double& coordinate : position) {
      const std::string_view word = next_word();
      if (word.empty()) {
        throw InputError(soup_.file(), number_, "expected three numbers after 'v'");
      }
      coordinate = finite_number(word, soup_.file(), number_);
    }
    soup_.add_vertex(position);
    while (!next_word().empty()) {
    }
  }

  void face() {
    for (auto word = next_word(); !word.empty(); word = next_word()) {
      soup_.add_corner(corner(word));
    }
    soup_.end_face();
  }

  /// Of vertex/texture/normal, only the vertex counts. Indices are from 1; negative ones count
  /// backwards from the last vertex so far.
  std::uint32_t corner(std::string_view word) {
    const std::string_view text = word.substr(0, word.find('/'));
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size()) {
      throw InputError(soup_.file(), number_, in_quotes(word) + " is not a corner of a face");
    }
    const auto count = static_cast<std::int64_t>(soup_.vertices().size());
    // A later vertex is as good as an earlier one; more than 2^32 no mesh has.
    if (index == 0 || index < -count || index > std::int64_t{UINT32_MAX}) {
      refuse_vertex(index, number_);
    }
    if (index > last_.index) last_ = {index, number_};
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
  }

  [[noreturn]] void refuse_vertex(std::int64_t index, int line) const {
    throw InputError(soup_.file(), line,
                     "the face refers to vertex " + std::to_string(index) + " of " +
                         std::to_string(soup_.vertices().size()));
  }

  struct Reference {
    std::int64_t index = 0;
    int line = 0;
  };

  PolygonSoup soup_;
  Lines lines_;
  std::string_view rest_;  ///< of the line
  int number_ = 0;         ///< of the statement's first line
  Reference last_;         ///< with the largest index
};

}  // namespace

PolygonSoup read_obj(const std::filesystem::path& file, std::string_view content) {
  return ObjReader(file, content).read();
}

}  // namespace lockbox
