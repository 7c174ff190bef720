#include "cluster/clock_offset.h"

#include <algorithm>

namespace vindu {
namespace {

constexpr Duration kPeriod = std::chrono::seconds(1);
constexpr std::size_t kPeriods = 300;
constexpr std::size_t kLeastForDrift = 10;

}  // namespace

void ClockOffset::add(const RoundTrip& trip) {
  const Duration there = trip.sent_there - trip.received_there;
  const Duration delay = trip.received_here - trip.sent_here - there;
  if (there < Duration::zero() || delay < Duration::zero()) return;
  const Sample sample = {
      .here = trip.received_here,
      .offset =
          ((trip.received_there - trip.sent_here) + (trip.sent_there - trip.received_here)) / 2,
      .half_delay = delay / 2};
  if (best_ && sample.here - best_->here > kPeriod) {
    quickest_.push_back(*best_);
    if (quickest_.size() > kPeriods) quickest_.pop_front();
    best_.reset();
  }
  if (!best_ || sample.half_delay <= best_->half_delay) best_ = sample;
}

// Least squares through the quickest trips of all periods, each as sure as it was quick. Two
// periods' own noise would make a drift of its own: below kLeastForDrift the quickest speaks alone.
std::optional<OffsetEstimate> ClockOffset::at(Time here) const {
  if (!best_) return std::nullopt;
  std::deque<Sample> samples = quickest_;
  samples.push_back(*best_);
  const Sample& quickest = *std::ranges::min_element(samples, {}, &Sample::half_delay);
  if (samples.size() < kLeastForDrift) return OffsetEstimate{quickest.offset, quickest.half_delay};
  double w = 0, t = 0, tt = 0, x = 0, tx = 0;
  for (const Sample& sample : samples) {
    const double sigma_s = seconds(sample.half_delay) + 1e-6;
    const double weight = 1 / (sigma_s * sigma_s), at_s = seconds(sample.here - here);
    const double offset_s = seconds(sample.offset - quickest.offset);
    w += weight;
    t += weight * at_s;
    tt += weight * at_s * at_s;
    x += weight * offset_s;
    tx += weight * at_s * offset_s;
  }
  const double determinant = w * tt - t * t;
  if (!(determinant > 0)) return OffsetEstimate{quickest.offset, quickest.half_delay};
  const double drift = (w * tx - t * x) / determinant, offset_s = (x - drift * t) / w;
  return OffsetEstimate{quickest.offset + from_seconds(offset_s), quickest.half_delay, 1e6 * drift};
}

void OneWayOffset::add(Time sent_there, Time received_here) {
  differences_.push_back(received_here - sent_there);
  if (differences_.size() > kKept) differences_.pop_front();
}

std::optional<Time> OneWayOffset::here(Time there) const {
  if (differences_.empty()) return std::nullopt;
  return there + *std::ranges::min_element(differences_);
}

}  // namespace vindu
