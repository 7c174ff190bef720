#include "app/wall_scenes.h"

#include <fmt/format.h>

#include <tuple>
#include <vector>

#include "app/common.h"
#include "core/log.h"
#include "renderer/clips.h"

namespace vindu::app {

WallScenes::WallScenes(const Site& site, WallMaster& wall, CommandDesk& desk, Asked& asked,
                       const Asked& launched)
    : site_(site), wall_(wall), desk_(desk), asked_(asked), launched_(launched) {
  read_asked();
}

void WallScenes::read_asked() { staging_.start({asked_.model, asked_.clip, asked_.place}, site_); }

void WallScenes::show(const CommandMessage& command) {
  if (staging_.running()) return reply(command, false, "another scene is being read; ask again");
  reads_for_ = command;
  staging_.start({command.argument, command.clip, std::nullopt}, site_);
}

// Its place counts from the frame on in which the tiles change to it.
void WallScenes::follow() {
  if (!staging_.done()) return;
  try {
    const Staging::Staged staged = staging_.take();
    const auto& [model, clip, place] = staging_.wish();
    const std::uint64_t revision =
        wall_.show(path_for_tiles(model, site_), staged.sha256, place.value_or(Placement::fit));
    stages_[revision] = staged.stage;
    reply(coming_.asked, false, "another scene was asked for before all tiles had this one");
    coming_ = {reads_for_, revision, staging_.wish()};
  } catch (const Error& error) {
    if (reads_for_.request != 0)
      reply(reads_for_, false, error.what());
    else
      show_as_launched(error);
  }
  reads_for_ = {};
}

/// What the master before showed may not be there any more. Throws the error where this is what it
/// was launched with.
void WallScenes::show_as_launched(const Error& error) {
  const auto scene = [](const Asked& asked) {
    return std::tie(asked.model, asked.clip, asked.place);
  };
  if (scene(asked_) == scene(launched_)) throw error;
  log_warning("master", fmt::format("{}; it begins with what it was launched with", error.what()));
  asked_.model = launched_.model;
  asked_.clip = launched_.clip;
  asked_.place = launched_.place;
  asked_.middle_in_scene.reset();
  read_asked();
}

const Stage& WallScenes::at(Time now) {
  if (wall_.shown_scene() != shown_) {
    shown_ = wall_.shown_scene();
    if (const auto found = stages_.find(shown_); found != stages_.end()) stage_ = found->second;
    glide_.reset();
    note_shown();
    if (asked_.middle_in_scene)
      stage_.navigation.wall_from_scene.translation =
          stage_.translation_to(*asked_.middle_in_scene);
  }
  if (glide_) {
    stage_.navigation.wall_from_scene.translation = glide_->at(now);
    if (glide_->done(now)) glide_.reset();
  }
  return stage_;
}

/// The scene that was asked for is the one that is shown now.
void WallScenes::note_shown() {
  if (coming_.revision != shown_) return;
  if (coming_.asked.request != 0) {
    const auto& [model, clip, place] = coming_.wish;
    asked_.model = model;
    asked_.clip = clip;
    asked_.place = place;
    asked_.middle_in_scene.reset();
  }
  answer_show();
  coming_ = {};
}

/// Who asked for it is told which tiles cannot.
void WallScenes::answer_show() {
  std::vector<std::string> failures;
  std::size_t shows = 0;
  for (const auto& [tile, report] : wall_.tiles()) {
    if (!report.present || !report.status) continue;
    const bool failed = report.status->state == TileState::failed;
    shows += !failed;
    if (failed) failures.push_back(fmt::format("{}: {}", tile, report.status->error));
  }
  reply(coming_.asked, failures.empty(),
        failures.empty() ? ""
                         : fmt::format("{} of {} tiles show it; {}", shows, shows + failures.size(),
                                       fmt::join(failures, "; ")));
}

void WallScenes::reply(const CommandMessage& command, bool done, const std::string& text) {
  if (command.request != 0) desk_.answer(command, done, text);
}

void WallScenes::play(const std::string& clip, Time now) {
  if (stage_.model.empty()) throw Error({"shows no model yet", "the wall", "ask again"});
  stage_.clip = find_clip(stage_.clips, clip, stage_.model);
  stage_.clip_start = now;
  asked_.clip = clip;
}

void WallScenes::go_to(const std::string& argument, Time now) {
  const auto point = vec3_from(argument);
  if (!point) throw Error({"\"" + argument + "\" is no point", "goto", "write x,y,z"});
  glide_.emplace(stage_.navigation.wall_from_scene.translation, stage_.translation_to(*point), now);
  asked_.middle_in_scene = point;
}

}  // namespace vindu::app
