// A scene without its geometry: where it stands and what it plays. A wall's master knows it so; and
// reads models to know, beside the frames that go on.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/background.h"
#include "app/common.h"
#include "core/frame_state.h"
#include "core/site.h"
#include "renderer/scene.h"

namespace vindu::app {

struct Stage {
  Navigation navigation;
  Box3f box_in_scene;
  std::vector<std::string> clips;
  int clip = 0;
  std::string model;
  Time clip_start{};

  /// So that every frame shows something else.
  bool plays() const { return clip >= 0 && static_cast<std::size_t>(clip) < clips.size(); }
  /// Of the box, in wall.
  std::array<Vec3, 8> corners_in_wall() const;
  /// Of wall_from_scene, that brings the point to the wall's middle.
  Vec3 translation_to(const Vec3& point_in_scene) const;
};

/// A translation on its way to another one, within a second.
class Glide {
 public:
  Glide(const Vec3& from, const Vec3& to, Time start) : from_(from), to_(to), start_(start) {}

  Vec3 at(Time now) const;
  bool done(Time now) const;

 private:
  Vec3 from_, to_;
  Time start_;
};

Stage stage_of(const LoadedScene& loaded);

/// As tiles are told: the show is part of every installation, a model has one path on all hosts. An
/// empty name is the wall file's scene.
std::string path_for_tiles(const std::string& model, const Site& site);

/// Reads a model to know that it can be read and where it stands. Bound to one thread; reading has
/// one of its own.
class Staging {
 public:
  struct Wish {
    std::string model;
    std::string clip;
    std::optional<Placement> place;
  };
  struct Staged {
    Stage stage;
    std::string sha256;  ///< of the model
  };

  /// `site` must outlive the reading.
  void start(const Wish& wish, const Site& site);
  bool running() const { return reading_.running(); }
  bool done() const { return reading_.done(); }
  const Wish& wish() const { return wish_; }
  /// Throws what reading threw.
  Staged take() { return reading_.take(); }

 private:
  Wish wish_;
  Background<Staged> reading_;
};

}  // namespace vindu::app
