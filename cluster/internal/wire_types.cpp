#include "cluster/internal/wire_types.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace vindu::internal {
namespace {

/// Times are within a century of their clock's zero, so that differences never overflow.
constexpr std::int64_t kMostTime_ns = std::int64_t{1} << 61;
constexpr std::int64_t kNoTime_ns = std::numeric_limits<std::int64_t>::min();

bool in_range(double value, Limits limits) { return value >= limits.low && value <= limits.high; }
bool in_range_ns(std::int64_t value_ns) {
  return value_ns >= -kMostTime_ns && value_ns <= kMostTime_ns;
}

/// The most bytes, up to `most`, that end no UTF-8 letter in its middle.
std::size_t whole_letters(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text.size();
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;
  return most;
}

struct ToWire {
  bool ok = true;

  void require(bool holds) { ok = ok && holds; }
  void id(std::uint64_t& wire, std::uint64_t value) { require((wire = value) != 0); }
  template <class Count>
  void count(Count& wire, Count value) {
    wire = value;
  }
  void integer(std::int32_t& wire, int value) { wire = value; }
  void flag(std::uint8_t& wire, bool value) { wire = value ? 1 : 0; }
  template <class Value>
  bool there(std::uint8_t& wire, const std::optional<Value>& value) {
    flag(wire, value.has_value());
    return value.has_value();
  }
  /// `most`: 255 at most.
  void index(std::uint8_t& wire, std::size_t value, std::size_t most) {
    require(value <= most);
    wire = static_cast<std::uint8_t>(value);
  }
  template <class Values>
  void size(std::uint8_t& wire, const Values& values, std::size_t most) {
    index(wire, values.size(), most);
  }
  void number(double& wire, double value, Limits limits = {}) {
    require(in_range(value, limits));
    wire = value;
  }
  template <std::size_t count, class Values>
  void numbers(double (&wire)[count], const Values& values) {
    for (std::size_t i = 0; i < count; ++i) number(wire[i], values[i]);
  }
  void quaternion(double (&wire)[4], const Quat& value) {
    numbers(wire, value.coeffs());
    require(std::abs(value.squaredNorm() - 1) < 1e-6);
  }
  void covariance(double (&wire)[21], const Mat6& value) {
    int next = 0;
    for (int row = 0; row < 6; ++row)
      for (int column = row; column < 6; ++column) {
        number(wire[next++], value(row, column));
        require(row != column || value(row, column) >= 0);
      }
  }
  template <class Enum>
  void choice(std::uint8_t& wire, Enum value, Enum) {
    wire = static_cast<std::uint8_t>(value);
  }
  void duration(std::int64_t& wire, Duration value) { require(in_range_ns(wire = value.count())); }
  void time(std::int64_t& wire, Time value) { duration(wire, value.time_since_epoch()); }
  void optional_time(std::int64_t& wire, std::optional<Time> value) {
    wire = kNoTime_ns;
    if (value) time(wire, *value);
  }
  /// Cut where it is too long.
  template <std::size_t size>
  void text(char (&wire)[size], const std::string& value) {
    const std::string_view to_nul(value.c_str());
    std::memcpy(wire, to_nul.data(), whole_letters(to_nul, size - 1));
  }
  /// Refused where it is too long: half a path is worse than none.
  template <std::size_t size>
  void whole_text(char (&wire)[size], const std::string& value) {
    require(value.size() < size && value.find('\0') == std::string::npos);
    text(wire, value);
  }
  template <std::size_t size>
  void name(char (&wire)[size], const std::string& value) {
    require(!value.empty());
    whole_text(wire, value);
  }
};

struct FromWire {
  bool ok = true;

  void require(bool holds) { ok = ok && holds; }
  void id(std::uint64_t wire, std::uint64_t& value) { require((value = wire) != 0); }
  template <class Count>
  void count(Count wire, Count& value) {
    value = wire;
  }
  void integer(std::int32_t wire, int& value) { value = wire; }
  void flag(std::uint8_t wire, bool& value) {
    require(wire <= 1);
    value = wire == 1;
  }
  template <class Value>
  bool there(std::uint8_t wire, std::optional<Value>& value) {
    require(wire <= 1);
    if (wire == 1) value.emplace();
    return wire == 1;
  }
  void index(std::uint8_t wire, std::size_t& value, std::size_t most) {
    require(wire <= most);
    value = wire;
  }
  template <class Values>
  void size(std::uint8_t wire, Values& values, std::size_t most) {
    require(wire <= most);
    values.resize(std::min<std::size_t>(wire, most));
  }
  void number(double wire, double& value, Limits limits = {}) {
    require(in_range(wire, limits));
    value = wire;
  }
  template <std::size_t count, class Values>
  void numbers(const double (&wire)[count], Values& values) {
    for (std::size_t i = 0; i < count; ++i) number(wire[i], values[i]);
  }
  void quaternion(const double (&wire)[4], Quat& value) {
    numbers(wire, value.coeffs());
    require(std::abs(value.squaredNorm() - 1) < 1e-6);
  }
  void covariance(const double (&wire)[21], Mat6& value) {
    int next = 0;
    for (int row = 0; row < 6; ++row)
      for (int column = row; column < 6; ++column) {
        number(wire[next++], value(row, column));
        value(column, row) = value(row, column);
        require(row != column || value(row, column) >= 0);
      }
  }
  template <class Enum>
  void choice(std::uint8_t wire, Enum& value, Enum last) {
    require(wire <= static_cast<std::uint8_t>(last));
    if (ok) value = static_cast<Enum>(wire);
  }
  // What is out of range never becomes a value: fields of a refused message are computed with, too.
  void duration(std::int64_t wire, Duration& value) {
    require(in_range_ns(wire));
    if (in_range_ns(wire)) value = Duration(wire);
  }
  void time(std::int64_t wire, Time& value) {
    Duration since_zero{};
    duration(wire, since_zero);
    value = Time(since_zero);
  }
  void optional_time(std::int64_t wire, std::optional<Time>& value) {
    if (wire != kNoTime_ns) time(wire, value.emplace());
  }
  template <std::size_t size>
  void text(const char (&wire)[size], std::string& value) {
    value.assign(wire, strnlen(wire, size));
    require(value.size() < size);
  }
  template <std::size_t size>
  void whole_text(const char (&wire)[size], std::string& value) {
    text(wire, value);
  }
  template <std::size_t size>
  void name(const char (&wire)[size], std::string& value) {
    text(wire, value);
    require(!value.empty());
  }
};

}  // namespace

template <class Value>
bool to_wire(const Value& value, typename WireOf<Value>::type& wire) {
  std::memset(&wire, 0, sizeof wire);
  ToWire op;
  fields(op, wire, value);
  return op.ok;
}

template <class Value>
std::optional<Value> from_wire(const typename WireOf<Value>::type& wire) {
  FromWire op;
  Value value;
  fields(op, wire, value);
  if (!op.ok) return std::nullopt;
  return value;
}

#define VINDU_WIRE(Value)                                    \
  template bool to_wire(const Value&, WireOf<Value>::type&); \
  template std::optional<Value> from_wire<Value>(const WireOf<Value>::type&)
VINDU_WIRE(FrameState);
VINDU_WIRE(FrameMessage);
VINDU_WIRE(ReadyMessage);
VINDU_WIRE(StatusMessage);
VINDU_WIRE(SceneMessage);
VINDU_WIRE(WallMessage);
VINDU_WIRE(PoseMessage);
VINDU_WIRE(CameraMessage);
VINDU_WIRE(EventMessage);
VINDU_WIRE(CommandMessage);
VINDU_WIRE(AnswerMessage);
VINDU_WIRE(LogMessage);
VINDU_WIRE(ReportMessage);
#undef VINDU_WIRE

}  // namespace vindu::internal
