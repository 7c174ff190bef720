#include "app/stage.h"

#include <algorithm>
#include <filesystem>

#include "core/sha256.h"
#include "renderer/clips.h"

namespace vindu::app {

std::array<Vec3, 8> Stage::corners_in_wall() const {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = box_in_scene.corner(static_cast<Box3f::CornerType>(i)).cast<double>();
    corners[static_cast<std::size_t>(i)] =
        navigation.wall_from_scene * Vec3(navigation.scale * corner);
  }
  return corners;
}

Vec3 Stage::translation_to(const Vec3& point_in_scene) const {
  return -(navigation.wall_from_scene.rotation * (navigation.scale * point_in_scene));
}

Vec3 Glide::at(Time now) const {
  const double share = std::clamp(seconds(now - start_), 0.0, 1.0);
  return from_ + share * share * (3 - 2 * share) * (to_ - from_);
}

bool Glide::done(Time now) const { return now - start_ >= std::chrono::seconds(1); }

Stage stage_of(const LoadedScene& loaded) {
  return {.navigation = loaded.navigation,
          .box_in_scene = loaded.packed.bounds_in_scene,
          .clips = clip_names(loaded.packed.scene),
          .clip = loaded.clip,
          .model = loaded.packed.scene.name};
}

std::string path_for_tiles(const std::string& model, const Site& site) {
  const std::string file = model.empty() ? site.scene.model : model;
  return file.empty() ? "asset:show/show.glb" : std::filesystem::absolute(file).string();
}

void Staging::start(const Wish& wish, const Site& site) {
  wish_ = wish;
  reading_.start([wish, &site](const std::stop_token& stop) {
    const std::string file = model_file(path_for_tiles(wish.model, site));
    const LoadedScene loaded = load_scene(wish.model, wish.place, site, wish.clip, stop);
    return Staged{stage_of(loaded), sha256_of_file(file).value_or("")};
  });
}

}  // namespace vindu::app
