// Levels of detail: whichever of them are shown, the surface is whole, and as near to full detail
// as they say.
#include "renderer/levels.h"

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <random>
#include <set>

#include "bench/detail/scan.h"
#include "renderer/chunks.h"
#include "renderer/detail.h"
#include "renderer/surface_distance.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;

Scene with_levels(Scene scene) {
  cut_into_chunks(scene);
  make_levels(scene);
  return scene;
}

const Scene& scan() {
  static const Scene scene = with_levels(scan_scene({.triangles = 20000}));
  return scene;
}

using Fine = std::function<bool(const Coarsening&)>;

Fine within(float error) {
  return [error](const Coarsening& coarsening) { return coarsening.error_in_node <= error; };
}

/// Every surface at one level: the coarsest that is fine.
std::vector<Mesh> chosen(const Scene& scene, const Fine& fine) {
  std::vector<Mesh> meshes;
  for (const Mesh& mesh : scene.meshes)
    if ((mesh.made_by < 0 || fine(scene.coarsenings[mesh.made_by])) &&
        (mesh.replaced_by < 0 || !fine(scene.coarsenings[mesh.replaced_by])))
      meshes.push_back(mesh);
  return meshes;
}

std::vector<std::uint32_t> indices_of(const Scene& scene, const std::vector<Mesh>& meshes) {
  std::vector<std::uint32_t> indices;
  for (const Mesh& mesh : meshes)
    indices.insert(indices.end(), scene.indices.begin() + mesh.first_index,
                   scene.indices.begin() + mesh.first_index + mesh.index_count);
  return indices;
}

using Place = std::array<float, 3>;

Place place_of(const Scene& scene, std::uint32_t vertex) {
  const Eigen::Vector3f& position = scene.vertices[vertex].position_in_node;
  return {position.x(), position.y(), position.z()};
}

/// Edges that no triangle on their other side has: of a closed surface none.
std::size_t open_edges(const Scene& scene, const std::vector<std::uint32_t>& indices) {
  std::map<std::pair<Place, Place>, int> balance;
  for (std::size_t i = 0; i < indices.size(); i += 3)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Place from = place_of(scene, indices[i + corner]);
      const Place to = place_of(scene, indices[i + (corner + 1) % 3]);
      if (from < to)
        ++balance[{from, to}];
      else
        --balance[{to, from}];
    }
  return static_cast<std::size_t>(
      std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

/// Points anywhere on the triangles of full detail.
std::vector<Eigen::Vector3f> points_on_full_detail(const Scene& scene, int count) {
  const std::vector<std::uint32_t> indices =
      indices_of(scene, chosen(scene, [](const Coarsening&) { return false; }));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> share;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    const std::size_t at = 3 * (random() % (indices.size() / 3));
    float u = share(random), v = share(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto corner = [&](std::size_t k) {
      return scene.vertices[indices[at + k]].position_in_node;
    };
    points.emplace_back((1 - u - v) * corner(0) + u * corner(1) + v * corner(2));
  }
  return points;
}

TEST(Levels, LeaveFullDetailAsItWas) {
  Scene before = scan_scene({.triangles = 20000});
  cut_into_chunks(before);
  const auto triangles = [](const Scene& scene, const std::vector<std::uint32_t>& indices) {
    std::multiset<std::set<Place>> found;
    for (std::size_t i = 0; i < indices.size(); i += 3)
      found.insert({place_of(scene, indices[i]), place_of(scene, indices[i + 1]),
                    place_of(scene, indices[i + 2])});
    return found;
  };
  const std::vector<Mesh> full = chosen(scan(), [](const Coarsening&) { return false; });
  EXPECT_TRUE(triangles(scan(), indices_of(scan(), full)) == triangles(before, before.indices));
  EXPECT_EQ(scan().triangle_count(), before.indices.size() / 3);
  EXPECT_EQ(scan().vertices.size(), before.vertices.size());
}

TEST(Levels, GoDownToAHundredthOfTheTriangles) {
  const std::size_t fewest = indices_of(scan(), chosen(scan(), within(1e9f))).size() / 3;
  EXPECT_GT(fewest, 0u);
  EXPECT_LT(fewest, scan().triangle_count() / 100);
}

TEST(Levels, AreWholeAtAnyError) {
  ASSERT_EQ(open_edges(scan(), indices_of(scan(), chosen(scan(), within(0)))), 0u);
  for (float error = 1e-4f; error < 1; error *= 1.5f)
    EXPECT_EQ(open_edges(scan(), indices_of(scan(), chosen(scan(), within(error)))), 0u) << error;
}

// What a near eye sees: fine before it, coarse on the far side.
TEST(Levels, AreWholeWhereNeighboursDiffer) {
  const TileCorners screen{{-1, -1, 1.3}, {1, -1, 1.3}, {-1, 1, 1.3}};
  std::set<int> numbers_of_levels;
  for (const Vec3& eye : {Vec3(0, 0, 1.5), Vec3(0.9, 0.2, 1.4), Vec3(-3, 1, 2)}) {
    const DetailNeed need = detail_need(screen, {200, 200}, eye);
    const std::vector<Mesh> meshes = chosen(scan(), [&](const Coarsening& coarsening) {
      return fine_enough(need, eye, coarsening.bounds_in_node, coarsening.error_in_node);
    });
    EXPECT_EQ(open_edges(scan(), indices_of(scan(), meshes)), 0u) << eye.transpose();
    std::set<int> errors;  // by powers of two
    for (const Mesh& mesh : meshes)
      errors.insert(mesh.made_by < 0 ? -99
                                     : std::ilogb(scan().coarsenings[mesh.made_by].error_in_node));
    numbers_of_levels.insert(static_cast<int>(errors.size()));
  }
  EXPECT_GE(*numbers_of_levels.rbegin(), 3);
}

TEST(Levels, AreAsNearToFullDetailAsTheySay) {
  const std::vector<Eigen::Vector3f> points = points_on_full_detail(scan(), 4000);
  for (const float error : {0.003f, 0.01f, 0.03f, 0.1f}) {
    SurfacePatches surface(scan().vertices);
    float stated = 0;
    for (const Mesh& mesh : chosen(scan(), within(error))) {
      surface.add(indices_of(scan(), {mesh}));
      if (mesh.made_by >= 0)
        stated = std::max(stated, scan().coarsenings[mesh.made_by].error_in_node);
    }
    float farthest = 0;
    for (const Eigen::Vector3f& point : points)
      farthest = std::max(farthest, surface.nearest_to(point).distance);
    std::printf("stated %.5f, measured %.5f\n", stated, farthest);
    EXPECT_LE(farthest, stated + 1e-6f) << error;
    EXPECT_LE(stated, error);
  }
}

TEST(Levels, GrowInErrorAndBoundsFromLevelToLevel) {
  for (const Mesh& mesh : scan().meshes) {
    if (mesh.made_by < 0 || mesh.replaced_by < 0) continue;
    const Coarsening &finer = scan().coarsenings[mesh.made_by],
                     &coarser = scan().coarsenings[mesh.replaced_by];
    EXPECT_LT(finer.error_in_node, coarser.error_in_node);
    EXPECT_TRUE(coarser.bounds_in_node.contains(finer.bounds_in_node));
    EXPECT_TRUE(coarser.bounds_in_node.contains(mesh.bounds_in_node));
  }
}

/// A plate of side * side squares from -1 to 1 in z = 0, `change` made to each vertex.
Scene plate(int side, const Material& material, const std::function<void(Vertex&)>& change) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) {
      Vertex vertex;
      vertex.position_in_node = {2.0f * static_cast<float>(x) / static_cast<float>(side) - 1,
                                 2.0f * static_cast<float>(y) / static_cast<float>(side) - 1, 0};
      change(vertex);
      vertices.push_back(vertex);
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto at = [&](int dx, int dy) {
        return static_cast<std::uint32_t>((y + dy) * (side + 1) + x + dx);
      };
      for (const std::uint32_t corner :
           {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)})
        indices.push_back(corner);
    }
  Scene scene;
  const int mesh = add_mesh(scene, vertices, indices, material);
  scene.nodes.assign(2, empty_node(Eigen::Matrix4f::Identity()));
  for (Node& node : scene.nodes) node.meshes = {mesh};
  return scene;
}

std::size_t triangles_within(const Scene& scene, float error) {
  return indices_of(scene, chosen(scene, within(error))).size() / 3;
}

TEST(Levels, OfAPlainPlateCostNothing) {
  const Scene scene = with_levels(plate(100, Material{}, [](Vertex&) {}));
  EXPECT_LT(triangles_within(scene, 1e-5f), 2000u);
}

TEST(Levels, DoNotWipeOutColours) {
  const Scene scene = with_levels(plate(100, Material{}, [](Vertex& vertex) {
    const float wave = std::sin(20 * vertex.position_in_node.x());
    vertex.colour[0] = static_cast<std::uint8_t>(128 + 100 * wave);
  }));
  EXPECT_GT(triangles_within(scene, 1e-3f), 8000u);
  EXPECT_LT(triangles_within(scene, 1), 2000u);
}

TEST(Levels, DoNotLetTexturesSlide) {
  const Scene scene = with_levels(plate(100, Material{}, [](Vertex& vertex) {
    const float x = vertex.position_in_node.x(), y = vertex.position_in_node.y();
    vertex.uv = {x + 0.1f * std::sin(9 * y), y + 0.1f * std::sin(9 * x)};
  }));
  EXPECT_GT(triangles_within(scene, 1e-4f), 10000u);
  EXPECT_LT(triangles_within(scene, 1), 2000u);
}

TEST(Levels, AreShownByAllNodesOfTheirMesh) {
  const Scene scene = with_levels(plate(60, Material{}, [](Vertex&) {}));
  ASSERT_FALSE(scene.coarsenings.empty());
  EXPECT_EQ(scene.nodes[0].meshes, scene.nodes[1].meshes);
  EXPECT_EQ(scene.nodes[0].meshes.size(), scene.meshes.size());
}

TEST(Levels, AreNotMadeOfLeavesAndGlass) {
  for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
    Material material;
    material.alpha_mode = mode;
    Scene scene = plate(60, material, [](Vertex&) {});
    cut_into_chunks(scene);
    const std::vector<std::uint32_t> before = scene.indices;
    make_levels(scene);
    EXPECT_TRUE(scene.coarsenings.empty());
    EXPECT_EQ(scene.indices.size(), before.size());
  }
}

/// The sides of a box as plates, each with its own vertices and normals.
Scene faceted_box(int side) {
  Scene box = plate(side, Material{}, [](Vertex& vertex) { vertex.position_in_node.z() = 1; });
  const std::vector<Vertex> top = box.vertices;
  const std::vector<std::uint32_t> indices = box.indices;
  for (int turn = 1; turn < 6; ++turn) {
    const Eigen::Vector3f axis = turn < 4 ? Eigen::Vector3f::UnitX() : Eigen::Vector3f::UnitY();
    const float quarters = static_cast<float>(turn < 4 ? turn : 2 * turn - 9);
    const Eigen::Matrix3f rotation =
        Eigen::AngleAxisf(1.57079633f * quarters, axis).toRotationMatrix().array().round();
    const auto first = static_cast<std::uint32_t>(box.vertices.size());
    for (Vertex vertex : top) {
      vertex.position_in_node = rotation * vertex.position_in_node;
      vertex.normal_in_node = rotation * vertex.normal_in_node;
      box.vertices.push_back(vertex);
      box.meshes.front().bounds_in_node.extend(vertex.position_in_node);
    }
    for (const std::uint32_t index : indices) box.indices.push_back(first + index);
  }
  box.meshes.front().index_count = static_cast<std::uint32_t>(box.indices.size());
  return box;
}

TEST(Levels, OfAFacetedBoxStayWholeAndKeepItsEdgesSharp) {
  const Scene scene = with_levels(faceted_box(32));
  const std::vector<std::uint32_t> indices = indices_of(scene, chosen(scene, within(1e-3f)));
  EXPECT_EQ(open_edges(scene, indices), 0u);
  EXPECT_LT(indices.size() / 3, scene.triangle_count() / 2);
  std::size_t blunt = 0;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) -> const Vertex& {
      return scene.vertices[indices[i + k]];
    };
    const Eigen::Vector3f normal =
        (corner(1).position_in_node - corner(0).position_in_node)
            .cross(corner(2).position_in_node - corner(0).position_in_node);
    if (normal.norm() < 1e-6f) continue;  // closes a gap between three vertices in a row
    for (std::size_t k = 0; k < 3; ++k)
      blunt += !(normal.normalized().dot(corner(k).normal_in_node) > 0.99f);
  }
  EXPECT_LT(static_cast<double>(blunt), 0.01 * static_cast<double>(indices.size()));
}

/// Bit for bit, whatever cores do first: a packed scene is known by its model alone.
TEST(Levels, AreTheSameEachTime) {
  const Scene again = with_levels(scan_scene({.triangles = 20000}));
  EXPECT_EQ(again.indices, scan().indices);
  ASSERT_EQ(again.coarsenings.size(), scan().coarsenings.size());
  for (std::size_t i = 0; i < again.coarsenings.size(); ++i)
    EXPECT_EQ(again.coarsenings[i].error_in_node, scan().coarsenings[i].error_in_node);
}

TEST(Levels, TakeAMeshWithoutAnyExtentAndAnEmptyScene) {
  Scene point = plate(30, Material{}, [](Vertex& vertex) { vertex.position_in_node.setOnes(); });
  EXPECT_EQ(with_levels(point).triangle_count(), 1800u);
  EXPECT_TRUE(with_levels(Scene{}).meshes.empty());
}

TEST(NearestInTriangle, IsNearerThanAnyOtherPointOfIt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> between(-1, 1), share(0, 1);
  const auto any = [&] {
    return Eigen::Vector3f(between(random), between(random), between(random));
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const std::array<Eigen::Vector3f, 3> corners = {any(), any(), any()};
    const Eigen::Vector3f point = 2 * any();
    const auto at = [&](const Eigen::Vector3f& weights) {
      return Eigen::Vector3f(weights[0] * corners[0] + weights[1] * corners[1] +
                             weights[2] * corners[2]);
    };
    const Eigen::Vector3f nearest = nearest_in_triangle(point, corners);
    EXPECT_GE(nearest.minCoeff(), 0);
    EXPECT_NEAR(nearest.sum(), 1, 1e-5);
    for (int other = 0; other < 30; ++other) {
      const float u = share(random), v = (1 - u) * share(random);
      EXPECT_LE((at(nearest) - point).norm(), (at({1 - u - v, u, v}) - point).norm() + 1e-5f);
    }
  }
}

}  // namespace
}  // namespace vindu
