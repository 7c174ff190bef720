// Hands before the wall as touch frames and camera systems report them: TUIO 1.1
// (tuio.org/?specification), messages of Open Sound Control in datagrams. Of its profiles
// /tuio/2Dcur: points, each with a number while it lasts, in shares of the whole picture.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "cluster/messages.h"

namespace vindu::app {

/// One change of one point.
struct TuioChange {
  std::string source;  ///< as the sender calls itself; may be empty
  EventPhase phase = EventPhase::begin;
  int id = 0;
  Vec2 at = Vec2::Zero();  ///< 0 to 1, from the picture's upper left

  bool operator==(const TuioChange&) const = default;
};

/// The points of one sender. A frame of TUIO lists all points that are alive, then those that
/// moved, then its number; what it changed is known at its end.
class TuioCursors {
 public:
  void alive(std::set<int> ids) { alive_ = std::move(ids); }
  void set(int id, const Vec2& at) { moved_[id] = at; }
  /// Empty for a frame that was overtaken by a later one.
  std::vector<TuioChange> end_frame(int number);

 private:
  bool is_late(int number);

  std::set<int> alive_;
  std::map<int, Vec2> moved_;  // of the frame that is under way
  std::map<int, Vec2> known_;  // as of the last frame
  int newest_ = -1;
};

/// From datagrams of any number of senders to changes.
class TuioReader {
 public:
  /// What the datagram changes. What is no TUIO in it changes nothing and is counted.
  std::vector<TuioChange> read(std::span<const std::uint8_t> datagram);
  std::uint64_t refused() const { return refused_; }

 private:
  struct Datagram {
    std::string source;
    std::vector<TuioChange> changes;
  };
  void read_packet(std::span<const std::uint8_t> packet, int depth, Datagram& datagram);
  void read_message(std::span<const std::uint8_t> packet, Datagram& datagram);

  std::map<std::string, TuioCursors> senders_;
  std::uint64_t refused_ = 0;
};

}  // namespace vindu::app
