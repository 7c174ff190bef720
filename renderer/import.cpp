#include "renderer/import.h"

#include <assimp/commonMetaData.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <span>
#include <string_view>

#include "core/error.h"
#include "renderer/import_file.h"
#include "renderer/import_geometry.h"
#include "renderer/import_materials.h"
#include "renderer/import_nodes.h"
#include "renderer/import_opengex.h"
#include "renderer/import_skin.h"
#include "renderer/import_textures.h"

namespace vindu {
namespace {

constexpr const char* kBrokenRemedy =
    "open it in the program that made it and export it again, best as .glb";

// What Assimp 5.2 calls the loaders that need something of their own.
constexpr const char* kGltf2Loader = "glTF2 Importer";
constexpr const char* kObjLoader = "Wavefront Object Importer";
constexpr const char* kFbxLoader = "Autodesk FBX Importer";
constexpr const char* kOpenGexLoader = "Open Game Engine Exchange";
constexpr const char* kBlenderLoader = "Blender 3D Importer (http://www.blender3d.org)";
/// Whose formats have z up, and whose scenes Assimp 5.2 leaves so.
constexpr std::array kZUpLoaders = {std::string_view(kBlenderLoader),
                                    std::string_view("TrueSpace Object Importer"),
                                    std::string_view("Quick3D Importer"),
                                    std::string_view("Valve SMD Importer"),
                                    std::string_view("3D GameStudio Heightmap (HMP) Importer"),
                                    std::string_view("Terragen Heightmap Importer")};

/// Cutting a polygon into triangles takes time with the square of its corners.
constexpr unsigned kMaxPolygonCorners = 20'000;

/// Assimp's messages end in line breaks and may hold a whole line of the file.
std::string one_line(const char* message) {
  constexpr std::size_t enough = 200;
  std::string line(message);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  line.erase(line.find_last_not_of(' ') + 1);
  return line.size() > enough ? line.substr(0, enough) + "..." : line;
}

[[noreturn]] void throw_broken(const std::string& file, const std::string& why) {
  if (why.find("bad_alloc") != std::string::npos)
    throw Error({"asks for more memory than there is, or than a file of its size can need", file,
                 "reduce the model; if it is small, it is broken"});
  const bool misses_file = why.find("could not open referenced file") != std::string::npos;
  throw Error({"cannot be read as a model" + (why.empty() ? "" : " (" + why + ")"), file,
               misses_file ? "put that file beside the model" : kBrokenRemedy});
}

/// What triangulation would trip over, and how much there is of it.
void check_faces(const aiScene& source, const std::string& file, const ImportLimits& limits) {
  std::size_t triangles = 0;
  for (unsigned m = 0; m < source.mNumMeshes; ++m) {
    const aiMesh& mesh = *source.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices >= 3) triangles += face.mNumIndices - 2;
      if (face.mNumIndices > kMaxPolygonCorners)
        throw Error({"has a polygon of " + std::to_string(face.mNumIndices) + " corners", file,
                     "cut its polygons into triangles when exporting"});
      for (unsigned i = 0; face.mNumIndices > 3 && i < face.mNumIndices; ++i)
        if (face.mIndices[i] >= mesh.mNumVertices)
          throw_broken(file, "a polygon names a vertex that is not there");
    }
  }
  if (triangles > limits.triangles)
    throw Error({"has " + std::to_string(triangles) + " triangles, the limit is " +
                     std::to_string(limits.triangles),
                 file, "reduce the model or split it"});
}

/// The name of Assimp's loader, "glTF2 Importer".
std::string loader_of(const aiScene& source) {
  aiString name;
  const bool known = source.mMetaData && source.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, name);
  return known ? name.C_Str() : "";
}

/// Triangulation trusts these flags: Debian's Assimp aborts where a loader claims polygons that are
/// not there, or nothing. The scene is the importer's own; Assimp hands it out as const only.
void correct_primitive_types(const aiScene& source) {
  for (unsigned m = 0; m < source.mNumMeshes; ++m) {
    aiMesh& mesh = *source.mMeshes[m];
    const std::span<const aiFace> faces(mesh.mFaces, mesh.mNumFaces);
    constexpr auto is_polygon = [](const aiFace& face) { return face.mNumIndices > 3; };
    mesh.mPrimitiveTypes &= ~static_cast<unsigned>(aiPrimitiveType_POLYGON);
    mesh.mPrimitiveTypes |=
        std::ranges::any_of(faces, is_polygon) ? aiPrimitiveType_POLYGON : aiPrimitiveType_TRIANGLE;
  }
}

/// Notes which files a loader opens.
class NotingFiles final : public Assimp::DefaultIOSystem {
 public:
  explicit NotingFiles(std::vector<std::string>& opened) : opened_(opened) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    Assimp::IOStream* const stream = DefaultIOSystem::Open(file, mode);
    if (stream && std::ranges::find(opened_, file) == opened_.end()) opened_.emplace_back(file);
    return stream;
  }

 private:
  std::vector<std::string>& opened_;
};

/// Owned by `importer`.
const aiScene& read_with_assimp(Assimp::Importer& importer, const std::string& file,
                                const ImportLimits& limits, std::vector<std::string>& opened) {
  importer.SetIOHandler(new NotingFiles(opened));  // which it deletes
  const MemoryBudget budget(reading_budget_bytes(file));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* source = importer.ReadFile(file, 0);
  if (!source || !source->mRootNode) throw_broken(file, one_line(importer.GetErrorString()));
  check_faces(*source, file, limits);
  correct_primitive_types(*source);
  unsigned steps = aiProcess_Triangulate;
  if (loader_of(*source) != kGltf2Loader)  // glTF's transforms are ours
    steps |= aiProcess_GenUVCoords | aiProcess_TransformUVCoords;
  source = importer.ApplyPostProcessing(steps);
  if (!source) throw_broken(file, one_line(importer.GetErrorString()));
  return *source;
}

/// glTF 2.0 (3.4) and X3D (4.3.6) are in metres; Collada's loader already scales the root by the
/// file's unit; FBX states centimetres per unit, OpenGEX metres, and their loaders leave them.
std::optional<double> metres_per_unit(const aiScene& source, const std::string& file) {
  const std::string loader = loader_of(source);
  if (loader == kOpenGexLoader) return opengex_metrics(file).metres_per_unit;
  for (const char* metric :
       {kGltf2Loader, "glTF Importer", "Extensible 3D(X3D) Importer", "Collada Importer"})
    if (loader == metric) return 1.0;
  float centimetres = 0;
  if (loader == kFbxLoader && source.mMetaData &&
      source.mMetaData->Get("UnitScaleFactor", centimetres) && std::isfinite(centimetres) &&
      centimetres > 0)
    return static_cast<double>(centimetres) / 100;
  return std::nullopt;
}

/// Rows are the file's directions of right and up, and of what then comes towards the viewer.
Eigen::Matrix4f upright(const Eigen::Vector3f& right_in_file, const Eigen::Vector3f& up_in_file) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.topLeftCorner<3, 3>() << right_in_file.transpose(), up_in_file.transpose(),
      right_in_file.cross(up_in_file).transpose();
  return matrix;
}

/// Axis 0, 1 or 2 with its sign; empty where the file states none.
std::optional<Eigen::Vector3f> stated_axis(const aiMetadata& metadata, const std::string& name) {
  int axis = 0;
  int sign = 1;
  if (!metadata.Get(name, axis) || !metadata.Get(name + "Sign", sign) || axis < 0 || axis > 2)
    return std::nullopt;
  return Eigen::Vector3f::Unit(axis) * (sign < 0 ? -1.0f : 1.0f);
}

/// What turns the file's axes into ours, where Assimp 5.2 leaves that to us: FBX and OpenGEX state
/// them, and some formats' are always the same (z up).
std::optional<Eigen::Matrix4f> upright_from_file(const aiScene& source, const std::string& file) {
  const std::string loader = loader_of(source);
  if (!source.mRootNode->mTransformation.IsIdentity()) return std::nullopt;
  if (loader == kOpenGexLoader) {
    const int up = opengex_metrics(file).up_axis;
    return upright(Eigen::Vector3f::Unit(up == 0 ? 1 : 0), Eigen::Vector3f::Unit(up));
  }
  if (std::ranges::find(kZUpLoaders, loader) != kZUpLoaders.end())
    return upright(Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ());
  if (loader != kFbxLoader || !source.mMetaData) return std::nullopt;
  const auto right = stated_axis(*source.mMetaData, "CoordAxis");
  const auto up = stated_axis(*source.mMetaData, "UpAxis");
  if (!right || !up || right->dot(*up) != 0) return std::nullopt;
  return upright(*right, *up);
}

void warn_of(const MeshLosses& losses, std::vector<std::string>& warnings) {
  const auto warn = [&](std::size_t count, const char* what) {
    if (count > 0) warnings.push_back(std::to_string(count) + what);
  };
  warn(losses.broken_triangles, " broken triangles are left out");
  warn(losses.points_and_lines, " points and lines are left out");
  warn(losses.morphed_meshes, " meshes have morph targets, which do not move");
}

MaterialStyle style_of(const std::string& loader) {
  if (loader == kGltf2Loader) return MaterialStyle::gltf;
  return loader == kObjLoader ? MaterialStyle::obj : MaterialStyle::legacy;
}

/// The first node that shows each of Assimp's meshes, or -1: what no node shows costs nothing.
std::vector<int> first_nodes(const aiScene& source, const ImportedNodes& nodes) {
  std::vector<int> first(source.mNumMeshes, -1);
  for (const MeshUse& use : nodes.meshes)
    if (use.source_mesh < first.size() && first[use.source_mesh] < 0)
      first[use.source_mesh] = use.node;
  return first;
}

/// Where a skinned mesh stands is up to its joints: several nodes would show it in one place.
void hang_meshes(const ImportedNodes& imported, const std::vector<int>& mesh_of_source,
                 Scene& scene) {
  scene.nodes = imported.nodes;
  std::vector<bool> shown(scene.meshes.size(), false);
  for (const auto& [node, source_mesh] : imported.meshes) {
    if (source_mesh >= mesh_of_source.size() || mesh_of_source[source_mesh] < 0) continue;
    const auto mesh = static_cast<std::size_t>(mesh_of_source[source_mesh]);
    if (scene.meshes[mesh].skinned && shown[mesh]) continue;
    shown[mesh] = true;
    scene.nodes[static_cast<std::size_t>(node)].meshes.push_back(static_cast<int>(mesh));
  }
}

/// Fills meshes, vertices, indices, skin, materials and textures; returns the scene's mesh for each
/// of Assimp's, or -1.
std::vector<int> import_meshes(const aiScene& source, const std::string& file,
                               const ImportLimits& limits, const ImportedNodes& nodes,
                               ImportResult& result) {
  Scene& scene = result.scene;
  const std::string loader = loader_of(source);
  const MaterialStyle style = style_of(loader);
  TextureImporter textures(source, std::filesystem::path(file).parent_path(), limits.texture_pixels,
                           result.warnings);
  MaterialImporter materials(source, style, textures, result.warnings);
  MeshLosses losses;
  std::vector<int> mesh_of_source(source.mNumMeshes, -1);
  SkinImporter skins(nodes.by_name, scene.joints);
  const std::vector<int> node_of_source = first_nodes(source, nodes);
  for (unsigned i = 0; i < source.mNumMeshes; ++i) {
    if (node_of_source[i] < 0) continue;
    const aiMesh& source_mesh = *source.mMeshes[i];
    const ImportedMaterial material =
        materials.import(source_mesh.mMaterialIndex, source_mesh.HasVertexColors(0));
    const std::vector<Influences> influences = skins.read(source_mesh, node_of_source[i]);
    const MeshOptions options = {.uv_channels = material.uv_channels,
                                 .own_normals = loader == kBlenderLoader,
                                 .normal_map = material.normal_map,
                                 .influences = influences};
    std::optional<Mesh> mesh = append_mesh(source_mesh, options, scene, losses);
    if (!mesh) continue;
    mesh->material = material.index;
    mesh_of_source[i] = static_cast<int>(scene.meshes.size());
    scene.meshes.push_back(*mesh);
  }
  scene.colours = style == MaterialStyle::gltf ? ColourCoding::linear : ColourCoding::srgb;
  scene.materials = materials.take();
  scene.textures = textures.take();
  result.files.insert(result.files.end(), textures.files().begin(), textures.files().end());
  warn_of(losses, result.warnings);
  skins.warn(result.warnings);
  if (scene.indices.empty() && losses.broken_triangles > 0)
    throw_broken(file, "all its triangles have vertices that are not finite or not there");
  return mesh_of_source;
}

/// Whether any triangle is more than a line, for the length of its longest side.
bool has_area(const Scene& scene) {
  for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const auto corner = [&](std::size_t which) -> Eigen::Vector3d {
      return scene.vertices[scene.indices[i + which]].position_in_node.cast<double>();
    };
    const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
    const double longest = std::max({a.norm(), b.norm(), (a - b).norm()});
    if (a.cross(b).norm() > 1e-9 * longest * longest) return true;
  }
  return false;
}

/// A picture needs triangles, and triangles that are somewhere.
void check_drawable(const Scene& scene, const std::string& file) {
  if (scene.indices.empty())
    throw Error({"has no triangles to draw", file,
                 "export it as a mesh; points, lines and curves are not drawn"});
  const Box3f bounds = bounds_in_scene(scene);
  if (bounds.isEmpty() || !bounds.diagonal().allFinite() || !bounds.center().allFinite())
    throw_broken(file, "its size is not finite");
  if (!(bounds.diagonal().norm() > 0)) throw_broken(file, "all its points are in one place");
  if (!has_area(scene)) throw_broken(file, "its triangles are but lines");
}

ImportResult converted(const aiScene& source, const std::string& file, const ImportLimits& limits,
                       std::vector<std::string> opened) {
  ImportResult result{.scene = {}, .warnings = {}, .files = std::move(opened)};
  Scene& scene = result.scene;
  scene.name = std::filesystem::path(file).stem().string();
  const ImportedNodes nodes = import_nodes(source, result.warnings);
  hang_meshes(nodes, import_meshes(source, file, limits, nodes, result), scene);
  scene.animations = import_animations(source, nodes.by_name);
  scene.metres_per_unit = metres_per_unit(source, file);
  if (const std::optional<Eigen::Matrix4f> turned = upright_from_file(source, file))
    scene.nodes.front().parent_from_node = *turned;
  check_drawable(scene, file);
  return result;
}

}  // namespace

ImportResult import_scene(const std::string& file, const ImportLimits& limits) {
  check_model_file(file, limits.file_bytes);
  try {
    Assimp::Importer importer;
    std::vector<std::string> opened = {file};
    const aiScene& source = read_with_assimp(importer, file, limits, opened);
    return converted(source, file, limits, std::move(opened));
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw_broken(file, one_line(error.what()));
  }
}

}  // namespace vindu
