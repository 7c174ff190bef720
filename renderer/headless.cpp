// The headless surface: EGL without a display, on Mesa's surfaceless platform or on a device chosen
// by its index.
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <sstream>
#include <thread>
#include <vector>

#include "core/error.h"
#include "renderer/surface.h"

namespace vindu {
namespace {

[[noreturn]] void fail(const std::string& step) {
  std::ostringstream code;
  code << std::hex << "0x" << eglGetError();
  throw Error(
      {step + " failed with EGL error " + code.str(), "EGL without a display",
       "install a driver with OpenGL 4.5 (Mesa: libgl1-mesa-dri), or choose another --device"});
}

/// EGL_EXT_device_base is the older name of the same (NVIDIA's driver has that alone).
bool lists_devices() {
  return epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
         epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base");
}

std::vector<EGLDeviceEXT> list_devices() {
  if (!lists_devices()) return {};
  std::array<EGLDeviceEXT, 32> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(devices.size(), devices.data(), &count)) return {};
  // No braces: an EGLDeviceEXT is a void*, and so the iterators would become the two elements.
  return std::vector<EGLDeviceEXT>(devices.begin(), devices.begin() + count);
}

EGLDisplay device_display(int index) {
  const std::vector<EGLDeviceEXT> devices = list_devices();
  if (index < 0 || index >= static_cast<int>(devices.size()))
    throw Error({"there is no EGL device " + std::to_string(index), "--device",
                 devices.empty() ? "this EGL lists no devices"
                                 : "choose 0 to " + std::to_string(devices.size() - 1)});
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[index], nullptr);
}

EGLDisplay choose_display(const HeadlessOptions& options) {
  if (options.device) return device_display(*options.device);
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  return device_display(0);
}

class HeadlessSurface final : public Surface {
 public:
  explicit HeadlessSurface(const HeadlessOptions& options)
      : refresh_(options.refresh), display_(choose_display(options)) {
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
      fail("eglInitialize");
    if (!eglBindAPI(EGL_OPENGL_API)) fail("eglBindAPI");
    constexpr std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                  4,
                                                  EGL_CONTEXT_MINOR_VERSION,
                                                  5,
                                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                  EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext for OpenGL 4.5");
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) fail("eglMakeCurrent");
  }
  HeadlessSurface(const HeadlessSurface&) = delete;
  HeadlessSurface& operator=(const HeadlessSurface&) = delete;
  ~HeadlessSurface() override {
    if (eglGetCurrentContext() == context_)  // else another surface has become current
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);  // the display is the process's, and others may use it
  }

  SizePx size() const override { return {}; }
  // The picture is on its way until the next refresh.
  void present() override {
    glFinish();
    std::this_thread::sleep_until(shown_);
    if (refresh_) shown_ = next_refresh(*refresh_, std::chrono::steady_clock::now());
  }
  bool close_wanted() const override { return false; }
  bool free() const override { return std::chrono::steady_clock::now() >= shown_; }

 private:
  std::optional<VirtualRefresh> refresh_;
  Time shown_{};  // when what was presented last is seen
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

Time next_refresh(const VirtualRefresh& refresh, Time now) {
  const double refreshes = seconds(now.time_since_epoch()) * refresh.rate_hz - refresh.phase;
  return Time(from_seconds((std::floor(refreshes) + 1 + refresh.phase) / refresh.rate_hz));
}

std::unique_ptr<Surface> make_headless_surface(const HeadlessOptions& options) {
  return std::make_unique<HeadlessSurface>(options);
}

std::string gl_description() {
  const auto text = [](GLenum name) { return reinterpret_cast<const char*>(glGetString(name)); };
  return std::string(text(GL_RENDERER)) + ", OpenGL " + text(GL_VERSION);
}

bool draws_in_software() {
  const std::string description = gl_description();
  return description.starts_with("llvmpipe") || description.starts_with("softpipe");
}

}  // namespace vindu
