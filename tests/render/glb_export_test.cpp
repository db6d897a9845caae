// The animated GLB file, read back by a reader that is not ours.

#include "bumper/render/glb_export.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "synthetic_run.h"
#include "temporary_folder.h"

namespace bumper::testing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double allowed = 1e-4;   // m: single precision within 1.6 km of the run's middle
constexpr double inFile = 1000.0;  // assimp gives glTF's times in milliseconds

class GlbExport : public ::testing::Test {
 protected:
  const aiScene& readBack(const Scene& scene, const Recording& run,
                          const GlbOptions& options = {}) {
    writeGlb(scene, run, file_, options);
    const aiScene* read = importer_.ReadFile(file_.string(), aiProcess_ValidateDataStructure);
    if (read == nullptr) throw std::runtime_error(importer_.GetErrorString());
    return *read;
  }

  static const aiNodeAnim& animationOf(const aiScene& scene, const std::string& node) {
    if (scene.mNumAnimations == 1) {
      const aiAnimation& animation = *scene.mAnimations[0];
      for (unsigned k = 0; k < animation.mNumChannels; ++k) {
        if (animation.mChannels[k]->mNodeName.C_Str() == node) return *animation.mChannels[k];
      }
    }
    throw std::runtime_error("no animation of " + node);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "run.glb";
  Assimp::Importer importer_;
};

Vector3d toVector(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// The root's translation, turned from y up back to z up.
Vector3d middleOf(const aiScene& scene) {
  const aiMatrix4x4& m = scene.mRootNode->mTransformation;
  return {m.a4, -m.c4, m.b4};
}

/// `run` with every place moved.
Recording moved(const Recording& run, const Vector3d& way) {
  Recording result;
  for (const RecordedVehicle& vehicle : run.vehicles()) {
    const std::size_t copy = result.addVehicle(vehicle.name, vehicle.parameters);
    for (RecordedPose pose : vehicle.poses) {
      pose.position += way;
      result.addPose(copy, pose);
    }
  }
  for (const RecordedImpact& impact : run.impacts()) {
    ImpactEvent event = impact.event();
    event.contact += way;
    result.addImpact(event);
  }
  return result;
}

TEST_F(GlbExport, HasEveryPoseInItsPlaceAtItsTime) {
  const Recording run = testRailRun();
  const aiScene& read = readBack(testRail(), run);
  const aiNodeAnim& saloon = animationOf(read, "saloon");
  const std::vector<RecordedPose>& poses = run.vehicles()[0].poses;
  ASSERT_EQ(saloon.mNumPositionKeys, poses.size());
  ASSERT_EQ(saloon.mNumRotationKeys, poses.size());
  const Vector3d middle = middleOf(read);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const aiVectorKey& place = saloon.mPositionKeys[k];
    EXPECT_LT((middle + toVector(place.mValue) - poses[k].position).norm(), allowed) << k;
    EXPECT_NEAR(place.mTime / inFile, poses[k].time, 1e-6) << k;
    const aiQuaternion& turn = saloon.mRotationKeys[k].mValue;
    const Eigen::Quaterniond turned(turn.w, turn.x, turn.y, turn.z);
    EXPECT_LT(turned.angularDistance(poses[k].orientation), 1e-6) << k;
  }
}

TEST_F(GlbExport, IsExactFarFromTheWorldsOrigin) {
  // A real place in metres of a national grid, where single precision has steps of 0.5 m.
  const Vector3d far(3512345.25, 5401234.5, 512.0);
  Scene scene = testRail();
  for (Vector3d& vertex : scene.vertices) vertex += far;
  const Recording run = moved(testRailRun(), far);
  const aiScene& read = readBack(scene, run);
  const aiNodeAnim& saloon = animationOf(read, "saloon");

  std::ifstream stream(file_, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  const auto json = nlohmann::json::parse(bytes.substr(20, length));
  const auto root = json["nodes"][json["scenes"][0]["nodes"][0].get<std::size_t>()];
  const Vector3d middle(root["translation"][0], -root["translation"][2].get<double>(),
                        root["translation"][1]);

  const std::vector<RecordedPose>& poses = run.vehicles()[0].poses;
  ASSERT_EQ(saloon.mNumPositionKeys, poses.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vector3d place = middle + toVector(saloon.mPositionKeys[k].mValue);
    ASSERT_LT((place - poses[k].position).norm(), allowed) << k;
  }
}

TEST_F(GlbExport, DrawsAVehicleAsItsOwnMesh) {
  // 4 m long, anywhere in its file; the saloon's outline has its middle 0.15 m behind the mass
  // centre, which is 0.56 m above the ground.
  auto slab = std::make_shared<Scene>();
  slab->vertices = {{7.0, 3.0, 5.0}, {11.0, 3.0, 5.0}, {11.0, 4.0, 5.0}, {7.0, 4.0, 5.0}};
  slab->meshes = {{"slab", "paint", {0.1F, 0.9F, 0.1F}}};
  slab->triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
  GlbOptions options;
  options.vehicleMeshes["saloon"] = slab;
  const aiScene& read = readBack(testRail(), testRailRun(), options);
  const aiNode* node = read.mRootNode->FindNode("saloon");
  ASSERT_NE(node, nullptr);
  ASSERT_EQ(node->mNumMeshes, 1U);
  const aiMesh& mesh = *read.mMeshes[node->mMeshes[0]];
  Eigen::AlignedBox3d box;
  for (unsigned k = 0; k < mesh.mNumVertices; ++k) box.extend(toVector(mesh.mVertices[k]));
  EXPECT_LT((box.min() - Vector3d(-2.15, -0.5, -0.56)).norm(), 1e-5);
  EXPECT_LT((box.max() - Vector3d(1.85, 0.5, -0.56)).norm(), 1e-5);

  options.vehicleMeshes["lorry"] = slab;
  EXPECT_THAT([&] { writeGlb(testRail(), testRailRun(), file_, options); },
              ThrowsMessage<Error>(HasSubstr("'lorry' is no vehicle")));
}

TEST_F(GlbExport, TurnsTheShorterWayBetweenKeys) {
  Recording run;
  const std::size_t saloon = run.addVehicle("saloon", bumper::testing::saloon());
  for (int k = 0; k <= 400; ++k) {
    RecordedPose pose;
    pose.time = 0.01 * k;
    pose.orientation = Eigen::AngleAxisd(0.05 * k, Vector3d::UnitZ());
    // The same turn, written the other way now and then, as a program may do.
    if (k % 3 == 0) pose.orientation.coeffs() *= -1.0;
    run.addPose(saloon, pose);
  }
  const aiNodeAnim& turning = animationOf(readBack(testRail(), run), "saloon");
  for (unsigned k = 1; k < turning.mNumRotationKeys; ++k) {
    const aiQuaternion& a = turning.mRotationKeys[k - 1].mValue;
    const aiQuaternion& b = turning.mRotationKeys[k].mValue;
    ASSERT_GT(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z, 0.0F) << k;
  }
}

TEST_F(GlbExport, SceneStandsWhereItStood) {
  Scene wall = straightWall({100.0, 20.0}, {130.0, 20.0}, 1.0);
  const aiScene& read = readBack(wall, standingVehicle({110.0, 25.0}, 0.0));
  const Vector3d middle = middleOf(read);
  Eigen::AlignedBox3d box;
  unsigned triangles = 0;
  const aiNode* scene = read.mRootNode->FindNode("scene");
  ASSERT_NE(scene, nullptr);
  for (unsigned n = 0; n < scene->mNumChildren; ++n) {
    const aiMesh& mesh = *read.mMeshes[scene->mChildren[n]->mMeshes[0]];
    triangles += mesh.mNumFaces;
    for (unsigned k = 0; k < mesh.mNumVertices; ++k)
      box.extend(middle + toVector(mesh.mVertices[k]));
  }
  Eigen::AlignedBox3d expected;
  for (const Vector3d& vertex : wall.vertices) expected.extend(vertex);
  EXPECT_EQ(triangles, wall.triangles.size());
  EXPECT_LT((box.min() - expected.min()).norm(), allowed);
  EXPECT_LT((box.max() - expected.max()).norm(), allowed);
}

TEST_F(GlbExport, LeavesOutWhatIsFar) {
  const Scene scene = course();
  const Recording run = courseRun();
  const unsigned everything = [&] {
    const aiScene& read =
        readBack(scene, run, {.sceneReach = std::numeric_limits<double>::infinity()});
    unsigned count = 0;
    for (unsigned m = 0; m < read.mNumMeshes; ++m) count += read.mMeshes[m]->mNumFaces;
    return count;
  }();
  unsigned near = 0;
  const aiScene& read = readBack(scene, run, {.sceneReach = 50.0});
  for (unsigned m = 0; m < read.mNumMeshes; ++m) near += read.mMeshes[m]->mNumFaces;
  EXPECT_GT(everything, scene.triangles.size());  // the vehicle and the marks besides
  EXPECT_LT(near, everything / 2);
}

TEST_F(GlbExport, MarksAppearAtTheirTimeInTheirPlace) {
  const Recording run = testRailRun();
  const aiScene& read = readBack(testRail(), run);
  const char* const names[] = {"impact 1, 4.2 m/s", "impact 2, 3.1 m/s", "impact 3, 26.4 m/s"};
  for (std::size_t k = 0; k < 3; ++k) {
    const ImpactEvent event = run.impacts()[k].event();
    const aiNodeAnim& mark = animationOf(read, names[k]);
    ASSERT_GE(mark.mNumScalingKeys, 2U);
    EXPECT_EQ(toVector(mark.mScalingKeys[0].mValue).norm(), 0.0);
    EXPECT_NEAR(mark.mScalingKeys[0].mTime / inFile, event.time, 1e-6);
    EXPECT_GT(mark.mScalingKeys[1].mValue.x, 0.9F);
    EXPECT_NEAR(mark.mScalingKeys[1].mTime / inFile, event.time, 1e-5);
    EXPECT_EQ(toVector(mark.mScalingKeys[mark.mNumScalingKeys - 1].mValue), Vector3d::Ones());

    const aiNode* node = read.mRootNode->FindNode(names[k]);
    ASSERT_NE(node, nullptr);
    const aiMatrix4x4& m = node->mTransformation;
    EXPECT_LT((middleOf(read) + Vector3d(m.a4, m.b4, m.c4) - event.contact).norm(), allowed);
    // The farthest vertex is the arrow's tip: out along the wall's normal.
    const aiMesh& mesh = *read.mMeshes[node->mMeshes[0]];
    double reach = 0.0;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      reach = std::max(reach, static_cast<double>(mesh.mVertices[v].x));
    EXPECT_NEAR(reach, 6.0 * event.deltaV / 26.4, 0.25);
  }
}

TEST_F(GlbExport, KeepsAsManyKeysAsAsked) {
  const Recording run = testRailRun();  // 100 poses a second for 4.2 s
  const aiNodeAnim& saloon =
      animationOf(readBack(testRail(), run, {.keysPerSecond = 20.0}), "saloon");
  EXPECT_NEAR(saloon.mNumPositionKeys, 4.2 * 20.0, 2.0);
  const std::vector<RecordedPose>& poses = run.vehicles()[0].poses;
  EXPECT_NEAR(saloon.mPositionKeys[0].mTime / inFile, poses.front().time, 1e-6);
  EXPECT_NEAR(saloon.mPositionKeys[saloon.mNumPositionKeys - 1].mTime / inFile, poses.back().time,
              1e-6);
}

TEST_F(GlbExport, OfPosesAtOneTimeTheLastCounts) {
  Recording run;
  const std::size_t saloon = run.addVehicle("saloon", bumper::testing::saloon());
  for (const auto& [time, x] : {std::pair(5.0, 1.0), std::pair(5.0, 2.0), std::pair(6.0, 3.0)}) {
    RecordedPose pose;
    pose.time = time;
    pose.position.x() = x;
    run.addPose(saloon, pose);
  }
  const aiScene& read = readBack(testRail(), run);
  const aiNodeAnim& moving = animationOf(read, "saloon");
  ASSERT_EQ(moving.mNumPositionKeys, 2U);
  EXPECT_NEAR((middleOf(read) + toVector(moving.mPositionKeys[0].mValue)).x(), 2.0, allowed);
  EXPECT_NEAR(moving.mPositionKeys[0].mTime, 0.0, 1e-9);  // the recording begins at 5 s
  EXPECT_NEAR(moving.mPositionKeys[1].mTime / inFile, 1.0, 1e-6);
}

TEST_F(GlbExport, RefusesWhatItCannotWrite) {
  const Scene scene = testRail();
  EXPECT_THAT([&] { writeGlb(scene, Recording(), file_); },
              ThrowsMessage<Error>(HasSubstr("no pose")));
  EXPECT_THAT([&] { writeGlb(scene, testRailRun(), file_, {.sceneReach = -1.0}); },
              ThrowsMessage<Error>(HasSubstr("sceneReach")));
  EXPECT_THAT([&] { writeGlb(scene, testRailRun(), file_, {.keysPerSecond = 0.0}); },
              ThrowsMessage<Error>(HasSubstr("keysPerSecond")));
  EXPECT_THAT([&] { writeGlb(Scene(), testRailRun(), file_); },
              ThrowsMessage<Error>(HasSubstr("triangle")));
  const auto nowhere = folder_.path() / "missing" / "run.glb";
  EXPECT_THAT([&] { writeGlb(scene, testRailRun(), nowhere); },
              ThrowsMessage<Error>(HasSubstr(nowhere.string())));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

// For the validator, which runs after this test.
TEST_F(GlbExport, LeavesFilesForTheValidator) {
  const std::filesystem::path kept = GLB_FOLDER;
  std::filesystem::create_directories(kept);
  writeGlb(testRail(), testRailRun(), kept / "test_rail.glb");
  writeGlb(course(), courseRun(), kept / "course.glb");
  writeGlb(testRail(), standingVehicle({10.0, 0.0}, 0.3), kept / "standing.glb");
}

}  // namespace
}  // namespace bumper::testing
