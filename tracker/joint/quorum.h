// Which of three cameras or more does not stand as it is said to. Dots alone tell that something is
// wrong, not who is: to the side, whichever camera was turned, the same rays miss each other by the
// same. But each turn puts the head in another place, where its LEDs look too far apart or too near
// each other; so the camera is named whose turn explains all dots of all cameras.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "tracker/joint/pose_fit.h"

namespace vindu {

/// What one camera saw, and about where the head was then.
struct Glimpse {
  int camera = 0;
  Rigid3 room_from_head;
  std::vector<Vec2> dots_px;  ///< raw; of the head, or false
  double sigma_px = 0.6;      ///< of each dot
};

/// Which LED of the head each dot is, or -1, where they stand as its LEDs should but all of them
/// aside by about the same: the camera was turned, or the head is some centimetres away. None where
/// fewer than three do so (two of two LEDs), or all is well in two ways.
std::vector<int> labels_aside(std::span<const Vec2> expected_px, std::span<const Vec2> dots_px);

/// Of a least-squares problem of all cameras' shifts and the head's size, poses eliminated: two
/// rows for each camera, then one for the size.
struct QuorumEvidence {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double square = 0;   ///< of all residuals, in sigmas
  double freedom = 0;  ///< numbers that the pose leaves free
};

/// Bound to one thread.
class Quorum {
 public:
  explicit Quorum(std::size_t cameras = 0);

  /// Takes in dots of one head that cameras saw at about one time; some twenty times a second.
  void note(std::span<const CameraModel> cameras, std::span<const Vec3> leds_in_head,
            std::span<const Glimpse> glimpses);
  /// Takes back what was said of all.
  void forgive();

  /// Where all dots of a camera stand, from where those of the others tell: raw pixels, the mean
  /// over two seconds; zero of cameras that agree, and where nobody can say which one is off.
  const Vec2& aside_px(std::size_t camera) const { return standings_[camera].aside_px; }
  /// What is to be added to the sigma of its dots: as much, or its share of what nobody can say.
  double doubt_px(std::size_t camera) const { return standings_[camera].doubt_px; }
  /// By how much one of them stands aside, at least, of which nobody can say which; else 0.
  double undecided_px() const { return undecided_px_; }
  /// Whether its dots looked like a head's lately; else they say nothing about it.
  bool knows(std::size_t camera) const;

 private:
  struct Standing {
    double seen = 0, weighed = 0;  // notes, which fade: of it, and beside two others
    Vec2 aside_px = Vec2::Zero();
    double doubt_px = 0;
  };
  using Set = std::vector<std::size_t>;  // of cameras

  Set weighed() const;
  Eigen::VectorXd shifts_of(const Set& set) const;
  double explained_by(const Set& set) const;
  bool torn_by(const QuorumEvidence& news);
  void forget();
  double shift_px(const Set& others, std::size_t camera) const;
  Set suspects(const Set& agreeing, const Set& aside) const;
  void judge();
  void lead(const Set& set);
  void stand(std::size_t camera, const Vec2& aside_px, double doubt_px);

  std::vector<Standing> standings_;
  QuorumEvidence known_;     // that fades
  Eigen::VectorXd leading_;  // the shifts that explain it best, whoever is suspected beside
  double undecided_px_ = 0;
  double misfit_ = 0;  // running mean of what they leave unexplained of new dots
};

}  // namespace vindu
