// Cyclone's serialiser is public (dds/ddsi/ddsi_cdrstream.h) and is the one that it uses itself on
// samples from the network: dds_stream_normalize_data checks every bound before anything is read.
#include "cluster/cdr.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>

#include <cstring>
#include <memory>

#include "cluster/internal/wire_types.h"

namespace vindu {
namespace {

using internal::WireOf;

/// Encapsulation identifiers (RTPS 2.5 table 10.3, DDS-XTypes 1.3 table 59), little endian; then
/// two bytes of options.
constexpr std::size_t kHeaderSize = 4;
constexpr std::uint8_t kPlainCdr = 0x01;
constexpr std::uint8_t kDelimitedCdr2 = 0x09;

std::uint32_t version_of(const dds_topic_descriptor_t& type) {
  return dds_stream_minimum_xcdr_version(type.m_ops);
}

std::uint8_t identifier_of(const dds_topic_descriptor_t& type) {
  return version_of(type) == CDR_ENC_VERSION_1 ? kPlainCdr : kDelimitedCdr2;
}

Bytes serialised(const void* wire, const dds_topic_descriptor_t& type) {
  dds_ostreamLE_t stream;
  dds_ostreamLE_init(&stream, 0, version_of(type));
  dds_stream_writeLE(&stream, static_cast<const char*>(wire), type.m_ops);
  Bytes bytes(kHeaderSize + stream.x.m_index);
  bytes[1] = identifier_of(type);
  std::memcpy(bytes.data() + kHeaderSize, stream.x.m_buffer, stream.x.m_index);
  dds_ostreamLE_fini(&stream);
  return bytes;
}

/// False when the bytes are not exactly one sample.
bool parsed(std::span<const std::uint8_t> bytes, const dds_topic_descriptor_t& type, void* wire) {
  if (bytes.size() <= kHeaderSize || bytes[0] != 0 || bytes[1] != identifier_of(type)) return false;
  const auto size = static_cast<std::uint32_t>(bytes.size() - kHeaderSize);
  // Aligned as the serialiser wants it, and its own to change: normalising writes in place.
  std::vector<std::uint64_t> payload((size + 7) / 8);
  std::memcpy(payload.data(), bytes.data() + kHeaderSize, size);
  auto* const data = reinterpret_cast<char*>(payload.data());
  std::uint32_t end = 0;
  if (!dds_stream_normalize_data(data, &end, size, false, version_of(type), type.m_ops) ||
      end != size)
    return false;
  dds_istream_t stream;
  dds_istream_init(&stream, size, data, version_of(type));
  dds_stream_read(&stream, static_cast<char*>(wire), type.m_ops);
  dds_istream_fini(&stream);
  return true;
}

template <class Value>
Bytes bytes_of(const Value& value) {
  auto wire = std::make_unique<typename WireOf<Value>::type>();
  if (!internal::to_wire(value, *wire)) return {};
  return serialised(wire.get(), WireOf<Value>::descriptor());
}

template <class Value>
std::optional<Value> value_from(std::span<const std::uint8_t> bytes) {
  auto wire = std::make_unique<typename WireOf<Value>::type>();
  if (!parsed(bytes, WireOf<Value>::descriptor(), wire.get())) return std::nullopt;
  return internal::from_wire<Value>(*wire);
}

}  // namespace

Bytes to_cdr(const FrameState& state) { return bytes_of(state); }

std::optional<FrameState> frame_state_from_cdr(std::span<const std::uint8_t> bytes) {
  return value_from<FrameState>(bytes);
}

Bytes to_cdr(const Message& message) {
  return std::visit(
      []<class M>(const M& value) -> Bytes {
        if constexpr (std::same_as<M, Presence>)
          return {};
        else
          return bytes_of(value);
      },
      message);
}

std::optional<Message> message_from_cdr(Topic topic, std::span<const std::uint8_t> bytes) {
  return internal::with_type_of(topic, [&]<class M>(M*) -> std::optional<Message> {
    if constexpr (std::same_as<M, Presence>)
      return std::nullopt;
    else
      return value_from<M>(bytes);
  });
}

}  // namespace vindu
