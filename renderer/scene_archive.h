// The bytes of a scene file, both ways by one description of each type: numbers as they lie in
// memory (little endian), lists with their length before them, and those that are used where they
// lie (spans) at whole multiples of 16 bytes.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "renderer/scene_file.h"

namespace vindu {

static_assert(std::endian::native == std::endian::little);

/// Types whose bytes are their value: no pointers, no padding.
template <class Type>
inline constexpr bool kPlain = std::is_arithmetic_v<Type> || std::is_enum_v<Type>;
template <>
inline constexpr bool kPlain<PackedVertex> = sizeof(PackedVertex) == 16;
template <>
inline constexpr bool kPlain<PackedDetail> = sizeof(PackedDetail) == 16;
template <>
inline constexpr bool kPlain<Influences> = sizeof(Influences) == 16;
template <>
inline constexpr bool kPlain<JointBox> = sizeof(JointBox) == 28;
template <>
inline constexpr bool kPlain<Rgba8> = true;
template <class Scalar, int Rows, int Columns>
inline constexpr bool kPlain<Eigen::Matrix<Scalar, Rows, Columns>> = Rows > 0 && Columns > 0;
template <>
inline constexpr bool kPlain<Eigen::Quaternionf> = true;
template <>
inline constexpr bool kPlain<Box3f> = true;

/// Of the spans, from the content's first byte on.
constexpr std::size_t kAlignment = 16;

class SceneWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    const auto* from = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
  }
  void put(bool value) { put(static_cast<std::uint8_t>(value)); }
  template <class Value>
  requires kPlain<Value>
  void put(const Value& value) { append(&value, sizeof(Value)); }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    append(text.data(), text.size());
  }
  template <class Value>
  void put(const std::vector<Value>& list) {
    put(std::uint64_t{list.size()});
    if constexpr (kPlain<Value>)
      append(list.data(), list.size() * sizeof(Value));
    else
      for (const Value& value : list) put(value);
  }
  template <class Value>
  requires kPlain<Value>
  void put(const std::span<const Value>& list) {
    put(std::uint64_t{list.size()});
    bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment);
    append(list.data(), list.size_bytes());
  }
  template <class Value, std::size_t Count>
  void put(const std::array<Value, Count>& list) {
    for (const Value& value : list) put(value);
  }
  template <class Value>
  void put(const std::optional<Value>& value) {
    put(value.has_value());
    put(value.value_or(Value{}));
  }
  template <class Value>
  requires(!kPlain<Value>) void put(const Value& value) {
    fields(*this, const_cast<Value&>(value));  // which writes only
  }

  std::vector<std::uint8_t> bytes_;
};

/// Of bytes that may be damaged: good() is false from the first one that is missing. They must lie
/// at a multiple of kAlignment, and outlive the spans.
class SceneReader {
 public:
  explicit SceneReader(std::span<const std::uint8_t> bytes) : begin_(bytes.data()), left_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  bool good() const { return good_; }
  bool at_end() const { return left_.empty(); }

 private:
  void copy(void* to, std::size_t size) {
    good_ = good_ && size <= left_.size();
    if (!good_ || size == 0) return;
    std::memcpy(to, left_.data(), size);
    left_ = left_.subspan(size);
  }
  void skip(std::size_t size) {
    good_ = good_ && size <= left_.size();
    if (good_) left_ = left_.subspan(size);
  }
  /// Of things that take `least` bytes each; 0 where there cannot be so many.
  std::size_t count(std::size_t least) {
    std::uint64_t count = 0;
    get(count);
    good_ = good_ && count <= left_.size() / least;
    return good_ ? count : 0;
  }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    value = byte != 0;
  }
  template <class Value>
  requires kPlain<Value>
  void get(Value& value) { copy(static_cast<void*>(&value), sizeof(Value)); }
  void get(std::string& text) {
    text.resize(count(1));
    copy(text.data(), text.size());
  }
  template <class Value>
  void get(std::vector<Value>& list) {
    if constexpr (kPlain<Value>) {
      list.resize(count(sizeof(Value)));
      copy(static_cast<void*>(list.data()), list.size() * sizeof(Value));
    } else {
      list.resize(count(1));
      for (Value& value : list)
        if (good_) get(value);
    }
  }
  template <class Value>
  void get(std::span<const Value>& list) {
    static_assert(alignof(Value) <= kAlignment);
    const std::size_t size = count(sizeof(Value));
    const auto over = static_cast<std::size_t>(left_.data() - begin_) % kAlignment;
    skip(over == 0 ? 0 : kAlignment - over);
    good_ = good_ && size <= left_.size() / sizeof(Value);
    if (!good_) return;
    list = {reinterpret_cast<const Value*>(left_.data()), size};
    skip(list.size_bytes());
  }
  template <class Value, std::size_t Count>
  void get(std::array<Value, Count>& list) {
    for (Value& value : list) get(value);
  }
  template <class Value>
  void get(std::optional<Value>& value) {
    std::uint8_t there = 0;
    Value inner{};
    get(there);
    get(inner);
    value = there != 0 ? std::optional(inner) : std::nullopt;
  }
  template <class Value>
  requires(!kPlain<Value>) void get(Value& value) { fields(*this, value); }

  const std::uint8_t* begin_;
  std::span<const std::uint8_t> left_;
  bool good_ = true;
};

template <class Archive>
void fields(Archive& archive, TextureUse& use) {
  archive(use.image, use.uv_set, use.texture_from_uv, use.wrap_u, use.wrap_v);
}

template <class Archive>
void fields(Archive& archive, Material& material) {
  archive(material.name, material.base_colour, material.metallic, material.roughness,
          material.emissive, material.normal_scale, material.occlusion_strength, material.textures,
          material.alpha_mode, material.alpha_cutoff, material.double_sided, material.unlit);
}

template <class Archive>
void fields(Archive& archive, Mesh& mesh) {
  archive(mesh.first_index, mesh.index_count, mesh.material, mesh.bounds_in_node, mesh.skinned,
          mesh.made_by, mesh.replaced_by);
}

template <class Archive>
void fields(Archive& archive, Coarsening& coarsening) {
  archive(coarsening.bounds_in_node, coarsening.error_in_node);
}

template <class Archive>
void fields(Archive& archive, Node& node) {
  archive(node.name, node.parent, node.parent_from_node, node.meshes);
}

template <class Archive, class Value>
void fields(Archive& archive, Key<Value>& key) {
  archive(key.t_s, key.value);
}

template <class Archive>
void fields(Archive& archive, AnimationChannel& channel) {
  archive(channel.node, channel.translations, channel.rotations, channel.scales);
}

template <class Archive>
void fields(Archive& archive, Animation& animation) {
  archive(animation.name, animation.duration_s, animation.channels);
}

template <class Archive>
void fields(Archive& archive, Joint& joint) {
  archive(joint.node, joint.joint_from_mesh);
}

template <class Archive>
void fields(Archive& archive, SceneOutline& scene) {
  archive(scene.name, scene.meshes, scene.coarsenings, scene.materials, scene.nodes,
          scene.animations, scene.joints, scene.colours, scene.metres_per_unit);
}

template <class Archive>
void fields(Archive& archive, PackedGeometry& geometry) {
  archive(geometry.vertices, geometry.uvs, geometry.colours, geometry.details, geometry.influences,
          geometry.indices);
}

template <class Archive>
void fields(Archive& archive, PackedTexture& texture) {
  archive(texture.image, texture.srgb, texture.width_px, texture.height_px, texture.pixels);
}

template <class Archive>
void fields(Archive& archive, SceneSource& source) {
  archive(source.path, source.bytes, source.sha256);
}

template <class Archive>
void fields(Archive& archive, PackedScene& packed) {
  archive(packed.sources, packed.warnings, packed.scene, packed.bounds_in_scene, packed.joint_boxes,
          packed.geometry, packed.textures);
}

}  // namespace vindu
