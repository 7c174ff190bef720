// What a run says at its end: a table of frames, latency parts and eye error.
#pragma once

#include <string>
#include <vector>

#include "app/cameras.h"
#include "app/frame_loop.h"
#include "simulator/emulated_room.h"
#include "tracker/tracker.h"

namespace vindu::app {

struct Spread {
  double mean = 0;
  double p95 = 0;
  double largest = 0;
};

/// All zero for no values.
Spread spread_of(std::vector<double> values);

struct RunReport {
  LoopResult loop;
  const EmulatedRoom* truth = nullptr;  ///< where there is one: eye errors are against its people
  const Tracker* tracker = nullptr;     ///< where one ran
  std::vector<CameraState> cameras;     ///< those that may go and come back
  double scale = 1;
  SizePx wall_px;
  std::string gl;
};

/// Who the frame is for; the first where nobody is tracked.
const Person& followed_person(const EmulatedRoom& room, const FrameRecord& frame);

/// For people.
std::string table_of(const RunReport& report);

/// The same figures as one JSON object.
std::string json_of(const RunReport& report);

}  // namespace vindu::app
