// A model on one screen: a window that looks through the screen into the scene, and what one can do
// to it. Bound to the render thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/background.h"
#include "app/caption.h"
#include "app/emulation.h"
#include "app/stage.h"
#include "app/window_statistics.h"
#include "core/error.h"
#include "core/frame_state.h"
#include "renderer/pattern.h"
#include "renderer/scene_preparation.h"
#include "renderer/scene_renderer.h"
#include "renderer/surface.h"

namespace vindu::app {

struct ViewOptions {
  std::string model;
  std::string wall_file;
  std::string path_file;
  std::string out = "out";
  std::string clip;
  std::optional<Placement> place;
  std::optional<Vec3> eye;
  std::optional<double> seconds;
  std::optional<int> device;
  std::vector<double> screen_mm;
  std::uint64_t seed = 1;
  Pattern pattern = Pattern::none;
  bool mouse = false;
  bool track = false;
  bool fullscreen = false;
  bool json = false;
  EmulationOptions emulation;
};

/// The site of one screen: the file's, or made from the screen's size. Throws Error for a file of
/// several tiles.
Site screen_site(const ViewOptions& options, const ScreenReport& screen);

/// The pose of the stage's clip at that time, if it has one, put on the scene's nodes.
void pose_on(const Stage& stage, double animation_time_s, GpuScene& scene);

/// Fitted to the content of a window. `model` may be another one than the options', whose clip it
/// then need not have.
LoadedScene load_before(const std::string& model, const ViewOptions& options, const Site& site,
                        const TileCorners& content, const std::stop_token& stop = {});

class Viewer {
 public:
  /// The options and the window must outlive it.
  Viewer(const ViewOptions& options, Window& window);

  const Site& site() const { return site_; }
  WindowStatistics& statistics() { return statistics_; }

  /// Reads the first model while the window stays alive; false: it was closed before. Throws Error
  /// for a model that cannot be read.
  bool load_first();
  /// Of the model that is shown.
  const Stage& stage() const { return shown_->stage; }

  /// Whether a frame would look other than the one that is shown.
  bool due(FrameState state);
  /// How many pictures could not be drawn: 0, or 1 where the eye is behind the screen.
  int draw(const FrameState& state);
  /// Once a frame: a model dropped on the window replaces the shown one when it is read; one that
  /// cannot be read changes nothing. The one that is dropped last counts. Pictures are saved as F12
  /// asks.
  void follow_wishes();
  /// Waits for a picture that is being saved.
  void finish();

 private:
  struct Shown {
    GpuScene scene;
    Stage stage;
    std::string model;
  };
  /// A model that was read, on its way to the GPU.
  struct Coming {
    Stage stage;
    ScenePreparation scene;

    explicit Coming(LoadedScene loaded)
        : stage(stage_of(loaded)), scene(std::move(loaded.packed), live_look()) {}
  };
  /// While the first model is read.
  struct WaitingPage {
    SizePx size;
    std::chrono::seconds waited{-1};

    bool operator==(const WaitingPage&) const = default;
  };
  /// What a picture in the window depends on.
  struct Showing {
    std::uint64_t content_hash = 0;
    int models = -1;
    SizePx size;
    Vec3 lower_left_in_wall = Vec3::Zero();
    std::string caption;
    bool statistics = false;

    bool operator==(const Showing&) const = default;
  };

  void follow_drops();
  void follow_saving();
  void start(const std::string& model);
  bool arrived();
  void change();
  void refuse(const Error& error);
  void save(Image picture);
  void draw(const WaitingPage& page);
  SizePx picture_size() const;
  void put_into_window(Picture& picture);
  Tile content_tile(SizePx size) const;

  const ViewOptions& options_;
  Window& window_;
  Site site_;
  SceneRenderer renderer_;
  PatternPainter patterns_;
  WindowStatistics statistics_;
  ShadowMap shadow_;
  std::optional<Shown> shown_;
  Showing showing_;
  Caption caption_;
  std::string model_;  // that is being read, or was read last
  std::optional<std::string> dropped_;
  Background<LoadedScene> reading_;
  std::optional<Coming> coming_;
  Background<std::filesystem::path> saving_;
  std::unique_ptr<Canvas> canvas_;
  std::unique_ptr<Picture> picture_;
  int models_ = 0;  // that have been shown
  bool picture_wanted_ = false;
};

}  // namespace vindu::app
