#include "tracker/ir_camera/blobs.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace vindu {
namespace {

/// What is summed up over the pixels of a blob.
struct WeighedBlob {
  std::int64_t weight = 0;
  std::int64_t weighted_x = 0;
  std::int64_t weighted_y = 0;
  int area_px = 0;
  bool cut = false;

  void add(const WeighedBlob& other) {
    weight += other.weight;
    weighted_x += other.weighted_x;
    weighted_y += other.weighted_y;
    area_px += other.area_px;
    cut = cut || other.cut;
  }
};

/// Neighbouring pixels of one row above the threshold: from begin up to, not including, end.
struct Run {
  int begin = 0;
  int end = 0;
  std::size_t blob = 0;
};

/// The first pixel from x on that is above the threshold. Most of a picture is dark: whole blocks
/// are skipped by their maximum, which compilers turn into vector instructions.
int find_above(const std::uint8_t* row, int x, int end, std::uint8_t threshold) {
  constexpr int kBlock = 64;
  for (; x + kBlock <= end; x += kBlock) {
    std::uint8_t brightest = 0;
    for (int i = 0; i < kBlock; ++i) brightest = std::max(brightest, row[x + i]);
    if (brightest > threshold) break;
  }
  while (x < end && row[x] <= threshold) ++x;
  return x;
}

/// Blobs that grow row by row, and are united where a run touches several of the row above.
class BlobMap {
 public:
  BlobMap(const GreyView& picture, std::uint8_t threshold)
      : picture_(picture), threshold_(threshold) {
    for (int y = 0; y < picture.height_px; ++y) add_row(y);
  }

  /// All blobs, in the order of their first pixels; those united into others have no area.
  const std::vector<WeighedBlob>& blobs() const { return blobs_; }

 private:
  void add_row(int y) {
    std::swap(above_, current_);
    current_.clear();
    const std::uint8_t* row = picture_.row(y);
    std::size_t first_above = 0;
    for (int x = 0; (x = find_above(row, x, picture_.width_px, threshold_)) < picture_.width_px;) {
      const int begin = x;
      while (x < picture_.width_px && row[x] > threshold_) ++x;
      while (first_above < above_.size() && above_[first_above].end < begin) ++first_above;
      Run run{begin, x, blobs_.size()};
      blobs_.push_back(sum_of(row, y, begin, x));
      parents_.push_back(run.blob);
      for (std::size_t i = first_above; i < above_.size() && above_[i].begin <= x; ++i)
        run.blob = unite(run.blob, above_[i].blob);
      current_.push_back(run);
    }
  }

  WeighedBlob sum_of(const std::uint8_t* row, int y, int begin, int end) const {
    WeighedBlob sum;
    for (int x = begin; x < end; ++x) {
      const int weight = row[x] - threshold_;
      sum.weight += weight;
      sum.weighted_x += std::int64_t{weight} * x;
    }
    sum.weighted_y = sum.weight * y;
    sum.area_px = end - begin;
    sum.cut = y == 0 || y == picture_.height_px - 1 || begin == 0 || end == picture_.width_px;
    return sum;
  }

  std::size_t root_of(std::size_t blob) {
    while (parents_[blob] != blob) blob = parents_[blob] = parents_[parents_[blob]];
    return blob;
  }

  std::size_t unite(std::size_t a, std::size_t b) {
    const auto [kept, gone] = std::minmax({root_of(a), root_of(b)});
    if (kept == gone) return kept;
    blobs_[kept].add(blobs_[gone]);
    blobs_[gone] = {};
    return parents_[gone] = kept;
  }

  const GreyView& picture_;
  std::uint8_t threshold_;
  std::vector<Run> above_, current_;
  std::vector<WeighedBlob> blobs_;
  std::vector<std::size_t> parents_;
};

}  // namespace

DotList detect_blobs(const GreyView& picture, const BlobOptions& options) {
  const BlobMap map(picture, static_cast<std::uint8_t>(options.threshold));
  std::vector<WeighedBlob> found;
  for (const WeighedBlob& blob : map.blobs())
    if (!blob.cut && blob.area_px >= options.min_area_px && blob.area_px <= options.max_area_px)
      found.push_back(blob);
  const std::size_t count =
      std::min({found.size(), static_cast<std::size_t>(options.max_dots), kMaxDots});
  const auto rank =
      [](const WeighedBlob& blob) {  // the same for the same blobs, whatever the sort does
        return std::tuple(-blob.weight, blob.weighted_y, blob.weighted_x);
      };
  std::ranges::partial_sort(found, found.begin() + static_cast<std::ptrdiff_t>(count), {}, rank);
  DotList dots;
  for (std::size_t i = 0; i < count; ++i) {
    const auto weight = static_cast<double>(found[i].weight);
    dots.push_back({static_cast<double>(found[i].weighted_x) / weight,
                    static_cast<double>(found[i].weighted_y) / weight, found[i].area_px});
  }
  return dots;
}

}  // namespace vindu
