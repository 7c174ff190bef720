#include "tests/faults/lossy_switch.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace vindu::testing {
namespace {

constexpr std::size_t kHeader = 14;  // to, from, type: IEEE 802.3
constexpr std::size_t kLongest = 65536 + kHeader;

std::uint64_t address_at(const std::vector<std::uint8_t>& frame, std::size_t offset) {
  std::uint64_t address = 0;
  for (std::size_t i = 0; i < 6; ++i) address = address << 8 | frame[offset + i];
  return address;
}

bool for_many(const std::vector<std::uint8_t>& frame) { return (frame[0] & 1) != 0; }

}  // namespace

LossySwitch::LossySwitch(std::vector<int> cards, std::uint64_t seed)
    : cards_(std::move(cards)), cables_(cards_.size()), random_(seed), thread_([this] { run(); }) {}

LossySwitch::~LossySwitch() {
  stop_ = true;
  thread_.join();
}

void LossySwitch::set(std::size_t port, const Cable& cable) {
  const std::lock_guard lock(mutex_);
  cables_[port] = cable;
}

void LossySwitch::set_all(const Cable& cable) {
  const std::lock_guard lock(mutex_);
  std::ranges::fill(cables_, cable);
}

void LossySwitch::run() {
  std::vector<pollfd> waiting;
  for (const int card : cards_) waiting.push_back({.fd = card, .events = POLLIN, .revents = 0});
  while (!stop_) {
    poll(waiting.data(), waiting.size(), wait_ms());
    for (std::size_t port = 0; port < waiting.size(); ++port)
      if (waiting[port].revents & POLLIN) take_from(port);
    deliver_due();
  }
}

int LossySwitch::wait_ms() const {
  constexpr int kNoticeStop = 50;
  if (delayed_.empty()) return kNoticeStop;
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(delayed_.top().due - clock_.now()).count();
  return static_cast<int>(std::clamp<long long>(left, 0, kNoticeStop));
}

void LossySwitch::take_from(std::size_t port) {
  static thread_local std::array<std::uint8_t, kLongest> bytes;
  const auto length = read(cards_[port], bytes.data(), bytes.size());
  if (length < static_cast<ssize_t>(kHeader)) return;
  forward(port, Frame(bytes.begin(), bytes.begin() + length));
}

void LossySwitch::forward(std::size_t from, const Frame& frame) {
  port_of_[address_at(frame, 6)] = from;
  const auto known = port_of_.find(address_at(frame, 0));
  if (!for_many(frame) && known != port_of_.end()) {
    if (known->second != from) pass(from, known->second, frame);
    return;
  }
  for (std::size_t to = 0; to < cards_.size(); ++to)
    if (to != from) pass(from, to, frame);
}

void LossySwitch::pass(std::size_t from, std::size_t to, const Frame& frame) {
  const std::lock_guard lock(mutex_);
  if (lost_on(cables_[from]) || lost_on(cables_[to])) {
    ++lost_;
    return;
  }
  ++passed_;
  const Duration delay = delay_on(cables_[from]) + delay_on(cables_[to]);
  if (delay == Duration::zero())
    // A card that is full loses the frame, as real ones do.
    (void)!write(cards_[to], frame.data(), frame.size());
  else
    delayed_.push({clock_.now() + delay, to, frame});
}

void LossySwitch::deliver_due() {
  while (!delayed_.empty() && delayed_.top().due <= clock_.now()) {
    const Delayed& next = delayed_.top();
    (void)!write(cards_[next.port], next.frame.data(), next.frame.size());
    delayed_.pop();
  }
}

bool LossySwitch::lost_on(const Cable& cable) {
  return !cable.plugged || std::bernoulli_distribution(cable.loss)(random_);
}

Duration LossySwitch::delay_on(const Cable& cable) {
  return cable.delay +
         from_seconds(seconds(cable.jitter) * std::uniform_real_distribution<>()(random_));
}

}  // namespace vindu::testing
