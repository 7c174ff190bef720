// vindu pack: a model as a packed scene, which loads at once: into the cache, where every other
// command finds it, or into a file.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/packer.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/sha256.h"
#include "renderer/clips.h"
#include "renderer/scene_cache.h"

namespace vindu::app {
namespace {

struct PackCommand {
  std::vector<std::string> models;
  std::string out;
  std::optional<double> memory_mib;
  std::optional<double> seconds;
  bool here = false;
  bool json = false;
};

/// It uses all cores, and a wall that runs beside it needs them more.
constexpr int kBehindOthers = 10;

void limit_memory(double memory_mib) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const auto bytes = static_cast<rlim_t>(memory_mib * 1048576);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
#else
  static_cast<void>(memory_mib);
#endif
}

PackLimits limits_of(const PackCommand& command, const std::string& model) {
  PackLimits limits = limits_for(model);
  if (command.memory_mib)
    limits.memory_bytes = static_cast<std::uintmax_t>(*command.memory_mib * 1048576);
  if (command.seconds) limits.time = std::chrono::seconds(static_cast<long long>(*command.seconds));
  return limits;
}

/// Returns the file.
std::string pack_one(const PackCommand& command, const std::string& model) {
  if (command.here) {
    setpriority(PRIO_PROCESS, 0, kBehindOthers);
    if (command.memory_mib) limit_memory(*command.memory_mib);
    write_scene_file(import_packed(model), command.out);
    return command.out;
  }
  if (!command.out.empty()) {
    pack_apart(model, command.out, limits_of(command, model));
    return command.out;
  }
  packed_scene(model);
  const auto sha256 = sha256_of_file(model);
  return SceneCache(SceneCache::usual_folder()).entry_of(sha256.value_or(""));
}

double mebibytes_of(const std::string& file) {
  return static_cast<double>(std::filesystem::file_size(file)) / 1048576;
}

std::string json_list(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  for (const std::string& text : texts) quoted.push_back(json_text(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

void say_as_json(const std::string& model, const std::string& file, Duration took) {
  const PackedScene packed = read_scene_file(file);
  const SceneOutline& scene = packed.scene;
  std::vector<std::string> clips;
  for (const auto& animation : scene.animations)
    clips.push_back(fmt::format(R"({{"name": {}, "seconds": {:.3f}}})", json_text(animation.name),
                                animation.duration_s));
  fmt::print(R"({{"model": {}, "file": {}, "triangles": {}, "textures": {}, "clips": [{}], )"
             R"("mib": {:.2f}, "seconds": {:.3f}, "warnings": {}}})"
             "\n",
             json_text(model), json_text(file), scene.triangle_count(), packed.textures.size(),
             fmt::join(clips, ", "), mebibytes_of(file), seconds(took), json_list(packed.warnings));
}

void say(const std::string& model, const std::string& file, Duration took) {
  const PackedScene packed = read_scene_file(file);
  const SceneOutline& scene = packed.scene;
  fmt::print("{}: {} triangles, {} textures, {} animations; {:.1f} MiB in {:.2f} s: {}\n", model,
             scene.triangle_count(), packed.textures.size(), scene.animations.size(),
             mebibytes_of(file), seconds(took), file);
  std::vector<std::string> clips = clip_names(scene);
  for (std::size_t i = 0; i < clips.size(); ++i)
    clips[i] = (clips[i].empty() ? "(no name)" : clips[i]) +
               fmt::format(" ({:.2f} s)", scene.animations[i].duration_s);
  if (!clips.empty()) fmt::print("  clips: {}\n", listed(clips));
  for (const std::string& warning : packed.warnings) fmt::print("  {}\n", warning);
}

int pack(const PackCommand& command) {
  if (!command.out.empty() && command.models.size() > 1)
    throw Error({"several models cannot go into one file", "--out", "pack them one by one"});
  if (command.here && command.out.empty())
    throw Error({"needs a file to write", "--here", "add --out FILE"});
  const MonotonicClock clock;
  int failed = 0;
  for (const std::string& model : command.models) try {
      const Time start = clock.now();
      const std::string file = pack_one(command, model);
      if (!command.here) (command.json ? say_as_json : say)(model, file, clock.now() - start);
    } catch (const Error& error) {
      if (command.models.size() == 1) throw;
      std::fprintf(stderr, "vindu: %s\n", error.what());
      ++failed;
    }
  return failed == 0 ? 0 : 1;
}

}  // namespace

void add_pack(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<PackCommand>();
  CLI::App* app = parent.add_subcommand(
      "pack", "Makes models ready to be loaded at once; all commands do so by themselves");
  app->add_option("MODEL", command->models, "Any models that Assimp reads")->required();
  app->add_option("--out", command->out,
                  "The packed scene (.vscene), which loads like a model anywhere (default: the\n"
                  "cache, where other commands find it)")
      ->type_name("FILE");
  app->add_option("--memory-mib", command->memory_mib,
                  "What reading it may take (default: 4096, more for files above 136 MiB)")
      ->check(between(16, 1e7));
  app->add_option("--seconds", command->seconds,
                  "And how long (default: 60, and two for each MiB of the file)")
      ->check(between(1, 1e6));
  app->add_flag("--json", command->json, "A line of JSON for each model");
  app->add_flag("--here", command->here, "In this process: a broken file may end it");
  app->footer(
      "\nExamples:\n"
      "  vindu pack model.glb\n"
      "  vindu pack building.ifc --seconds 3600 --out building.vscene\n");
  app->callback([command, &chosen] { chosen = [command] { return pack(*command); }; });
}

}  // namespace vindu::app
