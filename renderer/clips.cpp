#include "renderer/clips.h"

#include <algorithm>
#include <charconv>

#include "core/error.h"

namespace vindu {
namespace {

/// Written whole as a number from 1 to `most`, less one; else -1.
int number_of(const std::string& wish, std::size_t most) {
  std::size_t number = 0;
  const char* const end = wish.data() + wish.size();
  const auto [stop, error] = std::from_chars(wish.data(), end, number);
  const bool good = error == std::errc() && stop == end && number >= 1 && number <= most;
  return good ? static_cast<int>(number - 1) : -1;
}

}  // namespace

std::vector<std::string> clip_names(const SceneOutline& scene) {
  std::vector<std::string> names;
  for (const Animation& animation : scene.animations) names.push_back(animation.name);
  return names;
}

std::string listed(const std::vector<std::string>& clips) {
  std::string text;
  for (std::size_t i = 0; i < clips.size(); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(i + 1) + " " +
            (clips[i].empty() ? "(no name)" : clips[i]);
  return text;
}

int find_clip(const std::vector<std::string>& clips, const std::string& wish,
              const std::string& model) {
  if (wish.empty()) return 0;
  if (const auto named = std::ranges::find(clips, wish); named != clips.end())
    return static_cast<int>(named - clips.begin());
  if (const int number = number_of(wish, clips.size()); number >= 0) return number;
  if (wish == "rest") return kAtRest;
  if (clips.empty())
    throw Error({"has no clips, so none \"" + wish + "\"", model, "its model stays at rest"});
  throw Error({"has no clip \"" + wish + "\"", model, "choose " + listed(clips) + ", or rest"});
}

}  // namespace vindu
