// The camera path of loop mode: through all keys, round and round, without a jump or a kink.
#include "core/camera_path.h"

#include <unistd.h>

#include <cstdio>

#include "core/error.h"
#include "tests/core/files.h"
#include "tests/core/matchers.h"

namespace vindu {
namespace {

using testing::complaint_about;
using ::testing::HasSubstr;
using testing::IsNearPoint;

CameraPath some_path() {
  return CameraPath({{0, {-1, 0.1, 2}}, {1.5, {0, 0.3, 1}}, {2, {1, 0.1, 2}}, {4, {0, 0, 3}}}, 2.5);
}

Vec3 velocity_m_s(const CameraPath& path, double t_s) {
  constexpr double kStep_s = 1e-6;
  return (path.eye_at(t_s + kStep_s) - path.eye_at(t_s - kStep_s)) / (2 * kStep_s);
}

TEST(CameraPath, PassesThroughItsKeys) {
  const CameraPath path = some_path();
  EXPECT_THAT(path.eye_at(0), IsNearPoint(Vec3(-1, 0.1, 2), 1e-12));
  EXPECT_THAT(path.eye_at(1.5), IsNearPoint(Vec3(0, 0.3, 1), 1e-12));
  EXPECT_THAT(path.eye_at(2), IsNearPoint(Vec3(1, 0.1, 2), 1e-12));
  EXPECT_THAT(path.eye_at(4), IsNearPoint(Vec3(0, 0, 3), 1e-12));
}

TEST(CameraPath, IsReadAsItWasWritten) {
  const std::string file =
      ::testing::TempDir() + "vindu_path_" + std::to_string(getpid()) + ".toml";
  write_camera_path({{0, {-1, 0.1, 2}}, {0.5, {0, 0.3, 1}}, {2, {1, -0.1, 2}}}, file);
  const CameraPath path = read_camera_path(file);
  std::remove(file.c_str());
  EXPECT_DOUBLE_EQ(path.period_s(), 3);
  EXPECT_THAT(path.eye_at(0.5), IsNearPoint(Vec3(0, 0.3, 1), 1e-6));
  EXPECT_THAT(path.eye_at(2), IsNearPoint(Vec3(1, -0.1, 2), 1e-6));
  EXPECT_THROW(write_camera_path({}, "/no/such/folder/a.toml"), Error);
}

TEST(CameraPath, RepeatsAfterItsPeriodForwardsAndBackwards) {
  const CameraPath path = some_path();
  EXPECT_DOUBLE_EQ(path.period_s(), 6.5);
  for (double t_s = 0; t_s < 6.5; t_s += 0.13) {
    EXPECT_THAT(path.eye_at(t_s + 5 * 6.5), IsNearPoint(path.eye_at(t_s), 1e-12));
    EXPECT_THAT(path.eye_at(t_s - 3 * 6.5), IsNearPoint(path.eye_at(t_s), 1e-12));
  }
}

TEST(CameraPath, HasNoKinkAtAKeyNorWhereItCloses) {
  const CameraPath path = some_path();
  for (const double key_s : {0.0, 1.5, 2.0, 4.0, 6.5})
    EXPECT_THAT(velocity_m_s(path, key_s - 2e-6),
                IsNearPoint(velocity_m_s(path, key_s + 2e-6), 1e-3))
        << key_s;
}

TEST(CameraPath, OfTwoKeysGoesThereAndBack) {
  const CameraPath path({{0, {-1, 0, 2}}, {1, {1, 0, 2}}}, 1);
  EXPECT_THAT(path.eye_at(0.5), IsNearPoint(Vec3(0, 0, 2), 1e-12));
  EXPECT_THAT(path.eye_at(1.5), IsNearPoint(Vec3(0, 0, 2), 1e-12));
}

TEST(CameraPath, KeepsAConstantSpeedWhereItsKeysDoHoweverTheyAreSpaced) {
  const CameraPath path({{0, {0, 0, 2}}, {1, {1, 0, 2}}, {1.5, {1.5, 0, 2}}, {3, {3, 0, 2}}}, 5);
  for (const double t_s : {1.0, 1.1, 1.25, 1.49})
    EXPECT_THAT(path.eye_at(t_s), IsNearPoint(Vec3(t_s, 0, 2), 1e-12));
}

TEST(CameraPath, StaysAmongKeysOfALine) {
  const CameraPath path({{0, {0, 0, 1}}, {1, {0, 0, 2}}, {2, {0, 0, 3}}, {3, {0, 0, 2}}}, 1);
  for (double t_s = 0; t_s < 4; t_s += 0.01) {
    EXPECT_GE(path.eye_at(t_s).z(), 1 - 0.01);
    EXPECT_LE(path.eye_at(t_s).z(), 3 + 0.01);
  }
}

TEST(CameraPathFile, IsRead) {
  const testing::TextFile file(
      "closing_s = 0.5\n"
      "[[key]]\nt_s = 0\neye_m = [0, 0.1, 2]\n"
      "[[key]]\nt_s = 2.5\neye_m = [1, 0.2, 1]\n");
  const CameraPath path = read_camera_path(file.path());
  EXPECT_DOUBLE_EQ(path.period_s(), 3);
  EXPECT_THAT(path.eye_at(2.5), IsNearPoint(Vec3(1, 0.2, 1), 1e-12));
}

TEST(CameraPathFile, SaysAllThatIsWrong) {
  const std::string complaint = complaint_about(
      "closing_s = -1\n"
      "[[key]]\nt_s = 1\neye_m = [0, 0.1, 2]\n"
      "[[key]]\neye_m = [0, 0.1]\nspeed = 3\n",
      read_camera_path);
  EXPECT_EQ(complaint,
            "FILE:1: closing_s: is -1; from 0.01 to 1000000 is allowed\n"
            "FILE:3: key[0].t_s: is 1; 0 is allowed, for the first key\n"
            "FILE:5: key[1].t_s: is missing; for example t_s = 1.5\n"
            "FILE:6: key[1].eye_m: is [0, 0.1]; 3 numbers from -1000 to 1000 in brackets are "
            "allowed\n"
            "FILE:7: key[1].speed: is not known; known here: t_s, eye_m");
}

TEST(CameraPathFile, NeedsTwoKeys) {
  EXPECT_THAT(complaint_about("[[key]]\nt_s = 0\neye_m = [0, 0, 1]\n", read_camera_path),
              HasSubstr("key: at least two [[key]] tables are needed"));
  EXPECT_THAT(complaint_about("", read_camera_path), HasSubstr("at least two [[key]] tables"));
}

TEST(CameraPathFile, HasItsKeysInOrder) {
  EXPECT_THAT(complaint_about("[[key]]\nt_s = 0\neye_m = [0, 0, 1]\n"
                              "[[key]]\nt_s = 0\neye_m = [0, 0, 1]\n",
                              read_camera_path),
              HasSubstr("FILE:5: key[1].t_s: is 0; more than 0, that of the key before, is"));
}

}  // namespace
}  // namespace vindu
