#include "server/files/png.hpp"

#include <png.h>

#include <stdexcept>
#include <vector>

namespace xr3 {
namespace {

// Images with two colours compress well at a low level: higher levels take five times as long for a
// third fewer bytes.
constexpr int kCompression = 2;

void append(png_structp png, png_bytep bytes, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(bytes), count);
}

[[noreturn]] void fail(png_structp, png_const_charp message) {
  throw std::runtime_error(std::string("libpng: ") + message);
}

void stay_silent(png_structp, png_const_charp) {}

/// Owns libpng's two handles.
struct Writer {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, stay_silent);
  png_infop info = png_create_info_struct(png);
  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

/// Eight pixels per byte, the leftmost in the highest bit.
std::vector<png_byte> packed_row(const Image& image, int row) {
  std::vector<png_byte> bytes((static_cast<std::size_t>(image.width()) + 7) / 8);
  for (int column = 0; column < image.width(); ++column) {
    const auto at = static_cast<unsigned>(column);
    if (image.at(column, row)) bytes[at / 8] |= static_cast<png_byte>(0x80U >> at % 8);
  }
  return bytes;
}

}  // namespace

std::string to_png(const Raster& raster) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(raster.width_px);
  image.height = static_cast<png_uint_32>(raster.height_px);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, raster.pixels.data(), 0, nullptr) ==
      0) {
    throw std::runtime_error(std::string("libpng: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

std::string to_png(const Image& image) {
  std::string bytes;
  const Writer writer;
  png_set_write_fn(writer.png, &bytes, append, nullptr);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width()),
               static_cast<png_uint_32>(image.height()), 1, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer.png, kCompression);
  png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_write_info(writer.png, writer.info);
  for (int row = 0; row < image.height(); ++row) {
    png_write_row(writer.png, packed_row(image, row).data());
  }
  png_write_end(writer.png, nullptr);
  return bytes;
}

}  // namespace xr3
