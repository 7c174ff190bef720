#include "tracker/ir_camera/video_input.h"

#include <dlfcn.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "tracker/ir_camera/video_module.h"

namespace vindu {
namespace {

using OpenVideo = decltype(&vindu_open_video);

/// Where the program was installed to, else where it was built.
std::filesystem::path module_file() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  auto installed = program.parent_path() / ".." / VINDU_INSTALLED_MODULES / "vindu_video.so";
  if (std::filesystem::exists(installed, error)) return installed;
  return std::filesystem::path(VINDU_BUILT_MODULES) / "vindu_video.so";
}

/// Never unloaded: its inputs may live as long as the program.
OpenVideo load_module(const std::string& camera) {
  void* module = dlopen(module_file().c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* function = module ? dlsym(module, "vindu_open_video") : nullptr;
  if (!function)
    throw Error({std::string("video input cannot be loaded: ") + dlerror(), "camera " + camera,
                 "install libopencv-dev and Vindu's vindu_video.so"});
  return reinterpret_cast<OpenVideo>(function);
}

/// What the file system alone knows; clearer than what OpenCV would say.
void check_device(const std::string& device, const std::string& where) {
  if (::access(device.c_str(), F_OK) != 0)
    throw Error({"there is no " + device, where,
                 "plug the camera in; `ls /dev/video*` shows what there is"});
  if (::access(device.c_str(), R_OK | W_OK) != 0)
    throw Error({device + " may not be read and written", where,
                 "add yourself to its group (`sudo usermod -aG video $USER`) and log in again"});
}

void check_file(const std::string& file, const std::string& where) {
  if (file.find('%') != std::string::npos) return;  // a sequence of pictures
  if (std::error_code error; !std::filesystem::is_regular_file(file, error))
    throw Error({"there is no file " + file, where,
                 "give the path of a video, relative to the wall file, or device for a camera"});
  if (::access(file.c_str(), R_OK) != 0)
    throw Error({file + " may not be read", where, "give yourself the right to read it"});
}

}  // namespace

std::unique_ptr<VideoInput> open_video(VideoConfig config, const std::string& camera) {
  const std::string where = "camera " + camera;
  if (config.device.find_first_not_of("0123456789") == std::string::npos && !config.device.empty())
    config.device = "/dev/video" + config.device;
  if (config.file.empty())
    check_device(config.device, where);
  else
    check_file(config.file, where);
  std::string problem;
  std::unique_ptr<VideoInput> input(load_module(camera)(config, problem));
  if (!input) throw Error(where + ": " + problem);
  return input;
}

}  // namespace vindu
