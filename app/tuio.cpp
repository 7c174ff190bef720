#include "app/tuio.h"

#include <lo/lo.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

namespace vindu::app {
namespace {

/// Frame numbers count up; one this far behind is a sender that was started again.
constexpr int kRestart = 100;
constexpr int kNoNumber = -1;  // a frame that repeats what is known, never late
constexpr std::size_t kMostSenders = 16;
constexpr int kMostNested = 4;
constexpr std::size_t kBundleHead = 16;  // "#bundle" and a time

struct FreeMessage {
  void operator()(lo_message message) const { lo_message_free(message); }
};
using Message = std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage>;

/// A message's arguments, each asked for by its place. good() is false once one is missing or of
/// another type.
class Arguments {
 public:
  explicit Arguments(lo_message message)
      : types_(lo_message_get_types(message)), values_(lo_message_get_argv(message)) {}

  bool good() const { return good_; }
  int count() const { return static_cast<int>(types_.size()); }
  std::string text(int place) { return is(place, LO_STRING) ? &values_[place]->s : ""; }
  int number(int place) { return is(place, LO_INT32) ? values_[place]->i : 0; }
  double real(int place) {
    return static_cast<double>(is(place, LO_FLOAT) ? values_[place]->f : 0.0f);
  }

 private:
  bool is(int place, char type) {
    good_ = good_ && place < count() && types_[place] == type;
    return good_;
  }

  std::string_view types_;
  lo_arg** values_;
  bool good_ = true;
};

std::uint32_t big_endian(std::span<const std::uint8_t> bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | bytes[3];
}

std::set<int> numbers_from(Arguments& arguments, int first) {
  std::set<int> numbers;
  for (int place = first; place < arguments.count(); ++place)
    numbers.insert(arguments.number(place));
  return numbers;
}

}  // namespace

bool TuioCursors::is_late(int number) {
  if (number == kNoNumber) return false;
  if (number <= newest_ && number > newest_ - kRestart) return true;
  newest_ = number;
  return false;
}

std::vector<TuioChange> TuioCursors::end_frame(int number) {
  const std::map<int, Vec2> moved = std::exchange(moved_, {});
  std::vector<TuioChange> changes;
  if (is_late(number)) return changes;
  std::erase_if(known_, [&](const auto& point) {
    const auto& [id, at] = point;
    if (alive_.contains(id)) return false;
    changes.push_back({{}, EventPhase::end, id, at});
    return true;
  });
  for (const auto& [id, at] : moved) {
    if (!alive_.contains(id)) continue;
    const auto [place, fresh] = known_.try_emplace(id, at);
    if (!fresh && place->second == at) continue;
    place->second = at;
    changes.push_back({{}, fresh ? EventPhase::begin : EventPhase::change, id, at});
  }
  return changes;
}

std::vector<TuioChange> TuioReader::read(std::span<const std::uint8_t> datagram) {
  Datagram result;
  read_packet(datagram, 0, result);
  return std::move(result.changes);
}

/// A bundle holds packets, each with its length before it; anything else is one message.
void TuioReader::read_packet(std::span<const std::uint8_t> packet, int depth, Datagram& datagram) {
  if (packet.empty() || packet[0] != '#') return read_message(packet, datagram);
  if (packet.size() < kBundleHead || depth == kMostNested) {
    ++refused_;
    return;
  }
  packet = packet.subspan(kBundleHead);
  while (!packet.empty()) {
    const std::size_t size = packet.size() < 4 ? packet.size() : big_endian(packet);
    if (packet.size() < 4 || size > packet.size() - 4) {
      ++refused_;
      return;
    }
    read_packet(packet.subspan(4, size), depth + 1, datagram);
    packet = packet.subspan(4 + size);
  }
}

void TuioReader::read_message(std::span<const std::uint8_t> packet, Datagram& datagram) {
  std::vector<std::uint8_t> bytes(packet.begin(), packet.end());  // liblo turns them in place
  int result = 0;
  const Message message(lo_message_deserialise(bytes.data(), bytes.size(), &result));
  if (!message) {
    ++refused_;
    return;
  }
  if (std::string_view(reinterpret_cast<const char*>(packet.data())) != "/tuio/2Dcur") return;
  Arguments arguments(message.get());
  const std::string word = arguments.text(0);
  if (word == "source") datagram.source = arguments.text(1);
  if (senders_.size() >= kMostSenders && !senders_.contains(datagram.source)) senders_.clear();
  TuioCursors& cursors = senders_[datagram.source];
  if (word == "alive") {
    std::set<int> ids = numbers_from(arguments, 1);
    if (arguments.good()) cursors.alive(std::move(ids));
  } else if (word == "set") {
    const int id = arguments.number(1);
    const Vec2 at(arguments.real(2), arguments.real(3));
    if (arguments.good() && at.allFinite()) cursors.set(id, at.cwiseMax(0.0).cwiseMin(1.0));
  } else if (word == "fseq") {
    const int number = arguments.number(1);
    if (arguments.good())
      for (TuioChange& change : cursors.end_frame(number)) {
        change.source = datagram.source;
        datagram.changes.push_back(std::move(change));
      }
  }
  if (!arguments.good()) ++refused_;
}

}  // namespace vindu::app
