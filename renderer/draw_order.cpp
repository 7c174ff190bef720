#include <algorithm>

#include "renderer/gpu_scene.h"

namespace vindu {
namespace {

/// What is to become of a level of detail.
enum class Verdict : char { none, fine, too_coarse, unseen };

/// Draws by distance; those at the same one in the order in which they were added.
class ByDistance {
 public:
  void add(float distance, const GpuScene::Draw& draw) {
    places_.emplace_back(distance, static_cast<std::uint32_t>(draws_.size()));
    draws_.push_back(&draw);
  }
  std::vector<const GpuScene::Draw*> sorted() {
    std::ranges::sort(places_);
    std::vector<const GpuScene::Draw*> draws;
    draws.reserve(places_.size());
    for (const auto& [distance, index] : places_) draws.push_back(draws_[index]);
    return draws;
  }

 private:
  std::vector<std::pair<float, std::uint32_t>> places_;
  std::vector<const GpuScene::Draw*> draws_;
};

}  // namespace

DrawCount& DrawCount::operator+=(const DrawCount& other) {
  draws += other.draws;
  culled += other.culled;
  triangles += other.triangles;
  culled_triangles += other.culled_triangles;
  return *this;
}

/// From these draws of the coarsest level to finer ones, where they are judged too coarse: what a
/// scene has in more detail than is shown costs nothing. Neither errors nor bounds grow on this
/// way, so what is fine or unseen has nothing below it that is not. `take` gets all others with
/// their verdict.
template <class Judge, class Take>
void GpuScene::walk_levels(std::span<const int> coarsest, Judge judge, Take take) const {
  std::vector<Verdict> verdicts(coarsenings_.size(), Verdict::none);
  std::vector<int> too_coarse;
  const auto consider = [&](int index) {
    const Draw& draw = draws_[index];
    if (draw.made_by < 0) return take(draw, Verdict::fine);
    Verdict& verdict = verdicts[draw.made_by];
    if (verdict == Verdict::none) {
      verdict = judge(coarsenings_[draw.made_by]);
      if (verdict == Verdict::too_coarse) too_coarse.push_back(draw.made_by);
    }
    if (verdict != Verdict::too_coarse) take(draw, verdict);
  };
  for (const int index : coarsest) consider(index);
  while (!too_coarse.empty()) {
    const PosedCoarsening& posed = coarsenings_[too_coarse.back()];
    too_coarse.pop_back();
    for (const int index : posed.finer) consider(index);
  }
}

std::vector<const GpuScene::Draw*> GpuScene::coarsest() const {
  std::vector<const Draw*> draws;
  for (const int index : coarsest_) draws.push_back(&draws_[index]);
  return draws;
}

const Box3f& GpuScene::extent_in_world(const Draw& coarsest) const {
  return coarsest.made_by < 0 ? bounds_in_world(coarsest)
                              : coarsenings_[coarsest.made_by].bounds_in_world;
}

std::vector<const GpuScene::Draw*> GpuScene::draws_within(double error_m) const {
  std::vector<const Draw*> chosen;
  walk_levels(
      coarsest_,
      [&](const PosedCoarsening& posed) {
        return posed.error_m <= error_m ? Verdict::fine : Verdict::too_coarse;
      },
      [&](const Draw& draw, Verdict) { chosen.push_back(&draw); });
  return chosen;
}

std::vector<int> GpuScene::coarsest_within(const ViewPlanes& planes) const {
  if (!coarsest_boxes_ || coarsest_boxes_->moves != moves_) {
    coarsest_boxes_ = PosedRows{moves_, {}};
    for (const int index : coarsest_) coarsest_boxes_->in_world.add(extent_in_world(draws_[index]));
  }
  std::vector<int> within;
  for (const std::uint32_t place : coarsest_boxes_->in_world.seen_by(planes))
    within.push_back(coarsest_[place]);
  return within;
}

std::vector<const GpuScene::Draw*> GpuScene::coarsest_seen_by(const View& view) const {
  std::vector<const Draw*> seen;
  for (const int index : coarsest_within(ViewPlanes(view.clip_from_world)))
    seen.push_back(&draws_[index]);
  return seen;
}

GpuScene::Seen GpuScene::seen_by(const View& view) const {
  const ViewPlanes planes(view.clip_from_world);
  const Eigen::Vector3f eye = view.eye_in_world.cast<float>();
  Seen seen;
  ByDistance solid, blended;
  const auto judge = [&](const PosedCoarsening& posed) {
    if (planes.miss(posed.bounds_in_world)) return Verdict::unseen;
    return fine_enough(view.detail, view.eye_in_world, posed.bounds_in_world, posed.error_m)
               ? Verdict::fine
               : Verdict::too_coarse;
  };
  const auto take = [&](const Draw& draw, Verdict verdict) {
    const std::uint64_t triangles = draw.mesh.index_count / 3;
    const bool culled = verdict == Verdict::unseen || planes.miss(bounds_in_world(draw));
    seen.count += {1, culled, triangles, culled ? triangles : 0};
    if (culled) return;
    // Blended ones by their middle, so that what is behind shines through; solid ones by their
    // nearest point, so that little is drawn twice.
    const Box3f& box = bounds_in_world(draw);
    if (draw.alpha_mode == AlphaMode::blend)
      blended.add(-(box.center() - eye).squaredNorm(), draw);
    else
      solid.add(box.squaredExteriorDistance(eye), draw);
  };
  const std::vector<int> within = coarsest_within(planes);
  const auto culled = static_cast<int>(coarsest_.size() - within.size());
  std::uint64_t triangles = coarsest_triangles_;
  for (const int index : within) triangles -= draws_[index].mesh.index_count / 3;
  seen.count = {culled, culled, triangles, triangles};
  walk_levels(within, judge, take);
  seen.solid = solid.sorted();
  seen.blended = blended.sorted();
  return seen;
}

}  // namespace vindu
