// The surface seam: where frames go. A window by GLFW, or EGL without any display. Each makes an
// OpenGL 4.5 core context and is bound to the thread that made it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/rigid3.h"
#include "renderer/canvas.h"
#include "renderer/swap_group.h"

namespace vindu {

class Surface {
 public:
  virtual ~Surface() = default;
  /// Pixels of the framebuffer to present into; headless surfaces keep the size that they were made
  /// with.
  virtual SizePx size() const = 0;
  /// Shows what was drawn into framebuffer 0 and handles the window's events.
  virtual void present() = 0;
  virtual bool close_wanted() const = 0;
  /// Whether what was presented last has reached the display: to present before waits for that.
  virtual bool free() const = 0;
  /// What its driver offers to swap together with others; empty functions: nothing.
  virtual SwapGroupCalls swap_group() const { return {}; }
};

/// A display that is not there: when it would take a new picture.
struct VirtualRefresh {
  double rate_hz = 60;
  double phase = 0;  ///< of its period, 0 to 1
};

/// The first one after `now`.
Time next_refresh(const VirtualRefresh& refresh, Time now);

struct HeadlessOptions {
  /// Index of an EGL device (a GPU); empty: Mesa's surfaceless platform, or where there is none the
  /// first device.
  std::optional<int> device;
  std::optional<VirtualRefresh> refresh{};  ///< empty: pictures are taken at any time
};

/// Throws Error that says which EGL step failed and what is there.
std::unique_ptr<Surface> make_headless_surface(const HeadlessOptions& options = {});

/// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6" of the current
/// context.
std::string gl_description();

/// Whether the current context draws on the CPU (Mesa's llvmpipe and softpipe).
bool draws_in_software();

struct WindowOptions {
  SizePx size = {1280, 720};
  std::string title = "Vindu";
  bool fullscreen = false;              ///< covers the primary monitor
  std::vector<std::string> monitors{};  ///< covers these instead, by their outputs' names
};

/// What a screen says of itself; millimetres may be invented (Xvfb) or zero (projectors).
struct ScreenReport {
  std::string name;
  SizePx size;
  int width_mm = 0;
  int height_mm = 0;
};

/// Why a reported size cannot be right, or empty: 40 to 400 dots per inch, pixels nearly square.
std::string doubt_about(const ScreenReport& screen);

enum class WindowKey { f1, f12 };

class Window : public Surface {
 public:
  /// Of the monitors that it was asked to cover, in that order: where they are in framebuffer 0.
  virtual std::vector<RectPx> monitor_places() const = 0;
  /// "HDMI-1, DP-2": all monitors of its display.
  virtual std::string monitor_names() const = 0;
  /// The screen that most of the window is on.
  virtual ScreenReport screen() const = 0;
  /// Upper left of the window's content and of that screen; pixels from the upper left of the
  /// desktop.
  virtual Vec2 content_on_screen_px() const = 0;
  /// Pointer from -1 to 1 across the content, y up; wheel turns since the last call.
  virtual Vec2 pointer() const = 0;
  virtual double take_wheel() = 0;
  /// How often the key was pressed since the last call.
  virtual int take_presses(WindowKey key) = 0;
  /// What present() does without a new picture.
  virtual void handle_events() = 0;
  /// Whether its picture was lost since the last call, by what lay over it.
  virtual bool take_damaged() = 0;
  /// Paths that were dropped onto the window since the last call.
  virtual std::optional<std::string> take_dropped_file() = 0;
};

/// Whether a window can be opened at all (DISPLAY or WAYLAND_DISPLAY).
bool has_display();

/// Throws Error where there is no display, no OpenGL 4.5, or no such monitor.
std::unique_ptr<Window> make_window(const WindowOptions& options);

}  // namespace vindu
