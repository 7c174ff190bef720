#include "tracker/wiimote/gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vindu {
namespace {

/// A suspicion that no gap has followed for so long explains none.
constexpr Duration kForget = std::chrono::milliseconds(200);

std::string length_text(Duration length) {
  return length < std::chrono::seconds(10) ? fmt::format("{:.0f} ms", milliseconds(length))
                                           : fmt::format("{:.0f} s", seconds(length));
}

std::string text_of(const GapCount& count, GapCause cause) {
  if (count.gaps == 1) return fmt::format("1 {} ({})", name_of(cause), length_text(count.longest));
  return fmt::format("{} {} (longest {}, in all {})", count.gaps, name_of(cause),
                     length_text(count.longest), length_text(count.total));
}

void add(const Gap& gap, GapCounts& counts) {
  GapCount& count = counts[static_cast<std::size_t>(gap.cause)];
  ++count.gaps;
  count.total += gap.length;
  count.longest = std::max(count.longest, gap.length);
}

}  // namespace

std::string text_of(const GapCounts& counts) {
  std::string text;
  for (std::size_t cause = 0; cause < counts.size(); ++cause)
    if (counts[cause].gaps)
      text += (text.empty() ? "" : ", ") + text_of(counts[cause], static_cast<GapCause>(cause));
  return text.empty() ? "none" : text;
}

std::string text_of(const Gap& gap) {
  return fmt::format("gap of {}: {}", length_text(gap.length), name_of(gap.cause));
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

std::optional<Gap> GapCounter::gap_until(Time now) const {
  const Duration limit = suspected_ ? explained_gap_limit(period_) : gap_limit(period_);
  if (open(now) <= limit) return std::nullopt;
  return Gap{suspected_.value_or(GapCause::late), open(now)};
}

void GapCounter::sample(Time arrival) {
  if (const auto gap = gap_until(arrival)) {
    add(*gap, counts_);
    closed_ = gap;
    suspected_.reset();
  } else if (arrival - suspected_at_ > kForget) {
    suspected_.reset();
  }
  last_ = arrival;
}

GapCounts GapCounter::counts(Time now) const {
  GapCounts counts = counts_;
  if (const auto gap = gap_until(now)) add(*gap, counts);
  return counts;
}

std::optional<Gap> GapCounter::take_closed() { return std::exchange(closed_, std::nullopt); }

}  // namespace vindu
