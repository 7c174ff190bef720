#include "tracker/wiimote/gaps.h"

#include <fmt/format.h>

#include <algorithm>

namespace vindu {
namespace {

/// A suspicion that no gap has followed for so long explains none.
constexpr Duration kForget = std::chrono::milliseconds(200);

}  // namespace

std::string text_of(const GapCounts& counts) {
  std::string text;
  for (std::size_t cause = 0; cause < counts.size(); ++cause)
    if (counts[cause].gaps)
      text +=
          fmt::format("{}{} {} (longest {:.0f} ms)", text.empty() ? "" : ", ", counts[cause].gaps,
                      name_of(static_cast<GapCause>(cause)), 1e3 * seconds(counts[cause].longest));
  return text.empty() ? "none" : text;
}

void GapCounter::expect(Time now) {
  if (!last_) last_ = now;
}

void GapCounter::suspect(GapCause cause, Time now) {
  suspected_ = suspected_ ? std::max(*suspected_, cause) : cause;
  suspected_at_ = now;
}

void GapCounter::none_since(Time then) {
  if (last_) last_ = std::min(*last_, then);
}

void GapCounter::sample(Time arrival) {
  const Duration gap = last_ ? arrival - *last_ : Duration{};
  last_ = arrival;
  if (gap > (suspected_ ? kGapWithCause : kGap)) {
    GapCount& count = counts_[static_cast<std::size_t>(suspected_.value_or(GapCause::late))];
    ++count.gaps;
    count.total += gap;
    count.longest = std::max(count.longest, gap);
    suspected_.reset();
  } else if (arrival - suspected_at_ > kForget) {
    suspected_.reset();
  }
}

}  // namespace vindu
