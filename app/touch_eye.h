// The mode touch: the eye follows a hand before the wall. Who holds his hand at the height of his
// eyes has his head about before it, so that point and a distance give an eye (thesis 3.5.2,
// "Server modes").
#pragma once

#include <optional>
#include <string>

#include "app/eye_source.h"
#include "cluster/bus.h"

namespace vindu::app {

/// Takes touches from the topic event, to which the bus must be subscribed; bus and site must
/// outlive this. Of several hands one is followed: until it leaves, or keeps still for two seconds
/// while another moves. Where no hand is, the eye stays.
class TouchEye final : public EyeSource {
 public:
  TouchEye(Bus& bus, const Site& site)
      : bus_(bus), site_(site), target_in_wall_(site.viewer.default_eye_in_wall) {}

  /// What was touched since the last call; also while the wall is in another mode, so that a hand
  /// is known when it changes.
  void hear(Time now);
  /// Where the eye was before it follows the hand: it glides from there.
  void start_from(const Vec3& eye_in_wall) { eye_in_wall_ = eye_in_wall; }

  EyeNow at(Time now, Time photon) override;

 private:
  struct Hand {
    std::string source;
    int id = 0;
    Time heard{};
    bool operator==(const Hand& other) const { return source == other.source && id == other.id; }
  };
  void hear(const EventMessage& touch, Time now);

  Bus& bus_;
  const Site& site_;
  std::optional<Hand> followed_;
  Vec3 target_in_wall_;
  std::optional<Vec3> eye_in_wall_;
  Time moved_{};
};

}  // namespace vindu::app
