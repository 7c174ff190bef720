// The window surface, by GLFW.
#include <epoxy/gl.h>
// epoxy first: GLFW must not bring OpenGL headers of its own
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "renderer/gl/handle.h"
#include "renderer/surface.h"

namespace vindu {
namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

/// GLFW's own life: initialised once, ended with the last window.
struct Glfw {
  Glfw() {
    glfwInitHint(GLFW_JOYSTICK_HAT_BUTTONS, GLFW_FALSE);
    if (!glfwInit())
      throw Error({"cannot open a window: " + last_glfw_error(), "display",
                   "set DISPLAY, or draw without a window: vindu render"});
  }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  ~Glfw() { glfwTerminate(); }
};

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

long overlap(const Rect& a, const Rect& b) {
  const long width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const long height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return width > 0 && height > 0 ? width * height : 0;
}

Rect rect_of(GLFWmonitor* monitor) {
  Rect rect;
  glfwGetMonitorPos(monitor, &rect.x, &rect.y);
  if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) {
    rect.width = mode->width;
    rect.height = mode->height;
  }
  return rect;
}

std::vector<GLFWmonitor*> all_monitors() {
  int count = 0;
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  return {monitors, monitors + count};
}

std::string names_of_monitors() {
  std::string names;
  for (GLFWmonitor* monitor : all_monitors())
    names += (names.empty() ? "" : ", ") + std::string(glfwGetMonitorName(monitor));
  return names;
}

GLFWmonitor* monitor_named(const std::string& name) {
  for (GLFWmonitor* monitor : all_monitors())
    if (glfwGetMonitorName(monitor) == name) return monitor;
  throw Error({"there is no monitor \"" + name + "\"", "monitor",
               "name one that is connected here: " + names_of_monitors()});
}

Rect around(const std::vector<Rect>& rects) {
  Rect all = rects.front();
  for (const Rect& rect : rects) {
    const int right = std::max(all.x + all.width, rect.x + rect.width),
              bottom = std::max(all.y + all.height, rect.y + rect.height);
    all.x = std::min(all.x, rect.x);
    all.y = std::min(all.y, rect.y);
    all.width = right - all.x;
    all.height = bottom - all.y;
  }
  return all;
}

template <class Function>
Function* glx_function(const char* name) {
  return reinterpret_cast<Function*>(glfwGetProcAddress(name));
}

/// For the current context's window, where GLX made it: with Xlib's Bool as int, its Display as
/// void, and XIDs as unsigned long, as they are in its binary interface.
SwapGroupCalls calls_of_glx() {
  if (!glfwExtensionSupported("GLX_NV_swap_group")) return {};
  const auto display = glx_function<void*()>("glXGetCurrentDisplay");
  const auto drawable = glx_function<unsigned long()>("glXGetCurrentDrawable");
  const auto query_max =
      glx_function<int(void*, int, unsigned*, unsigned*)>("glXQueryMaxSwapGroupsNV");
  const auto join = glx_function<int(void*, unsigned long, unsigned)>("glXJoinSwapGroupNV");
  const auto bind = glx_function<int(void*, unsigned, unsigned)>("glXBindSwapBarrierNV");
  if (!display || !drawable || !query_max || !join || !bind) return {};
  constexpr int kScreen = 0;  // X screens beyond the first are a thing of the past
  return {.query_max =
              [=](unsigned& groups, unsigned& barriers) {
                return query_max(display(), kScreen, &groups, &barriers) != 0;
              },
          .join = [=](unsigned group) { return join(display(), drawable(), group) != 0; },
          .bind = [=](unsigned group,
                      unsigned barrier) { return bind(display(), group, barrier) != 0; }};
}

class GlfwWindow final : public Window {
 public:
  explicit GlfwWindow(const WindowOptions& options) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    open(options);
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    glfwSetScrollCallback(
        window_, [](GLFWwindow* window, double, double turns) { self(window).wheel_ += turns; });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
      if (action != GLFW_PRESS) return;
      if (key == GLFW_KEY_F1) ++self(window).presses_[WindowKey::f1];
      if (key == GLFW_KEY_F12) ++self(window).presses_[WindowKey::f12];
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { self(window).damaged_ = true; });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
      if (count > 0) self(window).dropped_ = paths[0];
    });
  }
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;
  ~GlfwWindow() override {
    swapped_ = {};  // before its context goes
    glfwDestroyWindow(window_);
  }

  std::vector<RectPx> monitor_places() const override {
    std::vector<RectPx> places;
    for (const Rect& rect : covered_) {
      const Rect all = around(covered_);
      const int from_bottom = all.y + all.height - rect.y - rect.height;
      places.push_back({rect.x - all.x, from_bottom, {rect.width, rect.height}});
    }
    return places;
  }
  std::string monitor_names() const override { return names_of_monitors(); }
  SizePx size() const override {
    SizePx size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return size;
  }
  void present() override {
    glfwSwapBuffers(window_);
    swapped_ = gl::Fence::here();
    handle_events();
  }
  void handle_events() override {
    glfwPollEvents();
    if (glfwGetKey(window_, GLFW_KEY_ESCAPE) == GLFW_PRESS)
      glfwSetWindowShouldClose(window_, GLFW_TRUE);
  }
  SwapGroupCalls swap_group() const override { return calls_of_glx(); }
  bool close_wanted() const override { return glfwWindowShouldClose(window_); }
  bool free() const override { return swapped_.passed(); }

  ScreenReport screen() const override {
    GLFWmonitor* monitor = current_monitor();
    if (!monitor) return {};
    const Rect rect = rect_of(monitor);
    ScreenReport report{glfwGetMonitorName(monitor), {rect.width, rect.height}};
    glfwGetMonitorPhysicalSize(monitor, &report.width_mm, &report.height_mm);
    return report;
  }
  Vec2 content_on_screen_px() const override {
    const Rect window = window_rect();
    GLFWmonitor* monitor = current_monitor();
    const Rect screen = monitor ? rect_of(monitor) : Rect{};
    return {window.x - screen.x, window.y - screen.y};
  }
  Vec2 pointer() const override {
    double x = 0, y = 0;
    int width = 1, height = 1;
    glfwGetCursorPos(window_, &x, &y);
    glfwGetWindowSize(window_, &width, &height);
    return {std::clamp(2 * x / std::max(width, 1) - 1, -1.0, 1.0),
            std::clamp(1 - 2 * y / std::max(height, 1), -1.0, 1.0)};
  }
  double take_wheel() override { return std::exchange(wheel_, 0); }
  bool take_damaged() override { return std::exchange(damaged_, false); }
  int take_presses(WindowKey key) override { return std::exchange(presses_[key], 0); }
  std::optional<std::string> take_dropped_file() override {
    return std::exchange(dropped_, std::nullopt);
  }

 private:
  /// One monitor is covered as full screens are; several by one window without a frame, so that
  /// they swap together.
  void open(const WindowOptions& options) {
    std::vector<GLFWmonitor*> monitors;
    for (const std::string& name : options.monitors) monitors.push_back(monitor_named(name));
    if (monitors.empty() && options.fullscreen) monitors.push_back(glfwGetPrimaryMonitor());
    for (GLFWmonitor* monitor : monitors) covered_.push_back(rect_of(monitor));
    const bool spans = monitors.size() > 1;
    glfwWindowHint(GLFW_DECORATED, !spans);
    glfwWindowHint(GLFW_FLOATING, spans);
    glfwWindowHint(GLFW_VISIBLE, !spans);
    const Rect place =
        covered_.empty() ? Rect{0, 0, options.size.width, options.size.height} : around(covered_);
    window_ = glfwCreateWindow(place.width, place.height, options.title.c_str(),
                               monitors.size() == 1 ? monitors.front() : nullptr, nullptr);
    if (!window_)
      throw Error({"cannot open a window: " + last_glfw_error(), "display",
                   "OpenGL 4.5 is needed; draw without a window: vindu render"});
    if (!monitors.empty()) glfwSetInputMode(window_, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    if (!spans) return;
    glfwSetWindowPos(window_, place.x, place.y);
    glfwShowWindow(window_);
  }
  static GlfwWindow& self(GLFWwindow* window) {
    return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
  }
  Rect window_rect() const {
    Rect rect;
    glfwGetWindowPos(window_, &rect.x, &rect.y);
    glfwGetWindowSize(window_, &rect.width, &rect.height);
    return rect;
  }
  GLFWmonitor* current_monitor() const {
    GLFWmonitor* best = nullptr;
    long most = -1;
    for (GLFWmonitor* monitor : all_monitors())
      if (const long shared = overlap(window_rect(), rect_of(monitor)); shared > most) {
        most = shared;
        best = monitor;
      }
    return best;
  }

  Glfw glfw_;
  std::vector<Rect> covered_;  // of the desktop, y down
  GLFWwindow* window_ = nullptr;
  gl::Fence swapped_;
  double wheel_ = 0;
  std::map<WindowKey, int> presses_;
  bool damaged_ = false;
  std::optional<std::string> dropped_;
};

}  // namespace

std::string doubt_about(const ScreenReport& screen) {
  if (screen.width_mm <= 0 || screen.height_mm <= 0) return "it reports no size";
  const double dpi_x = 25.4 * screen.size.width / screen.width_mm;
  const double dpi_y = 25.4 * screen.size.height / screen.height_mm;
  const std::string shown =
      std::to_string(screen.width_mm) + " x " + std::to_string(screen.height_mm) + " mm";
  if (std::abs(dpi_x / dpi_y - 1) > 0.1)
    return "its " + shown + " would make pixels that are not square";
  if (dpi_x < 40 || dpi_x > 400)
    return "its " + shown + " would be " + std::to_string(std::lround(dpi_x)) + " dpi";
  const auto invented_mm = [](int px) { return px * 25.4 / 96; };
  if (std::abs(screen.width_mm - invented_mm(screen.size.width)) < 0.6 &&
      std::abs(screen.height_mm - invented_mm(screen.size.height)) < 0.6)
    return "its " + shown + " is just what 96 dpi gives, which display servers invent";
  return "";
}

bool has_display() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

std::unique_ptr<Window> make_window(const WindowOptions& options) {
  if (!has_display())
    throw Error({"there is no display to open a window on", "DISPLAY",
                 "log in to one, or draw pictures: vindu render"});
  return std::make_unique<GlfwWindow>(options);
}

}  // namespace vindu
