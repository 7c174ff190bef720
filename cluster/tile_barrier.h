// A tile's side of the frame lock: which frame to draw, whether it may be shown, and what to tell
// the master. A tile follows whoever is master now; one that was evicted does nothing else than
// others, and is taken in again when it keeps up. No clock, no network: who calls says what was
// heard and when.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "cluster/clock_offset.h"
#include "cluster/messages.h"

namespace vindu {

class TileBarrier {
 public:
  /// `incarnation`: of this process, not 0.
  explicit TileBarrier(std::uint64_t incarnation);

  /// Messages that come late, twice or from a master that was replaced change nothing.
  void hear(const FrameMessage& message, Time now);

  /// The newest frame and its scene, until it was drawn.
  const FrameMessage* to_draw() const;
  /// Whether that looks like what was drawn last, so that only drew() is to be called.
  bool drawn_already() const;
  void drew(std::uint64_t number, Time started, Time now);
  /// Something else was drawn over what was drawn: that has to be drawn again.
  void spoiled();

  /// When the drawn frame is to be shown; empty while it is not released, or was shown already.
  std::optional<Time> show_time(Time now) const;
  /// `began`: when the swap was called; `now`: when it was done.
  void showed(Time began, Time now);
  const TileParts& presented_parts() const { return presented_parts_; }
  /// All parts of the frame that was shown last, on this tile's clock; empty before the first.
  std::optional<FrameParts> presented_frame(Duration display) const;

  /// What the master has to know, but for the tile's name. To be repeated while a drawn frame is
  /// not released: either message may be lost.
  ReadyMessage ready(Time now) const;
  bool waits() const { return drawn_ > presented_ && drawn_ > heard_.released; }

  /// Frames that were never drawn here, since the last call.
  std::uint64_t take_missed() { return std::exchange(missed_, 0); }

  /// 0 before the first message.
  std::uint64_t epoch() const { return heard_.epoch; }
  std::uint64_t presented() const { return presented_; }
  /// How long nothing was heard of the master.
  Duration silence(Time now) const { return now - received_; }

 private:
  /// What a picture is of.
  struct Content {
    std::uint64_t hash = 0, scene_revision = 0;
    bool operator==(const Content&) const = default;
  };

  bool follows(const FrameMessage& message, Time now) const;
  Content content() const { return {content_hash_of(heard_.newest), heard_.scene_revision}; }

  std::uint64_t incarnation_;
  FrameMessage heard_;        // the newest
  Time sent_{}, received_{};  // of the last message, by the master's clock and by ours
  OneWayOffset offset_;
  std::uint64_t drawn_ = 0, presented_ = 0, missed_ = 0;
  Time presented_time_{};
  std::optional<Content> drawn_content_;
  Duration draw_time_{};
  Time heard_newest_{}, drew_{};  // heard of the newest frame; was done with the drawn one
  FrameOrigin drawn_origin_;
  Duration pickup_{};
  TileParts presented_parts_;
};

}  // namespace vindu
