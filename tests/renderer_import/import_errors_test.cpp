// What is no model: every case is an Error that names the file and says what to do; nothing
// crashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "core/error.h"
#include "renderer/import.h"
#include "tests/renderer_import/model_files.h"

namespace vindu {
namespace {

using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// The message; empty when the file was imported.
std::string message_of(const std::string& file, const ImportLimits& limits = {}) {
  try {
    import_scene(file, limits);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(ImportError, MissingFileNamesTheNearestOne) {
  const TemporaryFolder folder;
  folder.write("duck.glb", "model");

  EXPECT_THAT(message_of(folder.path("duk.glb")),
              AllOf(StartsWith(folder.path("duk.glb")), HasSubstr("no such file"),
                    HasSubstr("did you mean duck.glb?")));
  EXPECT_THAT(message_of(folder.path("missing/x.glb")), HasSubstr("no such file"));
  EXPECT_THAT(message_of(""), HasSubstr("no such file"));
}

TEST(ImportError, Folder) {
  const TemporaryFolder folder;

  EXPECT_THAT(message_of(folder.path("")), HasSubstr("is a folder"));
}

TEST(ImportError, DeviceIsNotWaitedFor) {
  EXPECT_THAT(message_of("/dev/zero"), HasSubstr("not a file"));
}

TEST(ImportError, EmptyFile) {
  const TemporaryFolder folder;

  EXPECT_THAT(message_of(folder.write("a.glb", "")), HasSubstr("the file is empty"));
}

TEST(ImportError, HugeFileIsRefusedUnread) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.ply", "ply\n");
  std::filesystem::resize_file(file, std::uintmax_t{10} << 30);  // sparse

  EXPECT_THAT(message_of(file), AllOf(HasSubstr("10 GiB"), HasSubstr("2 GiB")));
}

TEST(ImportError, OpenSceneGraphFormatsNameOsgconv) {
  const TemporaryFolder folder;

  for (const char* name : {"cow.osg", "cow.osgt", "cow.osgb", "cow.ive", "cow.IVE"})
    EXPECT_THAT(message_of(folder.write(name, "Group {}")), HasSubstr("osgconv model")) << name;
}

TEST(ImportError, UnknownFormatsNameCommonOnes) {
  const TemporaryFolder folder;

  EXPECT_THAT(message_of(folder.write("a.txt", "hello")), HasSubstr(".glb, .gltf, .obj"));
  EXPECT_THAT(message_of(folder.write("model", "hello")), HasSubstr("has no extension"));
  EXPECT_THAT(message_of(folder.write("a.max", "hello")), HasSubstr("format .max"));
}

TEST(ImportError, PictureIsNotAModel) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> png = test::two_pixel_png();
  const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());

  EXPECT_THAT(message_of(folder.write("a.png", bytes)), HasSubstr("is a picture"));
  EXPECT_THAT(message_of(folder.write("a.ply", bytes)), Not(IsEmpty()));
  EXPECT_THAT(message_of(folder.write("a.glb", bytes)), Not(IsEmpty()));
}

TEST(ImportError, TextWithAModelsName) {
  const TemporaryFolder folder;

  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.gltf", "a.glb", "a.fbx", "a.dae", "a.3ds",
                           "a.blend", "a.x3d", "a.off", "a.dxf"})
    EXPECT_THAT(message_of(folder.write(name, "Dear visitor,\nthis is no model.\n")),
                StartsWith(folder.path(name)))
        << name;
}

TEST(ImportError, EveryCutOffGlb) {
  const TemporaryFolder folder;
  const std::string whole =
      text_of(test::test_model("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb"));
  ASSERT_GT(whole.size(), 2000u);

  for (std::size_t size = 1; size < whole.size(); size += 97)
    EXPECT_THAT(message_of(folder.write("a.glb", whole.substr(0, size))), Not(IsEmpty())) << size;
}

TEST(ImportError, PointsAndLinesOnlyHaveNoTriangles) {
  EXPECT_THAT(message_of(test::test_model("OBJ/point_cloud.obj")), HasSubstr("no triangles"));
  EXPECT_THAT(message_of(test::test_model("OBJ/testline.obj")), HasSubstr("no triangles"));
  EXPECT_THAT(message_of(test::test_model("Collada/cameras.dae")), HasSubstr("no triangles"));
}

TEST(ImportError, AllVerticesInOnePlace) {
  const TemporaryFolder folder;

  EXPECT_THAT(message_of(folder.write("a.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n")),
              HasSubstr("in one place"));
}

TEST(ImportError, TrianglesWithoutAnyArea) {
  const TemporaryFolder folder;

  EXPECT_THAT(message_of(folder.write("a.obj", "v 0 0 0\nv 1 2 3\nv -1 -2 -3\nf 1 2 3\n")),
              HasSubstr("but lines"));
}

TEST(ImportError, AllVerticesInfinite) {
  EXPECT_THAT(
      message_of(test::test_model("glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb")),
      HasSubstr("not finite"));
}

TEST(ImportError, MoreTrianglesThanAllowed) {
  ImportLimits limits;
  limits.triangles = 4211;

  EXPECT_THAT(message_of(test::test_model("Collada/duck.dae"), limits),
              AllOf(HasSubstr("4212 triangles"), HasSubstr("4211")));
  limits.triangles = 4212;
  EXPECT_THAT(message_of(test::test_model("Collada/duck.dae"), limits), IsEmpty());
}

TEST(ImportError, MissingPartNamesItAndWhereItBelongs) {
  EXPECT_THAT(message_of(test::test_model("glTF2/MissingBin/BoxTextured.gltf")),
              AllOf(HasSubstr("BoxTextured0.bin"), HasSubstr("put that file beside the model")));
}

TEST(ImportError, MessageIsOneLine) {
  EXPECT_THAT(message_of(test::test_model("glTF2/RecursiveNodes/RecursiveNodes.gltf")),
              AllOf(Not(IsEmpty()), Not(HasSubstr("\n"))));
}

/// All of Debian's broken files; none of them crashes Assimp 5.2.5.
class BrokenModel : public ::testing::TestWithParam<const char*> {};

TEST_P(BrokenModel, IsAnError) {
  const std::string file = test::test_model(GetParam());
  ASSERT_TRUE(std::filesystem::exists(file)) << "install assimp-testmodels";

  EXPECT_THAT(message_of(file), AllOf(StartsWith(file), HasSubstr("; ")));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenModel,
    ::testing::Values(
        "invalid/empty.3ds", "invalid/empty.ase", "invalid/empty.lwo", "invalid/empty.md5mesh",
        "invalid/empty.obj", "invalid/empty.off", "invalid/empty.ply", "invalid/empty.raw",
        "invalid/empty.smd", "invalid/empty.x", "invalid/emptyIrrMesh.xml", "invalid/malformed.obj",
        "invalid/readme.txt", "OFF/invalid.off", "FBX/transparentTest.fbx",
        "glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf",
        "glTF2/SchemaFailures/sceneWrongType.gltf", "glTF2/TestNoRootNode/NoScene.gltf",
        "glTF2/TestNoRootNode/SceneWithoutNodes.gltf", "glTF2/issue_3269/texcoord_crash.gltf",
        "glTF2/wrongTypes/badArray.gltf", "glTF2/wrongTypes/badExtension.gltf",
        "glTF2/wrongTypes/badNumber.gltf", "glTF2/wrongTypes/badObject.gltf",
        "glTF2/wrongTypes/badString.gltf", "glTF2/wrongTypes/badUint.gltf"));

/// A PLY triangle whose header is given but for its first and last line.
std::string ply_with_header(const std::string& header) {
  return "ply\n" + header + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
}

constexpr const char* kVertexProperties = "property float x\nproperty float y\nproperty float z\n";

std::string ply_that_claims(const std::string& vertices, const std::string& faces) {
  return ply_with_header("format ascii 1.0\nelement vertex " + vertices + "\n" + kVertexProperties +
                         "element face " + faces + "\nproperty list uchar int vertex_indices\n");
}

TEST(ImportError, PlyThatClaimsMoreThanItsFileHolds) {
  const TemporaryFolder folder;

  ASSERT_THAT(message_of(folder.write("a.ply", ply_that_claims("3", "1"))), IsEmpty());
  EXPECT_THAT(message_of(folder.write("a.ply", ply_that_claims("1300000000", "1"))),
              HasSubstr("line 3"));
  EXPECT_THAT(message_of(folder.write("a.ply", ply_that_claims("3", "1300000000"))),
              HasSubstr("line 7"));
  EXPECT_THAT(message_of(folder.write("a.ply", ply_that_claims("-3", "1"))), Not(IsEmpty()));
}

TEST(ImportError, PlyWithADamagedHeader) {  // each makes Assimp 5.2 crash or hang
  const TemporaryFolder folder;

  for (const char* header : {"format ascii 1.0\nel3ment vertex 3\nproperty float x\n",
                             "format ascii 1.0\nelement vertex 3\nproperty floqt x\n",
                             "format ascii 1.0\nelement vertex 3\nproperty float\n",
                             "format ascii 1.0\nelement vertex 3\nproperty float x\nelem face 1\n",
                             "format ascii 1.0\nelement vertex 3\nproperty list uchar\n"})
    EXPECT_THAT(message_of(folder.write("a.ply", ply_with_header(header))),
                HasSubstr("header is damaged"))
        << header;
}

TEST(ImportError, EveryCutOffPly) {
  const TemporaryFolder folder;
  const std::string whole = ply_that_claims("3", "1");

  for (std::size_t size = 1; size + 8 < whole.size(); ++size)
    EXPECT_THAT(message_of(folder.write("a.ply", whole.substr(0, size))), Not(IsEmpty())) << size;
}

// The sanitizers' own memory cannot be told from the importer's, so it is not limited there.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST(ImportError, SmallFilesThatClaimToBeHugeTakeNoMemory) {
  const TemporaryFolder folder;

  for (const std::string& file :
       {folder.write("a.off", "OFF\n3 1300000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        folder.write("b.off", "OFF\n1300000000 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        test::test_model("invalid/OutOfMemory.off")})
    EXPECT_THAT(message_of(file), HasSubstr("more memory")) << file;
}

TEST(ImportError, TheMemoryLimitEndsWithTheImport) {
  rlimit before{}, after{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);

  EXPECT_THAT(message_of(test::test_model("invalid/OutOfMemory.off")), Not(IsEmpty()));

  ASSERT_EQ(getrlimit(RLIMIT_AS, &after), 0);
  EXPECT_EQ(after.rlim_cur, before.rlim_cur);
}

#endif

TEST(ImportError, PolygonsThatALoaderOnlyClaimsDoNotAbort) {
  const TemporaryFolder folder;

  // Assimp's OFF loader marks every mesh as one of polygons.
  EXPECT_THAT(message_of(folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")),
              IsEmpty());
  EXPECT_THAT(message_of(folder.write("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n0\n")),
              HasSubstr("no triangles"));
}

TEST(ImportError, AfterAnErrorTheNextModelLoads) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of(folder.write("bad.obj", "nothing")), Not(IsEmpty()));

  EXPECT_THAT(message_of(folder.write("good.obj", kTriangleObj)), IsEmpty());
}

}  // namespace
}  // namespace vindu
