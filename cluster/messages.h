// What Vindu's processes say to each other, as plain values. wire.idl is their form on the network;
// cdr.h makes bytes of them. Texts longer than the wire allows are cut, values out of range
// refused.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/frame_parts.h"
#include "core/frame_state.h"
#include "core/frame_tally.h"
#include "core/log.h"
#include "core/pose.h"
#include "core/site.h"

namespace vindu {

/// Two Vindus understand each other when this is equal; it names every topic.
constexpr int kProtocolVersion = 5;

/// Master to tiles, repeated: whole and idempotent, the newest is all that a tile needs.
struct FrameMessage {
  std::uint64_t epoch = 0;  ///< the master's incarnation; not 0
  FrameState newest{};
  FrameOrigin origin{};                ///< of `newest`
  std::uint64_t released = 0;          ///< highest frame to swap to; 0: none yet
  std::optional<Time> present_time{};  ///< of `released`, the master's clock; empty: at once
  std::uint64_t scene_revision = 0;    ///< that `newest` is of
  std::uint32_t active_tiles = 0;      ///< in the barrier
  Time sent_time{};                    ///< the master's clock
};

/// Tile to master, repeated while it waits. The last three times and FrameMessage::sent_time are
/// the four of an NTP exchange: the offset of the tile's clock comes with every frame.
struct ReadyMessage {
  std::string tile{};             ///< "tile-3-0"
  std::uint64_t incarnation = 0;  ///< of the tile's process; not 0
  std::uint64_t epoch = 0;        ///< not 0
  std::uint64_t number = 0;       ///< drawn and ready to be shown; not 0
  std::uint64_t presented = 0;    ///< newest frame that was swapped; 0: none
  Time presented_time{};          ///< of that swap; the tile's clock, as all but frame_sent_time
  TileParts presented_parts{};    ///< of that frame
  Duration draw_time{};
  Time frame_sent_time{};      ///< of the newest frame message, as it says; the master's clock
  Time frame_received_time{};  ///< of the same
  Time sent_time{};
};

/// What a process' tiles take together, and what it draws for them.
struct DrawFigures {
  double draw_ms = 0;           ///< of a frame, until the GPU was done
  double gpu_ms = 0;            ///< by the GPU's own timer; 0: not known
  std::uint64_t triangles = 0;  ///< of a frame's scenes, over the tiles
  double culled_share = 0;      ///< of them, in parts that no tile sees; 0 to 1
  double memory_bytes = 0;      ///< of the process, that is in use

  bool operator==(const DrawFigures&) const = default;
};

/// As a tile knows it; that it was evicted the master alone knows (ReportMessage::locked).
enum class TileState { loading, ready, failed };

constexpr std::string_view name_of(TileState state) {
  constexpr std::string_view names[] = {"loading", "ready", "failed"};
  return names[static_cast<int>(state)];
}

/// Tile to master and consoles, from the render thread at 5 Hz: a tile that stops is called silent.
struct StatusMessage {
  std::string tile{};
  std::string host{};
  std::uint64_t incarnation = 0;  ///< not 0
  TileState state = TileState::loading;
  std::uint64_t epoch = 0;      ///< that it follows; 0: none
  std::uint64_t presented = 0;  ///< 0: none
  std::uint64_t scene_revision = 0;
  double frames_per_s = 0;
  std::uint64_t late_frames = 0;
  double refresh_hz = 0;       ///< 0: not known
  double refresh_phase_s = 0;  ///< of the last vertical blank; the tile's clock
  std::string renderer{};      ///< GL_RENDERER
  std::string version{};
  std::string error{};  ///< the last one; empty: none
  DrawFigures draw{};
  std::uint32_t process = 0;  ///< its id on that host
};

/// Master to all, every second: what it alone knows of a tile, or of the wall.
struct ReportMessage {
  std::string tile{};        ///< empty: the whole wall
  std::uint64_t epoch = 0;   ///< not 0
  FrameSummary frames{};     ///< wall: of each frame the tile that swapped last
  std::uint32_t locked = 0;  ///< tiles in the frame lock; tile: 0 or 1
  std::uint32_t evictions = 0;
  std::uint32_t restarts = 0;
  TrackingLevel level = TrackingLevel::lost;  ///< of the head that the wall follows
  std::string event{};                        ///< the last of these; empty: none
  std::string tracker{};  ///< wall: whose poses it follows; empty: of no tracker elsewhere
};

/// Master to tiles: what to load. Files travel otherwise.
struct SceneMessage {
  std::uint64_t revision = 0;
  std::string path{};
  std::string sha256{};  ///< 64 hexadecimal digits; empty: not checked
  Placement placement = Placement::fit;
};

/// Master to tiles: the wall file's text.
struct WallMessage {
  std::uint64_t revision = 0;
  std::string toml{};
};

/// Tracker to all; of two sources of one object the stronger is heard.
struct PoseMessage {
  PoseSample pose{};           ///< its times are the tracker's clock's
  Time sent_time{};            ///< the tracker's clock
  bool followed = false;       ///< the tracker's choice: the wall shows this one's view
  std::string tracker{};       ///< who says it, as in its Participant
  std::uint32_t strength = 0;  ///< of that one's Membership
};

/// Master to all: the thesis' camera event.
struct CameraMessage {
  std::uint64_t number = 0;  ///< of the frame that it is of
  Vec3 position_in_wall = Vec3::Zero();
  Quat room_from_wall = Quat::Identity();  ///< the wall's rotation, never the head's
  std::array<double, 4> frustum_m{};       ///< left, right, bottom, top on the screen plane
  double near_m = kNear_m;
  double far_m = 0;  ///< 0: never ends
};

enum class EventKind { touch, gesture, pick, key };
enum class EventPhase { begin, change, end };

constexpr std::string_view name_of(EventKind kind) {
  constexpr std::array<std::string_view, 4> names = {"touch", "gesture", "pick", "key"};
  return names[static_cast<std::size_t>(kind)];
}
constexpr std::string_view name_of(EventPhase phase) {
  constexpr std::array<std::string_view, 3> names = {"begin", "change", "end"};
  return names[static_cast<std::size_t>(phase)];
}

/// Devices and trackers to the master, which alone makes state of events, and to consoles.
struct EventMessage {
  std::string source{};  ///< "HOST/DEVICE"
  EventKind kind = EventKind::touch;
  EventPhase phase = EventPhase::begin;
  int id = 0;       ///< finger; button, as in wiimote/report.h; of gestures and picks the head
  double x_px = 0;  ///< wall pixels from the upper left
  double y_px = 0;
  double value = 0;    ///< of gestures and picks: how clear it was, 0 to 1
  std::string text{};  ///< "nod", "shake"; of picks what is looked at; of keys "Home"
};

enum class Verb { show, mode, go_to, pattern, blank, stop, overlay, clip, capture, touch_page };

constexpr std::size_t kLongestArgument = 1023;  ///< of a command, and of its clip

/// Consoles to the master and tiles. An argument is data: it never reaches a shell.
struct CommandMessage {
  std::string sender{};       ///< the console's name
  std::uint64_t request = 0;  ///< of that sender; not 0
  Verb verb = Verb::show;
  std::string tile{};  ///< empty: the whole wall
  std::string argument{};
  std::string clip{};                     ///< of Verb::show: its name or number; empty: the first
  std::optional<TouchPage> touch_page{};  ///< of Verb::touch_page; empty: none any more
};

struct AnswerMessage {
  std::string sender{};       ///< of the command
  std::uint64_t request = 0;  ///< of the command
  std::string from{};         ///< who answers
  bool done = false;
  std::string text{};  ///< why not
};

struct LogMessage {
  std::string source{};
  Time time{};                        ///< the source's clock
  LogLevel level = LogLevel::normal;  ///< quiet: a warning
  std::string text{};
};

}  // namespace vindu
