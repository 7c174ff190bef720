#include "tests/renderer_import/model_files.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace vindu::test {
namespace {

namespace fs = std::filesystem;

template <class Value>
void append(std::vector<std::uint8_t>& bytes, std::initializer_list<Value> values) {
  for (const Value value : values) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(Value));
    std::memcpy(&bytes[at], &value, sizeof(Value));
  }
}

std::string data_uri(const std::vector<std::uint8_t>& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

void replace(std::string& text, std::string_view mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
}

/// In the order and with the offsets of the buffer views below.
std::vector<std::uint8_t> quad_buffer() {
  const float half = std::sqrt(0.5f);
  std::vector<std::uint8_t> bytes;
  append<float>(bytes, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});  // positions
  append<float>(bytes, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});  // normals
  append<float>(bytes, {0, 1, 1, 1, 1, 0, 0, 0});              // texture coordinates
  for (int i = 0; i < 4; ++i) append<std::uint8_t>(bytes, {128, 64, 255, 255});
  append<std::uint16_t>(bytes, {0, 1, 2, 0, 2, 3});
  append<float>(bytes, {0, 2});                          // times
  append<float>(bytes, {0, 0, 0, 2, 0, 0});              // translations
  append<float>(bytes, {0, 0, 0, 1, 0, half, 0, half});  // rotations: none, 90 degrees about y
  return bytes;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "vindu_import_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
  folder_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, std::string_view bytes) const {
  const fs::path file = folder_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
  return file.string();
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k)
      triple = triple << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[triple >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string test_model(const std::string& name) { return "/usr/share/assimp/models/" + name; }

std::vector<std::uint8_t> two_pixel_png() {
  return {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
          0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0xf4,
          0x22, 0x7f, 0x8a, 0x00, 0x00, 0x00, 0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8,
          0xcf, 0xc0, 0xf0, 0x1f, 0x08, 0x1b, 0x00, 0x10, 0x79, 0x03, 0x7e, 0x7d, 0x63, 0xce, 0xd7,
          0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
}

std::string gltf_quad(const GltfParts& parts) {
  const std::string colours = parts.vertex_colours ? R"(, "COLOR_0": 3)" : "";
  std::string text = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "quad", "mesh": 0 $node_more}],
    "meshes": [{"primitives": [{"indices": 4, "material": 0,
      "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 $colours}}]}],
    "buffers": [{"byteLength": 220, "uri": "$buffer"}],
    "bufferViews": [
      {"buffer": 0, "byteOffset": 0, "byteLength": 48},
      {"buffer": 0, "byteOffset": 48, "byteLength": 48},
      {"buffer": 0, "byteOffset": 96, "byteLength": 32},
      {"buffer": 0, "byteOffset": 128, "byteLength": 16},
      {"buffer": 0, "byteOffset": 144, "byteLength": 12},
      {"buffer": 0, "byteOffset": 156, "byteLength": 8},
      {"buffer": 0, "byteOffset": 164, "byteLength": 24},
      {"buffer": 0, "byteOffset": 188, "byteLength": 32}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
       "min": [0, 0, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
      {"bufferView": 3, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"},
      {"bufferView": 4, "componentType": 5123, "count": 6, "type": "SCALAR"},
      {"bufferView": 5, "componentType": 5126, "count": 2, "type": "SCALAR",
       "min": [0], "max": [2]},
      {"bufferView": 6, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"bufferView": 7, "componentType": 5126, "count": 2, "type": "VEC4"}],
    "materials": [$material] $more})";
  replace(text, "$node_more", parts.node_more);
  replace(text, "$colours", colours);
  replace(text, "$buffer", data_uri(quad_buffer()));
  replace(text, "$material", parts.material);
  replace(text, "$more", parts.more);
  return text;
}

std::string gltf_moving_quad() {
  GltfParts parts;
  parts.more = R"(, "animations": [{
    "samplers": [{"input": 5, "output": 6}, {"input": 5, "output": 7}],
    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                 {"sampler": 1, "target": {"node": 0, "path": "rotation"}}]}])";
  return gltf_quad(parts);
}

}  // namespace vindu::test
