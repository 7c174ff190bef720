#include "core/frame_tally.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vindu {

Quantiles quantiles_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
  };
  return {at(0.5), at(0.99), values.back()};
}

double FrameSummary::mean_motion_to_photon_ms() const {
  return std::accumulate(mean_ms.begin(), mean_ms.end(), 0.0);
}

void FrameTally::add(Time now, const FrameParts& parts, Duration skew) {
  frames_.push_back({now, parts, skew});
  forget(now);
}

void FrameTally::forget(Time now) {
  while (!frames_.empty() && now - frames_.front().time > window_) frames_.pop_front();
}

FrameSummary FrameTally::summary(Time now) {
  forget(now);
  FrameSummary summary{.frames = frames_.size()};
  if (frames_.empty()) return summary;
  std::vector<double> sums_ms, skews_ms;
  for (const Frame& frame : frames_) {
    for (std::size_t part = 0; part < kParts; ++part)
      summary.mean_ms[part] += milliseconds(frame.parts.durations[part]);
    sums_ms.push_back(milliseconds(frame.parts.motion_to_photon()));
    skews_ms.push_back(milliseconds(frame.skew));
  }
  for (double& mean : summary.mean_ms) mean /= static_cast<double>(frames_.size());
  summary.motion_to_photon_ms = quantiles_of(std::move(sums_ms));
  summary.skew_ms = quantiles_of(std::move(skews_ms));
  summary.tracked = frames_.back().parts.tracked;
  const double length_s = seconds(frames_.back().time - frames_.front().time);
  if (length_s > 0) summary.frames_per_s = static_cast<double>(frames_.size() - 1) / length_s;
  return summary;
}

}  // namespace vindu
