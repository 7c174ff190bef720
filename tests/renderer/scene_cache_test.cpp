// Packed scenes in the cache: packed once, found again, packed anew when a file has changed.
#include "renderer/scene_cache.h"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "core/sha256.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;

class SceneCacheTest : public ::testing::Test {
 protected:
  SceneCacheTest() {
    std::string pattern = (fs::temp_directory_path() / "vindu_cache_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    write("a.obj", "v 0 0 0\n");
    write("a.mtl", "newmtl a\n");
  }
  ~SceneCacheTest() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  SceneSource source(const fs::path& file) const {
    return {file, fs::file_size(file), sha256_of_file(file).value()};
  }
  /// Of a model that says so of itself; counts how often it was packed.
  PackedScene get(const SceneCache& cache, const std::string& name = "a.obj") {
    const fs::path model = folder_ / name;
    return cache.find_or_pack(model, sha256_of_file(model).value(), [&](const std::string& file) {
      ++packed_;
      PackedScene scene;
      scene.sources = {source(model), source(model.parent_path() / "a.mtl")};
      scene.scene.name = name;
      scene.scene.nodes.resize(1);
      write_scene_file(scene, file);
    });
  }
  std::size_t scenes() const {
    std::size_t count = 0;
    for (const auto& file : fs::directory_iterator(folder_ / "cache"))
      count += file.path().extension() == kSceneFileExtension;
    return count;
  }

  fs::path folder_;
  std::atomic<int> packed_ = 0;
};

TEST_F(SceneCacheTest, PacksAModelOnce) {
  const SceneCache cache(folder_ / "cache");
  EXPECT_EQ(get(cache).scene.name, "a.obj");
  EXPECT_EQ(get(cache).scene.name, "a.obj");
  EXPECT_EQ(packed_, 1);
}

TEST_F(SceneCacheTest, PacksItAgainWhenItOrAFileBesideItHasChanged) {
  const SceneCache cache(folder_ / "cache");
  get(cache);
  write("a.mtl", "newmtl b\n");
  get(cache);
  EXPECT_EQ(packed_, 2);
  write("a.obj", "v 1 0 0\n");
  get(cache);
  EXPECT_EQ(packed_, 3);
}

TEST_F(SceneCacheTest, FindsAModelThatWasCopiedWithItsFiles) {
  const SceneCache cache(folder_ / "cache");
  get(cache);
  fs::create_directory(folder_ / "copy");
  fs::copy(folder_ / "a.obj", folder_ / "copy");
  fs::copy(folder_ / "a.mtl", folder_ / "copy");
  get(cache, "copy/a.obj");
  EXPECT_EQ(packed_, 1);
}

TEST_F(SceneCacheTest, PacksOnceWhoeverAsksAtTheSameTime) {
  const SceneCache cache(folder_ / "cache");
  std::vector<std::thread> asking;
  for (int i = 0; i < 8; ++i) asking.emplace_back([&] { get(cache); });
  for (std::thread& thread : asking) thread.join();
  EXPECT_EQ(packed_, 1);
}

TEST_F(SceneCacheTest, PacksAgainWhatIsDamaged) {
  const SceneCache cache(folder_ / "cache");
  get(cache);
  std::ofstream(cache.entry_of(sha256_of_file(folder_ / "a.obj").value())) << "damage";
  EXPECT_EQ(get(cache).scene.name, "a.obj");
  EXPECT_EQ(packed_, 2);
}

TEST_F(SceneCacheTest, ForgetsTheOldestWhenItIsFull) {
  const SceneCache cache(folder_ / "cache", 1);
  get(cache);
  write("a.obj", "v 1 0 0\n");
  get(cache);
  EXPECT_EQ(scenes(), 1u);
  get(cache);
  EXPECT_EQ(packed_, 2) << "the newest is kept, however large it is";
}

TEST_F(SceneCacheTest, SaysWhatThePackerSays) {
  const SceneCache cache(folder_ / "cache");
  const auto fail = [](const std::string&) { throw Error({"is broken", "a.obj", ""}); };
  EXPECT_THROW(cache.find_or_pack(folder_ / "a.obj", std::string(64, '0'), fail), Error);
  EXPECT_EQ(scenes(), 0u);
}

TEST_F(SceneCacheTest, SaysThatItsFolderCannotBeWritten) {
  const SceneCache cache(folder_ / "a.mtl/cache");
  EXPECT_THROW(get(cache), fs::filesystem_error);
}

}  // namespace
}  // namespace vindu
