// SPDX-License-Identifier: BSD-3-Clause
#include "png16.hpp"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <memory>

#include "image_limits.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"

namespace lockbox {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// libpng reports an error by longjmp, over which no C++ object may live. So every function that
// calls libpng holds only plain data, and the message travels in this struct.
struct PngError {
  std::array<char, 200> message{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* error = static_cast<PngError*>(png_get_error_ptr(png));
  std::snprintf(error->message.data(), error->message.size(), "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct Header {
  png_uint_32 width, height;
  int bit_depth, color_type;
};

class PngReader {
 public:
  explicit PngReader(std::FILE* file)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error_, on_error, on_warning)),
        info_(png_create_info_struct(png_)) {
    png_init_io(png_, file);
    png_set_user_limits(png_, kMaximumImageSize, kMaximumImageSize);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool read_header(Header* header) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_read_info(png_, info_);
    png_get_IHDR(png_, info_, &header->width, &header->height, &header->bit_depth,
                 &header->color_type, nullptr, nullptr, nullptr);
    return true;
  }

  bool read_rows(png_bytep* rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_set_swap(png_);  // PNG is big-endian
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  const char* error() const { return error_.message.data(); }

 private:
  PngError error_;
  png_structp png_;
  png_infop info_;
};

class PngWriter {
 public:
  explicit PngWriter(std::FILE* file)
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &error_, on_error, on_warning)),
        info_(png_create_info_struct(png_)) {
    png_init_io(png_, file);
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  bool write(png_uint_32 width, png_uint_32 height, png_bytep* rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_set_IHDR(png_, info_, width, height, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png_, 1);  // sequences are written while something else computes
    png_write_info(png_, info_);
    png_set_swap(png_);
    png_write_image(png_, rows);
    png_write_end(png_, nullptr);
    return true;
  }

 private:
  PngError error_;
  png_structp png_;
  png_infop info_;
};

std::vector<png_bytep> rows_of(std::uint16_t* pixels, std::size_t width, std::size_t height) {
  std::vector<png_bytep> rows(height);
  for (std::size_t v = 0; v < height; ++v) {
    rows[v] = reinterpret_cast<png_bytep>(pixels + v * width);
  }
  return rows;
}

}  // namespace

void read_png16(const std::filesystem::path& file, Image16& image) {
  const File stream(is_file(file) ? std::fopen(file.c_str(), "rb") : nullptr);
  if (!stream) {
    throw InputError(file.string(), "no such image, or it cannot be read");
  }
  PngReader reader(stream.get());
  Header header{};
  if (!reader.read_header(&header)) {
    throw InputError(file.string(),
                     std::string("is not a sound PNG image (") + reader.error() + ")");
  }
  if (header.bit_depth != 16 || header.color_type != PNG_COLOR_TYPE_GRAY) {
    throw InputError(file.string(),
                     "depth images must be 16-bit grey, this one has " +
                         std::to_string(header.bit_depth) + " bits a channel" +
                         (header.color_type == PNG_COLOR_TYPE_GRAY ? "" : ", colour") +
                         "; pictures made for the eye do not tell depth: save it as it was "
                         "measured, in millimetres");
  }
  if (!is_image_size(header.width, header.height)) {
    throw InputError(file.string(), "has " + size_text(header.width, header.height) +
                                        " pixels, more than the " +
                                        std::to_string(kMaximumImagePixels) + " that are read");
  }
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.pixels.resize(std::size_t{header.width} * header.height);
  std::vector<png_bytep> rows = rows_of(image.pixels.data(), header.width, header.height);
  if (!reader.read_rows(rows.data())) {
    throw InputError(file.string(),
                     std::string("is damaged or truncated (") + reader.error() + ")");
  }
}

void write_png16(const std::filesystem::path& file, int width, int height,
                 const std::vector<std::uint16_t>& pixels) {
  const char* const problem = "cannot be written; is the folder writable, is the disk full?";
  File stream(std::fopen(file.c_str(), "wb"));
  if (!stream) {
    throw InputError(file.string(), problem);
  }
  // libpng takes rows to write as non-const, and does not change them.
  std::vector<png_bytep> rows =
      rows_of(const_cast<std::uint16_t*>(pixels.data()), static_cast<std::size_t>(width),
              static_cast<std::size_t>(height));
  const bool written =
      PngWriter(stream.get())
          .write(static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), rows.data());
  if (!written || std::fclose(stream.release()) != 0) {
    throw InputError(file.string(), problem);
  }
}

}  // namespace lockbox
