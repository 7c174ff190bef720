#include "tracker/wiimote/exchange.h"

#include <algorithm>
#include <utility>

namespace vindu {
namespace {

constexpr int kBusy = 4;
constexpr Duration kOursToCome = std::chrono::milliseconds(30);
constexpr int kRefusals = 2;  // one may have been somebody else's
constexpr Duration kShortestTimeout = std::chrono::milliseconds(100);

/// Whether the memory report answers the step's read: the address is the last two of its bytes.
bool answers(const MemoryReport& memory, const Step& step) {
  const auto& bytes = step.report.bytes;
  return step.answer == Answer::memory && memory.address == (bytes[3] << 8 | bytes[4]);
}

bool as_expected(const MemoryReport& memory, const Step& step) {
  const auto size = static_cast<std::size_t>(memory.size);
  return step.expected.empty() ||
         std::ranges::equal(step.expected, std::span(memory.data).first(size));
}

}  // namespace

void Exchange::begin(std::vector<Step> steps, const Patience& patience) {
  steps_.assign(std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
  patience_ = patience;
  tries_ = refused_ = 0;
  next_try_ = {};
  timeout_ = Progress::none;
}

/// Four times what answers take. One that comes after its command was sent again would be taken for
/// that of the next, which then were sent too early, and lost.
Duration Exchange::timeout() const {
  if (slowest_ == Duration{}) return patience_.timeout;
  return std::min(patience_.timeout, std::max(kShortestTimeout, 4 * slowest_));
}

Progress Exchange::answered(Time arrival) {
  if (tries_ == 1) slowest_ = std::max(arrival - sent_, slowest_ * 7 / 8);
  return end_step();
}

Progress Exchange::end_step() {
  steps_.pop_front();
  tries_ = refused_ = 0;
  next_try_ = {};
  return steps_.empty() ? Progress::finished : Progress::step;
}

Progress Exchange::fail(Progress how, const std::string& why) {
  failure_ = std::string("could not ") + steps_.front().purpose + ": " + why;
  steps_.clear();
  return how;
}

Progress Exchange::refuse() {
  if (!steps_.front().needed) return end_step();
  return fail(Progress::refused, "the Wiimote refused it with error " + std::to_string(refused_));
}

Progress Exchange::take(const Report& report, Time arrival) {
  if (steps_.empty() || tries_ == 0) return Progress::none;
  const Step& step = steps_.front();
  if (std::holds_alternative<StatusReport>(report) && step.answer == Answer::status)
    return answered(arrival);
  if (const auto* acknowledgement = std::get_if<Acknowledgement>(&report))
    return take(*acknowledgement, arrival);
  if (const auto* memory = std::get_if<MemoryReport>(&report)) return take(*memory, arrival);
  return Progress::none;
}

/// An error may answer somebody else, and ours is to come.
Progress Exchange::take(const Acknowledgement& acknowledgement, Time arrival) {
  if (acknowledgement.command != steps_.front().report.bytes[0]) return Progress::none;
  const bool done = acknowledgement.error == 0 && steps_.front().answer == Answer::acknowledgement;
  if (done) return answered(arrival);
  if (acknowledgement.error != kBusy) refused_ = acknowledgement.error;
  next_try_ = std::min(next_try_, arrival + kOursToCome);
  return Progress::none;
}

Progress Exchange::take(const MemoryReport& memory, Time arrival) {
  if (!answers(memory, steps_.front()) || memory.error == kBusy) return Progress::none;
  if (memory.error == 0)
    return as_expected(memory, steps_.front())
               ? answered(arrival)
               : fail(Progress::unequal, "it is not what was written");
  refused_ = memory.error;
  next_try_ = arrival;
  return Progress::none;
}

std::optional<OutputReport> Exchange::next_output(Time now) {
  while (!steps_.empty() && now >= next_try_) {
    if (steps_.front().answer == Answer::none) {
      const OutputReport report = steps_.front().report;
      end_step();
      return report;
    }
    const bool refused = refused_ != 0 && tries_ >= kRefusals;
    if (tries_ < patience_.tries && !refused) {
      refused_ = 0;
      if (++tries_ > 1) ++repeated_;
      sent_ = now;
      next_try_ = now + timeout();
      return steps_.front().report;
    }
    timeout_ = refused_ != 0     ? refuse()
               : patience_.go_on ? end_step()
                                 : fail(Progress::deserted, "the Wiimote gave no answer");
  }
  return std::nullopt;
}

Progress Exchange::take_timeout() {
  const Progress timeout = std::exchange(timeout_, Progress::none);
  return timeout == Progress::step ? Progress::none : timeout;
}

Time Exchange::deadline() const { return steps_.empty() ? Time::max() : next_try_; }

}  // namespace vindu
