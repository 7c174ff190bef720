#include "renderer/image.h"

#include <png.h>
#include <stb_image.h>

#include <algorithm>
#include <cassert>
#include <climits>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace vindu {
namespace {

/// libpng's simplified interface (png.h, "SIMPLIFIED API"); frees what it holds.
struct PngFile {
  png_image control{};

  PngFile() { control.version = PNG_IMAGE_VERSION; }
  ~PngFile() { png_image_free(&control); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  [[noreturn]] void fail(const std::string& what, const std::string& file,
                         const std::string& remedy) const {
    throw Error({what + " (" + control.message + ")", file, remedy});
  }
};

struct StbiDeleter {
  void operator()(void* data) const { stbi_image_free(data); }
};

/// One bit a pixel at deflate's best ratio of 1032 (zlib's FAQ) is 8256; nothing honest needs
/// more.
constexpr std::size_t kMaxPixelsPerByte = 16384;

bool believable(int width_px, int height_px, std::size_t byte_count, std::size_t max_pixels) {
  if (width_px <= 0 || height_px <= 0) return false;
  const std::size_t pixels = static_cast<std::size_t>(width_px) * height_px;
  return pixels <= max_pixels && pixels / kMaxPixelsPerByte <= byte_count;
}

Image image_from(const std::uint8_t* rgba, int width_px, int height_px) {
  Image image{width_px, height_px, {}};
  image.pixels.resize(static_cast<std::size_t>(width_px) * height_px);
  std::memcpy(image.pixels.data(), rgba, image.pixels.size() * sizeof(Rgba8));
  return image;
}

}  // namespace

void write_png(const Image& image, const std::string& file) {
  assert(image.width_px > 0 && image.height_px > 0);
  assert(image.pixels.size() == static_cast<std::size_t>(image.width_px) * image.height_px);
  std::vector<std::uint8_t> rgb(image.pixels.size() * 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    std::copy_n(image.pixels[i].begin(), 3, rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));

  PngFile png;
  png.control.width = static_cast<png_uint_32>(image.width_px);
  png.control.height = static_cast<png_uint_32>(image.height_px);
  png.control.format = PNG_FORMAT_RGB;
  png.control.flags = PNG_IMAGE_FLAG_FAST;  // a wall is 22 million pixels
  if (!png_image_write_to_file(&png.control, file.c_str(), 0, rgb.data(), 0, nullptr))
    png.fail("cannot write this picture", file, "does its folder exist, and is there space?");
}

Image read_png(const std::string& file) {
  PngFile png;
  if (!png_image_begin_read_from_file(&png.control, file.c_str()))
    png.fail("cannot read this picture", file, "it must be a PNG file");
  const std::size_t pixels = static_cast<std::size_t>(png.control.width) * png.control.height;
  if (pixels > kMaxImagePixels)
    throw Error({"the picture is too large: " + std::to_string(png.control.width) + " x " +
                     std::to_string(png.control.height) + " pixels",
                 file, "at most " + std::to_string(kMaxImagePixels) + " pixels are read"});
  png.control.format = PNG_FORMAT_RGBA;
  Image image{static_cast<int>(png.control.width), static_cast<int>(png.control.height), {}};
  image.pixels.resize(pixels);
  if (!png_image_finish_read(&png.control, nullptr, image.pixels.data(), 0, nullptr))
    png.fail("cannot read this picture", file, "is it cut off?");
  return image;
}

std::optional<Image> decode_image(std::span<const std::uint8_t> bytes, std::size_t max_pixels) {
  if (bytes.empty() || bytes.size() > INT_MAX) return std::nullopt;
  const int size = static_cast<int>(bytes.size());
  int width_px = 0;
  int height_px = 0;
  int channels = 0;
  if (!stbi_info_from_memory(bytes.data(), size, &width_px, &height_px, &channels) ||
      !believable(width_px, height_px, bytes.size(), max_pixels))
    return std::nullopt;
  const std::unique_ptr<stbi_uc, StbiDeleter> rgba(
      stbi_load_from_memory(bytes.data(), size, &width_px, &height_px, &channels, 4));
  // The header's size is checked again: a decoder may find another one than its quick look did.
  if (!rgba || !believable(width_px, height_px, bytes.size(), max_pixels)) return std::nullopt;
  return image_from(rgba.get(), width_px, height_px);
}

void paste(const Image& part, int x, int y, Image& whole) {
  const int left = std::max(x, 0);
  const int right = std::min(x + part.width_px, whole.width_px);
  if (left >= right) return;
  const int bottom = std::min(y + part.height_px, whole.height_px);
  for (int row = std::max(y, 0); row < bottom; ++row)
    std::copy_n(&part.at(left - x, row - y), right - left, &whole.at(left, row));
}

}  // namespace vindu
