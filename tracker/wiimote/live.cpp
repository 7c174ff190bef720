#include "tracker/wiimote/live.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/log.h"
#include "tracker/wiimote/bluez.h"
#include "tracker/wiimote/find.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kQueue = 512;  // over two seconds at 200 reports a second
constexpr Duration kLookAgain = milliseconds(500);
constexpr Duration kPublish = milliseconds(100);
/// A device that says nothing for so long is opened anew; one that nobody knows and that has not
/// sent a sample by then is passed by.
constexpr Duration kReopen = std::chrono::seconds(5);
constexpr Duration kWorthTelling = std::chrono::seconds(1);

std::string trouble_of(const WiimoteSession& session) {
  const WiimoteHealth health = session.health();
  if (health.trouble.empty() && health.status && health.status->battery_low)
    return "its batteries are nearly empty: change them";
  return health.trouble;
}

std::string count_text(std::uint64_t count, const char* what) {
  return count ? fmt::format(", {} {}", count, what) : "";
}

}  // namespace

std::string trouble_text(const LiveWiimoteState& state) {
  const Duration open = state.health.open_gap;
  if (state.trouble.empty() || open < kWorthTelling) return state.trouble;
  return fmt::format("{} ({:.0f} s without reports)", state.trouble, seconds(open));
}

std::string counts_text(const LiveWiimoteState& state) {
  const WiimoteHealth& health = state.health;
  return fmt::format("camera started {} time{}", health.starts, health.starts == 1 ? "" : "s") +
         count_text(health.repeated, "commands repeated") +
         count_text(health.refused, "reports refused") + count_text(health.lone, "halves alone") +
         count_text(state.dropped, "dropped");
}

bool WiimoteClaims::claim(const std::string& path) {
  const std::lock_guard lock(mutex_);
  return paths_.insert(path).second;
}

void WiimoteClaims::release(const std::string& path) {
  const std::lock_guard lock(mutex_);
  paths_.erase(path);
}

LiveWiimote::LiveWiimote(HidBus& bus, Clock& clock, WiimoteClaims& claims,
                         const LiveWiimoteOptions& options)
    : bus_(bus),
      clock_(clock),
      claims_(claims),
      options_(options),
      own_{.path = options.path, .name = {}, .address = options.address},
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::optional<Observation> LiveWiimote::next(Time until) {
  const std::lock_guard lock(mutex_);
  if (queue_.empty() || queue_.front().arrival > until) return std::nullopt;
  const Observation observation = queue_.front();
  queue_.pop_front();
  return observation;
}

bool LiveWiimote::gone() const {
  const std::lock_guard lock(mutex_);
  return !state_.connected;
}

LiveWiimoteState LiveWiimote::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void LiveWiimote::wait(const std::stop_token& stop, Duration length) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, stop, length, [] { return false; });
}

void LiveWiimote::publish(bool connected, const std::string& trouble) {
  const std::lock_guard lock(mutex_);
  if (trouble != state_.trouble && !trouble.empty()) log_warning(options_.name, trouble);
  if (connected != state_.connected)
    log_info(options_.name, connected ? "Wiimote " + label_of(device_) + " is connected"
                                      : "the Wiimote is gone; waiting for it");
  state_.connected = connected;
  state_.device = device_;
  state_.trouble = trouble;
  if (reader_) state_.health = reader_->session().health();
}

bool LiveWiimote::wanted(const HidInfo& found) const {
  if (!own_.address.empty()) return same_address(found.address, own_.address);
  return own_.path.empty() || found.path == own_.path;
}

/// Two cameras must not change places because their devices came back in another order. A slot of
/// an adapter is known by its path; others come back at any.
void LiveWiimote::stay_with(const HidInfo& device) {
  own_ = device;
  if (kind_of(device) != WiimoteKind::adapter) own_.path.clear();
}

std::string LiveWiimote::not_connected() const {
  if (!knows_its_own())
    return "no Wiimote is connected: press a button on a paired one, or run vindu wiimote pair";
  const auto status = reader_ ? reader_->session().health().status : std::nullopt;
  if (status && nearly_empty(*status))
    return "the Wiimote " + label_of(own_) + " went away with empty batteries: change them";
  return "the Wiimote " + label_of(own_) + " is not connected: press a button on it";
}

/// The wanted device, or the first that can be had and has not yet been tried in vain; null with
/// what hinders it.
std::unique_ptr<HidDevice> LiveWiimote::open_one(std::string& trouble) {
  trouble = not_connected();
  for (const HidInfo& found : find_wiimotes(bus_)) {
    if (!wanted(found)) continue;
    if (fruitless_.contains(found.path) || !claims_.claim(found.path)) continue;
    try {
      std::unique_ptr<HidDevice> device = bus_.open(found.path);
      device_ = found;
      return options_.tap ? options_.tap(std::move(device)) : std::move(device);
    } catch (const Error& error) {
      trouble = error.what();
    }
    claims_.release(found.path);
  }
  return nullptr;
}

/// When all were tried in vain they are tried again.
std::unique_ptr<HidDevice> LiveWiimote::find_device(std::string& trouble) {
  std::unique_ptr<HidDevice> device = open_one(trouble);
  if (device || fruitless_.empty()) return device;
  fruitless_.clear();
  return open_one(trouble);
}

void LiveWiimote::hand_over(const Observation& observation) {
  const std::lock_guard lock(mutex_);
  if (queue_.size() == kQueue) {
    queue_.pop_front();
    ++state_.dropped;
  }
  queue_.push_back(observation);
}

void LiveWiimote::take(const WiimoteSample& sample) {
  if (!std::exchange(proven_, true)) stay_with(device_);
  if (const auto gap = reader_->session().take_gap()) log_debug(options_.name, text_of(*gap));
  if (options_.on_sample) options_.on_sample(sample);
  if (const auto observation = reader_->observation_of(sample)) hand_over(*observation);
}

LiveWiimote::End LiveWiimote::read_until_the_end(const std::stop_token& stop) {
  Time published{}, useful = clock_.now();
  while (!stop.stop_requested()) {
    reader_->session().rumble(rumble_);
    const auto sample = reader_->next_sample(clock_.now() + kPublish);
    const Time now = clock_.now();
    if (sample) take(*sample);
    if (reader_->gone()) return End::gone;
    if (reader_->refuses()) return End::refused;
    if (proven_) useful = std::max(useful, reader_->session().last_report());
    if (now - useful > kReopen) return End::fruitless;
    if (now - published < kPublish) continue;
    published = now;
    publish(true, trouble_of(reader_->session()));
  }
  return End::stopped;
}

LiveWiimote::End LiveWiimote::read(std::unique_ptr<HidDevice> device, const std::stop_token& stop) {
  if (reader_)
    reader_->reconnect(std::move(device), clock_.now());
  else
    reader_.emplace(std::move(device), options_.camera, options_.settings);
  proven_ = knows_its_own();
  const End end = read_until_the_end(stop);
  if (!proven_) fruitless_.insert(device_.path);
  reader_->disconnect();
  claims_.release(device_.path);
  return end;
}

/// A device that only was silent stays connected, whatever is done to wake it.
void LiveWiimote::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::string trouble;
    std::unique_ptr<HidDevice> device = find_device(trouble);
    if (device) {
      if (read(std::move(device), stop) == End::fruitless) continue;
      trouble = not_connected();  // also what refuses commands: an empty slot of an adapter
    }
    if (stop.stop_requested()) return;
    if (reader_) reader_->session().away(clock_.now());
    publish(false, trouble);
    wait(stop, kLookAgain);
  }
}

}  // namespace vindu
