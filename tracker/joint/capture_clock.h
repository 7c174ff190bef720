// When a camera took what has arrived. A Wiimote samples on a clock of its own, but its reports
// wait for the radio and come in bursts: arrival is late by up to some 30 ms (thesis Table 5.1).
// What can be known from arrivals alone is the lattice of the samples' times: nothing arrives
// earlier than its sample, and many arrive at once after it (passive synchronisation: Olson 2010).
// Which point of the lattice a report belongs to is decided by counting, and corrected where
// reports were lost, by a small hidden Markov model over their number.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "core/clock.h"

namespace vindu {

struct CaptureTime {
  Time time{};
  Duration sigma{};  ///< how uncertain
};

/// Bound to one thread.
class CaptureClock {
 public:
  /// `lag`: from a sample to the earliest arrival of its report.
  explicit CaptureClock(Duration lag) : lag_(lag) {}

  /// The next report's. Arrivals must not go back. Until the lattice is known (the first 64
  /// reports; again after a second of silence, or when it is lost) it is the arrival, with the
  /// scatter of bursts.
  CaptureTime capture_of(Time arrival);

  bool locked() const { return locked_; }
  Duration lag() const { return lag_; }
  Duration period() const { return from_seconds(period_s_); }

 private:
  static constexpr int kOffsets = 6;  // lattice points that one report may be behind or ahead

  struct Point {
    double index = 0;
    double arrival_s = 0;
  };

  void restart();
  bool find_lattice();
  void track_lattice(double arrival_s, double sure);
  void fit_hull();
  double due_s(double index) const { return floor_s_ + period_s_ * (index - floor_index_); }
  void shift_belief(double arrival_s);
  void judge_offsets(double arrival_s, double gap_s);
  void learn(const std::array<double, kOffsets>& before, double arrival_s, double& prompt_share);

  Duration lag_;
  bool locked_ = false;
  Time origin_{};  // of all seconds below, to keep their digits
  bool started_ = false;
  double last_arrival_s_ = 0;
  std::vector<double> first_arrivals_s_;
  std::deque<Point> points_;  // of the last seconds
  int since_fit_ = 0;
  double period_s_ = 0;
  double floor_index_ = 0, floor_s_ = 0;   // a point of the line of earliest arrivals
  double index_ = 0;                       // of the last report, by counting
  std::array<double, kOffsets> belief_{};  // that it is index_ - 2 ... index_ + 3
  // Learned: how many reports come at once, after a short, a usual and a long gap; and are lost.
  std::array<double, 3> prompt_share_ = {0.2, 0.8, 0.4};
  double loss_ = 0.01;
  double on_lattice_ = 1;  // running share of reports that came at once
};

}  // namespace vindu
