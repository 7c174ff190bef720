// Seeds for scene_fuzz.cpp: the contents of good packed scenes, as files in a folder.
#include <fstream>
#include <string>

#include "renderer/scene_archive.h"
#include "tests/renderer/skinned_scenes.h"

int main(int count, char** words) {
  if (count != 2) return 2;
  using namespace vindu;
  Scene textured = testing::square_scene(Material{});
  textured.textures = {Image::filled(4, 2, {1, 2, 3, 4})};
  textured.materials[0].texture(TextureRole::normal).image = 0;
  int number = 0;
  for (const Scene& scene : {textured, testing::stalk_scene(Material{}), Scene{}}) {
    SceneWriter writer;
    writer(pack(scene));
    const auto bytes = writer.take();
    std::ofstream stream(std::string(words[1]) + "/" + std::to_string(number++), std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    if (!stream) return 1;
  }
  return 0;
}
