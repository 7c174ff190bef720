#include "renderer/import_textures.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <span>

#include "renderer/import_file.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxTextureBytes = std::uintmax_t{1} << 29;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// `name` in `folder` whatever its case; the exact one wins.
std::optional<fs::path> entry_of(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  const std::string wanted = lower_case(name);
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (lower_case(entry->path().filename().string()) == wanted) return entry->path();
  return std::nullopt;
}

std::optional<fs::path> file_of(const fs::path& folder, const fs::path& relative) {
  if (is_file(folder / relative)) return folder / relative;
  fs::path path = folder;
  for (const fs::path& part : relative) {
    if (part.empty() || part == ".") continue;
    const std::optional<fs::path> entry = entry_of(path, part.string());
    if (!entry) return std::nullopt;
    path = *entry;
  }
  return is_file(path) ? std::optional(path) : std::nullopt;
}

/// RFC 3986, section 2.1; what is not two hexadecimal digits stays as it is.
std::string percent_decoded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const bool escape =
        text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(&text[i + 1], &text[i + 1] + 2, byte, 16).ptr == &text[i + 1] + 2;
    result += escape ? static_cast<char>(byte) : text[i];
    if (escape) i += 2;
  }
  return result;
}

/// With slashes, without a URI's scheme, spaces and quotes around it.
std::string cleaned(std::string name) {
  std::ranges::replace(name, '\\', '/');
  const std::string_view around = " \t\r\n\"";
  const std::size_t first = name.find_first_not_of(around);
  if (first == std::string::npos) return {};
  name = name.substr(first, name.find_last_not_of(around) + 1 - first);
  name.erase(std::min(name.find('"'), name.size()));  // X3D lists alternatives: "a.png" "a.gif"
  if (lower_case(name).starts_with("file://")) name.erase(0, std::string_view("file://").size());
  if (name.starts_with("//")) name.erase(0, 2);  // Blender: relative to the file
  return name;
}

std::optional<fs::path> find_cleaned(const fs::path& folder, const std::string& name) {
  constexpr std::array<const char*, 8> usual_folders = {
      ".", "textures", "texture", "tex", "images", "maps", "../textures", "../images"};
  const fs::path path(name);
  if (path.filename().empty()) return std::nullopt;
  if (path.is_relative())
    if (std::optional<fs::path> found = file_of(folder, path)) return found;
  if (path.is_absolute() && is_file(path)) return path;
  for (const char* usual : usual_folders)
    if (std::optional<fs::path> found = file_of(folder, usual / path.filename())) return found;
  return std::nullopt;
}

std::optional<std::vector<std::uint8_t>> bytes_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size > kMaxTextureBytes) return std::nullopt;
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return stream ? std::optional(std::move(bytes)) : std::nullopt;
}

bool is_grey(const Image& image) {
  return std::ranges::all_of(image.pixels, [](const Rgba8& pixel) {
    return std::abs(pixel[0] - pixel[1]) < 4 && std::abs(pixel[1] - pixel[2]) < 4;
  });
}

bool has_holes(const Image& image) {
  return std::ranges::any_of(image.pixels, [](const Rgba8& pixel) { return pixel[3] < 255; });
}

std::uint8_t normal_code(float part) {
  return static_cast<std::uint8_t>(std::lround(127.5f + 127.5f * part));
}

/// From black to white it rises by so many texels.
constexpr float kHeight_texels = 4;

/// Normals from heights by central differences; the picture repeats.
Image normals_from_heights(const Image& heights) {
  const int width = heights.width_px, height = heights.height_px;
  const auto at = [&](int x, int y) {
    return static_cast<float>(heights.at((x + width) % width, (y + height) % height)[0]) / 255;
  };
  Image normals = heights;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float across = 0.5f * kHeight_texels * (at(x + 1, y) - at(x - 1, y));
      const float up = 0.5f * kHeight_texels * (at(x, y - 1) - at(x, y + 1));
      const Eigen::Vector3f normal = Eigen::Vector3f(-across, -up, 1).normalized();
      normals.at(x, y) = {normal_code(normal.x()), normal_code(normal.y()), normal_code(normal.z()),
                          255};
    }
  return normals;
}

/// Sizes may differ: the nearest pixel counts.
void copy_channel(const Image& from, std::size_t from_channel, Image& to, std::size_t to_channel) {
  for (int y = 0; y < to.height_px; ++y)
    for (int x = 0; x < to.width_px; ++x) {
      const auto from_x = static_cast<std::int64_t>(x) * from.width_px / to.width_px;
      const auto from_y = static_cast<std::int64_t>(y) * from.height_px / to.height_px;
      to.at(x, y)[to_channel] =
          from.at(static_cast<int>(from_x), static_cast<int>(from_y))[from_channel];
    }
}

}  // namespace

std::optional<fs::path> find_texture_file(const fs::path& folder, const std::string& name) {
  const std::string clean = cleaned(name);
  if (std::optional<fs::path> found = find_cleaned(folder, clean)) return found;
  return find_cleaned(folder, percent_decoded(clean));
}

TextureImporter::TextureImporter(const aiScene& source, fs::path folder, std::size_t max_pixels,
                                 std::vector<std::string>& warnings)
    : source_(source),
      folder_(folder.empty() ? fs::path(".") : std::move(folder)),
      pixels_left_(max_pixels),
      warnings_(warnings) {}

int TextureImporter::keep(const std::string& key, Image image) {
  if (image.pixels.size() > pixels_left_) {
    warnings_.push_back("texture " + key + " is left out: too many pixels");
    return -1;
  }
  pixels_left_ -= image.pixels.size();
  textures_.push_back(std::move(image));
  return index_of_name_[key] = static_cast<int>(textures_.size()) - 1;
}

int TextureImporter::index_of(const std::string& name) {
  if (name.empty()) return -1;
  const auto [entry, is_new] = index_of_name_.try_emplace(name, -1);
  if (!is_new) return entry->second;
  std::optional<Image> image = load(name);
  return image ? keep(name, std::move(*image)) : -1;
}

int TextureImporter::index_of_normal_map(const std::string& name) {
  if (name.empty()) return -1;
  const std::string key = name + " as normals";
  const auto [entry, is_new] = index_of_name_.try_emplace(key, -1);
  if (!is_new) return entry->second;
  std::optional<Image> image = load(name);
  if (!image) return -1;
  return keep(key, is_grey(*image) ? normals_from_heights(*image) : std::move(*image));
}

int TextureImporter::index_with_channel(int base, std::size_t channel, const std::string& name) {
  if (name.empty()) return base;
  const std::string key =
      std::to_string(base) + " with channel " + std::to_string(channel) + " of " + name;
  const auto [entry, is_new] = index_of_name_.try_emplace(key, base);
  if (!is_new) return entry->second;
  const std::optional<Image> from = load(name);
  if (!from) return base;
  Image image = base < 0 ? Image::filled(from->width_px, from->height_px, {255, 255, 255, 255})
                         : textures_[static_cast<std::size_t>(base)];
  copy_channel(*from, channel == 3 && has_holes(*from) ? 3 : 0, image, channel);
  const int kept = keep(key, std::move(image));
  return kept < 0 ? base : kept;
}

std::optional<Image> TextureImporter::load(const std::string& name) {
  const aiTexture* embedded = source_.GetEmbeddedTexture(name.c_str());
  return embedded ? from_embedded(*embedded, name) : from_file(name);
}

std::optional<Image> TextureImporter::from_embedded(const aiTexture& texture,
                                                    const std::string& name) {
  if (!texture.pcData || texture.mWidth == 0) {
    warnings_.push_back("embedded texture " + name + " is empty");
    return std::nullopt;
  }
  if (texture.mHeight == 0)  // a compressed file of mWidth bytes
    return decoded({reinterpret_cast<const std::uint8_t*>(texture.pcData), texture.mWidth}, name);
  const std::size_t pixels = static_cast<std::size_t>(texture.mWidth) * texture.mHeight;
  if (pixels > pixels_left_) {
    warnings_.push_back("embedded texture " + name + " is left out: too many pixels");
    return std::nullopt;
  }
  Image image{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
  image.pixels.reserve(pixels);
  for (const aiTexel& texel : std::span(texture.pcData, pixels))
    image.pixels.push_back({texel.r, texel.g, texel.b, texel.a});
  return image;
}

std::optional<Image> TextureImporter::from_file(const std::string& name) {
  const std::optional<fs::path> file = find_texture_file(folder_, name);
  if (!file) {
    warnings_.push_back("texture " + name + " is not there; put it beside the model");
    return std::nullopt;
  }
  files_.push_back(file->string());
  const std::optional<std::vector<std::uint8_t>> bytes = bytes_of(*file);
  if (!bytes) {
    warnings_.push_back("texture " + file->string() + " cannot be read");
    return std::nullopt;
  }
  return decoded(*bytes, file->string());
}

std::optional<Image> TextureImporter::decoded(std::span<const std::uint8_t> bytes,
                                              const std::string& name) {
  std::optional<Image> image = decode_image(bytes, pixels_left_);
  if (!image)
    warnings_.push_back("texture " + name +
                        " is left out: broken, too large, or not a PNG, JPEG, TGA or BMP");
  return image;
}

}  // namespace vindu
