// The scenes of a running wall, as its master sees them: one is shown, another may be read or be on
// its way to the tiles. Their places and clips are kept with what the wall was asked for.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "app/stage.h"
#include "cluster/console.h"
#include "cluster/wall_master.h"
#include "core/asked.h"
#include "core/error.h"

namespace vindu::app {

class WallScenes {
 public:
  /// Begins to read what `asked` names, or, where that cannot be read, what `launched` does. What
  /// is passed must outlive it; `asked` follows what is shown.
  WallScenes(const Site& site, WallMaster& wall, CommandDesk& desk, Asked& asked,
             const Asked& launched);

  /// Reads another one beside the frames that go on; answered when the tiles show it, or cannot.
  void show(const CommandMessage& command);
  bool reading() const { return staging_.running(); }
  /// One that is read goes out to the tiles. Throws Error where the first one cannot be read.
  void follow();

  /// Of the scene that is shown now.
  const Stage& at(Time now);
  /// From its beginning, in the frames from now on. Throws Error where the scene has no such clip.
  void play(const std::string& clip, Time now);
  /// A point "x,y,z" of the scene to the middle of the wall, within a second. Throws Error for what
  /// is no point.
  void go_to(const std::string& argument, Time now);

 private:
  /// That tiles load.
  struct Coming {
    CommandMessage asked{};  // answered when they show it; request 0: the first one
    std::uint64_t revision = 0;
    Staging::Wish wish{};
  };

  void read_asked();
  void show_as_launched(const Error& error);
  void note_shown();
  void answer_show();
  void reply(const CommandMessage& command, bool done, const std::string& text);

  const Site& site_;
  WallMaster& wall_;
  CommandDesk& desk_;
  Asked& asked_;
  const Asked& launched_;
  Staging staging_;
  CommandMessage reads_for_;  // that is being read; request 0: the first one
  Coming coming_;
  std::map<std::uint64_t, Stage> stages_;  // by scene
  std::uint64_t shown_ = 0;
  Stage stage_;
  std::optional<Glide> glide_;  // of the stage's wall_from_scene
};

}  // namespace vindu::app
