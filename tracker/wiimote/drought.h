// Why there is no stream from a Wiimote that speaks: what it sends in place of the report that is
// asked for.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tracker/wiimote/report.h"

namespace vindu {

class Drought {
 public:
  /// Any report has come.
  void take(std::span<const std::uint8_t> bytes, const ParsedReport& parsed);
  /// No sample has come for a while, and the camera of this format is started again.
  void restart(IrFormat format);
  /// A sample of the wanted format has come.
  void end();

  /// What is wrong, and what helps; empty until starting again has not helped.
  const std::string& diagnosis() const { return diagnosis_; }

 private:
  std::string instead() const;

  int restarts_ = 0;
  // Since the last of them:
  bool heard_ = false;
  int too_short_ = 0, halves_ = 0, others_ = 0;
  std::uint8_t other_id_ = 0;
  std::string diagnosis_;
};

}  // namespace vindu
