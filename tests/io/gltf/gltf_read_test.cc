// The reader against the oracle of tests/io/gltf_oracle.h, on real characters and on made ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/gltf/clip.h"
#include "io/recognition/recognise.h"
#include "model/geometry/so3.h"
#include "model/rig/binding.h"
#include "tests/io/gltf/gltf_maker.h"
#include "tests/io/gltf/gltf_oracle.h"

namespace retarget::io {
namespace {

// Time in the file of a frame.
double TimeOf(const GltfClip& clip, const GltfOracle& oracle, int animation, int frame) {
  if (animation < 0) return 0;
  if (!clip.key_times.empty()) return clip.key_times[static_cast<size_t>(frame)];
  return oracle.Span(animation).first + frame * clip.motion.frame_time;
}

struct Worst {
  double position = 0, rotation = 0;  // m, rad
};

void Compare(const GltfClip& clip, const RigFrame& frame, const std::vector<Matrix4>& globals,
             Worst* worst) {
  const PosedRig posed = PoseRig(clip.motion.rig, frame);
  for (size_t j = 0; j < clip.joints.size(); ++j) {
    const Matrix4& global = globals[static_cast<size_t>(clip.joints[j].node)];
    const Mat3 rotation = global.topLeftCorner<3, 3>().colwise().normalized();
    worst->position =
        std::max(worst->position, (posed.position[j] - Vec3(global.topRightCorner<3, 1>())).norm());
    worst->rotation = std::max(worst->rotation, posed.rotation[j].angularDistance(Quat(rotation)));
  }
}

// Every joint at every frame, and half way between frames where the file is linear there.
Worst CompareAll(const GltfClip& clip, const GltfOracle& oracle, int animation,
                 bool between_frames) {
  Worst worst;
  for (int k = 0; k < clip.motion.num_frames(); ++k) {
    const double time = TimeOf(clip, oracle, animation, k);
    Compare(clip, clip.motion.frames[static_cast<size_t>(k)], oracle.Globals(animation, time),
            &worst);
    if (!between_frames || k + 1 == clip.motion.num_frames()) continue;
    const double u = 0.5;
    const double middle = (1 - u) * time + u * TimeOf(clip, oracle, animation, k + 1);
    Compare(clip, SampleRig(clip.motion, (k + u) * clip.motion.frame_time),
            oracle.Globals(animation, middle), &worst);
  }
  return worst;
}

std::string MessageOf(const std::string& bytes, const GltfSelect& select = {}) {
  try {
    ParseGltf(bytes, "a.glb", "", select);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// ---- Real characters.

class RealCharacter : public testing::TestWithParam<const char*> {};

TEST_P(RealCharacter, PlaysAsTheSpecificationSays) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string path = SharedPath("data/characters/") + GetParam();
  const GltfOracle oracle(ReadWholeFile(path), SharedPath("data/characters"));
  const int animations =
      oracle.document.contains("animations") ? int(oracle.document["animations"].size()) : 0;
  for (int a = std::min(animations - 1, 0); a < animations; ++a) {
    const GltfClip clip = ReadGltf(path, {a < 0 ? "" : std::to_string(a), ""});
    EXPECT_EQ(clip.notes, std::vector<std::string>());
    const bool steps = path.find("mixamo") != std::string::npos;
    const double size = path.find("Fox") != std::string::npos ? 100 : 1;  // it is a giant
    const Worst worst = CompareAll(clip, oracle, a, !steps);
    EXPECT_LT(worst.position, 2e-6 * size);
    EXPECT_LT(worst.rotation, 2e-6);
    if (animations == 0) {
      EXPECT_EQ(clip.motion.num_frames(), 1);
      EXPECT_TRUE(clip.key_times.empty());
    } else if (clip.animation == "Run") {  // a gap of 4.8 frames of 24 per second in its midst
      EXPECT_NEAR(1 / clip.motion.frame_time, 120, 1e-9);
      EXPECT_TRUE(clip.key_times.empty());
    } else {
      EXPECT_NEAR(1 / clip.motion.frame_time, steps ? 30 : 24, 1e-9);
      ASSERT_FALSE(clip.key_times.empty());
      EXPECT_EQ(clip.key_times.front(), oracle.Span(a).first);
      EXPECT_EQ(clip.key_times.back(), oracle.Span(a).second);
    }
  }
}

class RealHuman : public testing::TestWithParam<const char*> {};

TEST_P(RealHuman, BindsToTheBodyAndBack) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string file = GetParam();
  const GltfClip clip = ReadGltf(SharedPath("data/characters/") + file);
  RecogniseOptions metres;
  metres.metres_per_unit = 1;
  const RigFacts facts = Recognise(clip.motion, metres, file);
  EXPECT_EQ(facts.up, 'y');
  EXPECT_GT(facts.stature, 1.3);
  EXPECT_LT(facts.stature, 1.9);
  const RigBinding binding(clip.motion, facts, ChestBone(clip.motion, facts.map), 0);
  double worst = 0;
  for (const RigFrame& frame : clip.motion.frames) {
    const PosedRig before = PoseRig(clip.motion.rig, frame);
    const PosedRig after = PoseRig(clip.motion.rig, binding.Apply(frame, binding.PoseOf(frame)));
    for (size_t j = 0; j < before.position.size(); ++j) {
      worst = std::max(worst, (before.position[j] - after.position[j]).norm());
    }
  }
  EXPECT_LT(worst, 1e-9);
  const std::vector<double> radius = BoneRadii(clip);
  for (const auto& [joint, least, most] : {std::tuple(facts.map.left.shoulder, 0.03, 0.09),
                                           {facts.map.left.elbow, 0.025, 0.07},
                                           {facts.map.left.hip, 0.05, 0.12},
                                           {facts.map.right.hip, 0.05, 0.12},
                                           {facts.map.right.knee, 0.03, 0.08},
                                           {facts.map.head, 0.07, 0.2}}) {
    EXPECT_GT(radius[static_cast<size_t>(joint)], least) << clip.motion.rig.joints[joint].name;
    EXPECT_LT(radius[static_cast<size_t>(joint)], most) << clip.motion.rig.joints[joint].name;
  }
}

std::string TestName(const testing::TestParamInfo<const char*>& file) {
  std::string name = file.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Files, RealCharacter,
                         testing::Values("Fox.glb", "cesium_man.gltf", "rigged_simple.gltf",
                                         "m2m_human-male.glb", "m2m_mixamo-sample-rig.glb"),
                         TestName);
INSTANTIATE_TEST_SUITE_P(Files, RealHuman,
                         testing::Values("cesium_man.gltf", "m2m_human-male.glb",
                                         "m2m_mixamo-sample-rig.glb"),
                         TestName);

// ---- Made characters.

TEST(GltfRead, FoldsWhatIsAboveTheJointsAndKeepsWhatIsBetween) {
  GltfMaker maker = AwkwardCharacter();
  const GltfClip still = ParseGltf(maker.Glb(), "a.glb", "");
  std::vector<std::string> names;
  std::vector<int> parents;
  for (const RigJoint& joint : still.motion.rig.joints) {
    names.push_back(joint.name);
    parents.push_back(joint.parent);
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"hips", "between", "chest", "joint_5", "leaf", "chest_8"}));
  EXPECT_EQ(parents, (std::vector<int>{-1, 0, 1, 2, 3, 0}));
  EXPECT_EQ(still.motion.num_frames(), 1);
  const Worst worst = CompareAll(still, GltfOracle(maker.Glb()), -1, false);
  EXPECT_LT(worst.position, 1e-12);
  EXPECT_LT(worst.rotation, 1e-7);  // an angle near zero, from a cosine near one
  // In metres: the hips stand 90 cm along the armature's axis, the leaf 8 cm x 2 x 0.5 away.
  EXPECT_NEAR(still.motion.frames[0].translation[4].norm(), 0.08, 1e-9);
}

TEST(GltfRead, MovesAnimatedNodesAboveTheJoints) {
  GltfMaker maker = AwkwardCharacter();
  std::mt19937 random(1);
  const int clip_index = maker.AddAnimation("walk");
  const int times = maker.AddArray(Times(7, 30, 0.5), "SCALAR");
  maker.AddChannel(clip_index, 0, "translation", times,
                   maker.AddArray(SomeTranslations(&random, 7, Vec3(1, 0, 2)), "VEC3"));
  maker.AddChannel(clip_index, 8, "rotation", times,
                   maker.AddArray(SomeRotations(&random, 7), "VEC4"));
  maker.AddChannel(clip_index, 7, "translation", times,
                   maker.AddArray(SomeTranslations(&random, 7, Vec3(1, 0, 2)), "VEC3"));
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  ASSERT_EQ(clip.motion.rig.joints[0].name, "armature");
  EXPECT_TRUE(clip.motion.rig.joints[0].translates);
  EXPECT_EQ(clip.motion.rig.joints[1].name, "turned");
  EXPECT_FALSE(clip.motion.rig.joints[1].translates);
  EXPECT_EQ(clip.motion.rig.Find("prop"), 7) << "animated, though it carries a mesh";
  EXPECT_EQ(clip.key_times.size(), 7U);
  EXPECT_EQ(clip.key_times[0], 0.5);
  const Worst worst = CompareAll(clip, GltfOracle(maker.Glb()), 0, true);
  EXPECT_LT(worst.position, 1e-7);
  EXPECT_LT(worst.rotation, 1e-6);
}

// Every interpolation, in floats and in normalised integers, with keys that are each track's own.
TEST(GltfRead, InterpolatesByTheSpecificationsFormulas) {
  for (const std::string kind : {"LINEAR", "STEP", "CUBICSPLINE"}) {
    std::mt19937 random(2);
    GltfMaker maker = AwkwardCharacter();
    const int a = maker.AddAnimation(kind);
    const int per_key = kind == "CUBICSPLINE" ? 3 : 1;
    const auto rotations = [&](int count) {
      std::vector<float> values = SomeRotations(&random, per_key * count);
      for (size_t i = 0; i < values.size(); ++i) {
        const bool tangent = per_key == 3 && (i / 4) % 3 != 1;
        if (tangent) values[i] *= 2.5F;
      }
      return values;
    };
    const std::vector<float> bytes = rotations(4);
    std::vector<std::int8_t> small;
    std::vector<std::int16_t> medium;
    for (const float v : bytes) {
      small.push_back(static_cast<std::int8_t>(std::lround(std::clamp(v, -1.0F, 1.0F) * 127)));
      medium.push_back(static_cast<std::int16_t>(std::lround(std::clamp(v, -1.0F, 1.0F) * 32767)));
    }
    const int ten = maker.AddArray(Times(4, 10), "SCALAR");
    const int odd = maker.AddArray(std::vector<float>{0.03F, 0.1F, 0.15F, 0.41F}, "SCALAR");
    maker.AddChannel(a, 2, "translation", ten,
                     maker.AddArray(SomeTranslations(&random, 4 * per_key, Vec3(0, 90, 0)), "VEC3"),
                     kind);
    maker.AddChannel(a, 2, "rotation", odd, maker.AddArray(rotations(4), "VEC4"), kind);
    maker.AddChannel(a, 4, "rotation", ten, maker.AddArray(small, "VEC4", true), kind);
    maker.AddChannel(a, 8, "rotation", odd, maker.AddArray(medium, "VEC4", true), kind);
    maker.document["nodes"][2].erase("matrix");
    const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
    const GltfOracle oracle(maker.Glb());
    EXPECT_TRUE(clip.key_times.empty()) << "keys lie unevenly";
    EXPECT_GE(1 / clip.motion.frame_time, 30 - 1e-9);
    EXPECT_NEAR((clip.motion.num_frames() - 1) * clip.motion.frame_time, 0.41, 0.04);
    const Worst worst = CompareAll(clip, oracle, 0, false);
    EXPECT_LT(worst.position, 1e-7) << kind;
    EXPECT_LT(worst.rotation, 2e-6) << kind;
  }
}

TEST(GltfRead, ChoosesTheRateOfTheKeys) {
  const auto read = [](const std::vector<std::vector<float>>& key_times,
                       const std::string& kind = "LINEAR") {
    std::mt19937 random(3);
    GltfMaker maker = AwkwardCharacter();
    maker.document["nodes"][2].erase("matrix");
    const int a = maker.AddAnimation("a");
    const int nodes[] = {2, 4, 8};
    for (size_t t = 0; t < key_times.size(); ++t) {
      const int count = static_cast<int>(key_times[t].size()) * (kind == "CUBICSPLINE" ? 3 : 1);
      maker.AddChannel(a, nodes[t], "rotation", maker.AddArray(key_times[t], "SCALAR"),
                       maker.AddArray(SomeRotations(&random, count), "VEC4"), kind);
    }
    return ParseGltf(maker.Glb(), "a.glb", "");
  };
  GltfClip clip = read({Times(20000, 30, 3)});  // late keys are rounded by a quarter millisecond
  EXPECT_EQ(clip.motion.frame_time, 1.0 / 30);
  EXPECT_EQ(clip.key_times.size(), 20000U);
  clip = read({Times(10, 25), Times(4, 12.5)});  // a union that is even
  EXPECT_EQ(clip.motion.frame_time, 1.0 / 25);
  EXPECT_EQ(clip.key_times.size(), 10U);
  clip = read({{0, 0.1F, 1.0F}, {0, 0.2F, 0.7F}});  // reduced keys on a grid of ten per second
  EXPECT_EQ(clip.motion.frame_time, 1.0 / 10);
  EXPECT_EQ(clip.motion.num_frames(), 11);
  EXPECT_TRUE(clip.key_times.empty());
  clip = read({Times(101, 1000)});  // faster than any character needs
  EXPECT_EQ(clip.motion.frame_time, 1.0 / 240);
  EXPECT_EQ(clip.motion.num_frames(), 25);
  clip = read({Times(3, 1)}, "STEP");  // slow steps: lines between them would glide
  EXPECT_EQ(clip.motion.frame_time, 1.0 / 30);
  EXPECT_EQ(clip.motion.num_frames(), 61);
  clip = read({Times(3, 24)}, "CUBICSPLINE");
  EXPECT_EQ(clip.motion.frame_time, 1.0 / 48);
  EXPECT_EQ(clip.motion.num_frames(), 5);
  clip = read({{0.25F}});
  EXPECT_EQ(clip.motion.num_frames(), 1);
  EXPECT_EQ(clip.key_times, std::vector<double>{0.25});
}

TEST(GltfRead, FoldsConstantScaleTracksAndTellsOfOthers) {
  for (const bool constant : {true, false}) {
    GltfMaker maker = AwkwardCharacter();
    maker.document["nodes"][2].erase("matrix");
    const int a = maker.AddAnimation("a");
    const int times = maker.AddArray(Times(2, 30), "SCALAR");
    std::mt19937 random(4);
    maker.AddChannel(a, 2, "rotation", times, maker.AddArray(SomeRotations(&random, 2), "VEC4"));
    const float last = constant ? 3.0F : 4.0F;
    maker.AddChannel(a, 4, "scale", times,
                     maker.AddArray<float>({3, 3, 3, last, last, last}, "VEC3"));
    const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
    Worst worst;
    const GltfOracle oracle(maker.Glb());
    Compare(clip, clip.motion.frames[0], oracle.Globals(0, 0), &worst);
    if (constant) Compare(clip, clip.motion.frames[1], oracle.Globals(0, 1), &worst);
    EXPECT_LT(worst.position, 1e-9);
    EXPECT_LT(worst.rotation, 1e-6);
    ASSERT_EQ(clip.notes.size(), constant ? 0U : 1U);
    if (!constant) {
      EXPECT_NE(clip.notes[0].find("change their scale"), std::string::npos);
    }
  }
}

TEST(GltfRead, ReadsABareSkeletonByWhatMoves) {
  GltfMaker maker;
  const int world = maker.AddNode("world", -1, Vec3(0, 1, 0));
  const int hip = maker.AddNode("hip", world, Vec3(0, 0.1, 0));
  const int rigid = maker.AddNode("rigid", hip, Vec3(0, 0.2, 0));
  const int knee = maker.AddNode("knee", rigid, Vec3(0, 0.3, 0));
  maker.AddNode("foot", knee, Vec3(0, 0.4, 0));
  maker.AddNode("bystander", world, Vec3(0, 0.5, 0));
  EXPECT_EQ(MessageOf(maker.Glb()), "a.glb: no skin and no animation, expected a character");
  std::mt19937 random(6);
  const int a = maker.AddAnimation("a");
  const int times = maker.AddArray(Times(5, 60), "SCALAR");
  for (const int node : {hip, knee}) {
    maker.AddChannel(a, node, "rotation", times, maker.AddArray(SomeRotations(&random, 5), "VEC4"));
  }
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  std::vector<std::string> names;
  for (const RigJoint& joint : clip.motion.rig.joints) names.push_back(joint.name);
  EXPECT_EQ(names, (std::vector<std::string>{"hip", "rigid", "knee", "foot"}));
  EXPECT_LT(CompareAll(clip, GltfOracle(maker.Glb()), 0, true).position, 1e-6);
}

TEST(GltfRead, TellsAnimationsAndCharactersApart) {
  GltfMaker maker = AwkwardCharacter();
  maker.document["nodes"][2].erase("matrix");
  const int other = maker.AddNode("other", -1, Vec3(2, 0, 0));
  maker.AddNode("other tip", other, Vec3(0, 1, 0));
  maker.document["skins"].push_back({{"joints", {8}}});  // the first's clothes
  maker.document["skins"].push_back({{"name", "two"}, {"joints", {other, other + 1}}});
  std::mt19937 random(7);
  const int times = maker.AddArray(Times(3, 30), "SCALAR");
  for (const char* name : {"walk", "run", "1"}) {
    const int a = maker.AddAnimation(name);
    for (const int node : {2, other}) {
      maker.AddChannel(a, node, "rotation", times,
                       maker.AddArray(SomeRotations(&random, 3), "VEC4"));
    }
  }
  const std::string bytes = maker.Glb();
  EXPECT_EQ(MessageOf(bytes), "a.glb: 3 animations, select one: 0 \"walk\", 1 \"run\", 2 \"1\"");
  EXPECT_EQ(MessageOf(bytes, {"run", ""}),
            "a.glb: 2 characters, select one by its skin: skin 0 \"person\", skin 1, "
            "skin 2 \"two\"; or as #figure=0 (hips), #figure=1 (other)");
  EXPECT_EQ(MessageOf(bytes, {"fly", "two"}),
            "a.glb: no animation \"fly\", expected one of 0 \"walk\", 1 \"run\", 2 \"1\"");
  for (const char* figure : {"1", "other", "two"}) {
    const GltfClip clip = ParseGltf(bytes, "a.glb", "", {"run", "", figure});
    EXPECT_EQ(clip.motion.rig.joints[0].name, "other") << figure;
    EXPECT_TRUE(clip.is_one_of_several);
  }
  EXPECT_EQ(ParseGltf(bytes, "a.glb", "", {"run", "", "0"}).skins, (std::vector<int>{0, 1}));
  EXPECT_EQ(MessageOf(bytes, {"run", "", "2"}),
            "a.glb: no figure \"2\", expected one of #figure=0 (hips), #figure=1 (other)");
  EXPECT_NE(MessageOf(bytes, {"run", "3"}).find("no skin \"3\""), std::string::npos);
  const auto root = [&](const char* animation, const char* skin) {
    const GltfClip clip = ParseGltf(bytes, "a.glb", "", {animation, skin});
    return clip.animation + "/" + clip.motion.rig.joints[0].name + "/" +
           std::to_string(clip.joints.size());
  };
  EXPECT_EQ(root("0", "0"), "walk/hips/6");
  EXPECT_EQ(root("run", "1"), "run/hips/6");
  EXPECT_EQ(root("1", "two"), "1/other/2") << "a name goes before an index";
  EXPECT_EQ(root("2", "2"), "1/other/2");
}

// The pose that the skin is bound in is the rest pose, whatever pose the nodes show.
TEST(GltfRead, TakesTheRestPoseFromTheSkinWhereTheNodesShowAnother) {
  GltfMaker bound = AwkwardCharacter();
  const std::vector<Matrix4> globals = GltfOracle(bound.Glb()).Globals(-1, 0);
  std::vector<float> inverse;
  const Matrix4 elsewhere =
      (Eigen::Translation3d(4, 5, 6) * Eigen::AngleAxisd(1, Vec3::UnitZ())).matrix();
  for (const int node : {2, 4, 5, 8}) {
    const Matrix4 m = (elsewhere * globals[static_cast<size_t>(node)]).inverse();
    for (int i = 0; i < 16; ++i) inverse.push_back(static_cast<float>(m.data()[i]));
  }
  const GltfClip rest = ParseGltf(bound.Glb(), "a.glb", "");
  const int accessor = bound.AddArray(inverse, "MAT4");
  bound.document["skins"][0]["inverseBindMatrices"] = accessor;
  std::mt19937 random(8);
  for (const int node : {4, 5, 8}) {
    const Quat q = SomeRotation(&random);
    bound.document["nodes"][node]["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  }
  const GltfClip posed = ParseGltf(bound.Glb(), "a.glb", "");
  EXPECT_LT(CompareAll(posed, GltfOracle(bound.Glb()), -1, false).position, 1e-9)
      << "the frame shows the nodes";
  for (size_t j = 0; j < rest.joints.size(); ++j) {
    const RigJoint& expected = rest.motion.rig.joints[j];
    const RigJoint& found = posed.motion.rig.joints[j];
    EXPECT_LT(found.rest_rotation.angularDistance(rest.motion.frames[0].rotation[j]), 1e-4)
        << found.name;
    EXPECT_LT((found.offset - expected.offset).norm(), 1e-4);
    EXPECT_LT(expected.rest_rotation.angularDistance(rest.motion.frames[0].rotation[j]), 1e-7);
  }
  EXPECT_GT(
      posed.motion.rig.joints[2].rest_rotation.angularDistance(posed.motion.frames[0].rotation[2]),
      0.1);
}

TEST(GltfRead, MeasuresBonesByTheirFlesh) {
  GltfMaker maker;
  const double unit = 0.01, radius = 0.06;  // the armature's, and the leg's in metres
  maker.AddNode("armature", -1, Vec3(0, 1, 0), Quat(Eigen::AngleAxisd(1, Vec3::UnitX())), unit);
  maker.AddNode("hip", 0, Vec3(5, 0, 0));
  maker.AddNode("knee", 1, Vec3(0, 40, 0));
  const std::vector<Matrix4> globals = GltfOracle(maker.Glb()).Globals(-1, 0);
  // Tubes about both bones in the skin's own space, and a fifth as many stray vertices.
  std::vector<float> position, weights, inverse;
  std::vector<std::uint16_t> joints;
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int v = 0; v < 240; ++v) {
    const double angle = v * kPi * (3 - std::sqrt(5)), r = v % 12 >= 10 ? 0.5 : radius;
    const std::uint16_t joint = v % 2 == 0 ? 0 : 1;
    const Eigen::Vector4d local(r / unit * std::cos(angle), 40 * uniform(random),
                                r / unit * std::sin(angle), 1);
    const Vec3 at = (globals[joint + 1U] * local).head<3>();
    for (const float f : Floats(at)) position.push_back(f);
    joints.insert(joints.end(), {static_cast<std::uint16_t>(1 - joint), joint, 0, 0});
    weights.insert(weights.end(), {0.3F, 0.7F, 0, 0});
  }
  for (const size_t node : {1U, 2U}) {
    const Matrix4 m = globals[node].inverse();
    for (int i = 0; i < 16; ++i) inverse.push_back(static_cast<float>(m.data()[i]));
  }
  const int p = maker.AddArray(position, "VEC3"), j = maker.AddArray(joints, "VEC4"),
            w = maker.AddArray(weights, "VEC4"), b = maker.AddArray(inverse, "MAT4");
  maker.document["meshes"].push_back(
      {{"primitives", {{{"attributes", {{"POSITION", p}, {"JOINTS_0", j}, {"WEIGHTS_0", w}}}}}}});
  maker.document["skins"].push_back({{"joints", {1, 2}}, {"inverseBindMatrices", b}});
  maker.AddNode("mesh", -1, Vec3::Zero());
  maker.document["nodes"][3]["mesh"] = 0;
  maker.document["nodes"][3]["skin"] = 0;
  const std::vector<double> radii = BoneRadii(ParseGltf(maker.Glb(), "a.glb", ""));
  ASSERT_EQ(radii.size(), 2U);
  EXPECT_NEAR(radii[0], radius, 1e-4);
  EXPECT_NEAR(radii[1], radius, 0.02) << "a leaf's axis is where its flesh is";
}

// ---- VRM.

constexpr const char* kVrmBones[] = {"hips",
                                     "spine",
                                     "chest",
                                     "upperChest",
                                     "neck",
                                     "head",
                                     "leftShoulder",
                                     "leftUpperArm",
                                     "leftLowerArm",
                                     "leftHand",
                                     "rightShoulder",
                                     "rightUpperArm",
                                     "rightLowerArm",
                                     "rightHand",
                                     "leftUpperLeg",
                                     "leftLowerLeg",
                                     "leftFoot",
                                     "leftToes",
                                     "rightUpperLeg",
                                     "rightLowerLeg",
                                     "rightFoot",
                                     "rightToes",
                                     "leftMiddleProximal"};

// A T-pose of plain names that tell nothing, 1.6 m tall, facing +Z or -Z. Node of bone i is 1 + i.
GltfMaker VrmFigure(bool faces_minus_z) {
  const std::map<std::string, std::pair<std::string, Vec3>> figure = {
      {"hips", {"", {0, 0.9, 0}}},
      {"spine", {"hips", {0, 0.1, 0}}},
      {"chest", {"spine", {0, 0.15, 0}}},
      {"upperChest", {"chest", {0, 0.1, 0}}},
      {"neck", {"upperChest", {0, 0.15, 0}}},
      {"head", {"neck", {0, 0.08, 0}}},
      {"Shoulder", {"upperChest", {0.04, 0.1, 0}}},
      {"UpperArm", {"Shoulder", {0.12, 0, 0}}},
      {"LowerArm", {"UpperArm", {0.26, 0, 0}}},
      {"Hand", {"LowerArm", {0.24, 0, 0}}},
      {"MiddleProximal", {"Hand", {0.08, 0, 0}}},
      {"UpperLeg", {"hips", {0.08, -0.03, 0}}},
      {"LowerLeg", {"UpperLeg", {0, -0.4, 0}}},
      {"Foot", {"LowerLeg", {0, -0.38, 0}}},
      {"Toes", {"Foot", {0, -0.06, 0.12}}}};
  GltfMaker maker;
  maker.AddNode("top", -1, Vec3::Zero());
  std::map<std::string, int> node;
  for (size_t i = 0; i < std::size(kVrmBones); ++i) {
    const std::string bone = kVrmBones[i];
    const std::string side = bone.starts_with("left")    ? "left"
                             : bone.starts_with("right") ? "right"
                                                         : "";
    const auto& [above, offset] = figure.at(bone.substr(side.size()));
    Vec3 at = offset;
    if (side == "right") at.x() *= -1;
    if (faces_minus_z) at = Vec3(-at.x(), at.y(), -at.z());
    const int parent = above.empty()                 ? 0
                       : node.contains(side + above) ? node.at(side + above)
                                                     : node.at(above);
    node[bone] = maker.AddNode("n" + std::to_string(i), parent, at);
  }
  return maker;
}

int NodeOfBone(const std::string& bone) {
  const auto it = std::find(std::begin(kVrmBones), std::end(kVrmBones), bone);
  return 1 + static_cast<int>(it - std::begin(kVrmBones));
}

void CheckVrmMap(const GltfClip& clip) {
  ASSERT_TRUE(clip.map.has_value());
  const JointMap& map = *clip.map;
  EXPECT_EQ(map.profile, "vrm");
  const auto is = [&](int joint, const std::string& bone) {
    ASSERT_GE(joint, 0) << bone;
    EXPECT_EQ(clip.joints[static_cast<size_t>(joint)].node, NodeOfBone(bone)) << bone;
  };
  is(map.root, "hips");
  ASSERT_EQ(map.spine.size(), 3U);
  is(map.spine[0], "spine");
  is(map.spine[1], "chest");
  is(map.spine[2], "upperChest");
  ASSERT_EQ(map.neck.size(), 1U);
  is(map.neck[0], "neck");
  is(map.head, "head");
  is(map.left.clavicle, "leftShoulder");
  is(map.left.shoulder, "leftUpperArm");
  is(map.left.elbow, "leftLowerArm");
  is(map.left.wrist, "leftHand");
  is(map.left.hand, "leftMiddleProximal");
  is(map.right.hip, "rightUpperLeg");
  is(map.right.knee, "rightLowerLeg");
  is(map.right.ankle, "rightFoot");
  is(map.right.toe, "rightToes");
  EXPECT_EQ(map.right.hand, -1);
}

// What a map does: the resting figure is the body's own rest pose.
void CheckVrmBinding(const GltfClip& clip) {
  RigFacts facts;
  facts.map = *clip.map;
  facts.metres_per_unit = 1;
  const RigBinding binding(clip.motion, facts, ChestBone(clip.motion, facts.map), 0);
  const Pose pose = binding.PoseOf(clip.motion.frames[0]);
  const double facing = clip.faces_minus_z ? kPi : 0;
  EXPECT_LT(pose.rotation[0].angularDistance(YawRotation(facing)), 1e-6);
  for (const std::string link : {"left_shoulder", "right_elbow", "left_hip", "chest"}) {
    const Quat& q = pose.rotation[static_cast<size_t>(binding.body().FindLink(link))];
    EXPECT_LT(q.angularDistance(Quat::Identity()), 1e-6) << link;
  }
}

TEST(GltfVrm, Vrm1SaysWhichBoneIsWhich) {
  GltfMaker maker = VrmFigure(false);
  auto& bones = maker.document["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"];
  for (const char* bone : kVrmBones) bones[bone]["node"] = NodeOfBone(bone);
  maker.document["skins"].push_back({{"joints", {1, 2}}});
  const GltfClip clip = ParseGltf(maker.Glb(), "a.vrm", "");
  CheckVrmMap(clip);
  EXPECT_FALSE(clip.faces_minus_z);
  CheckVrmBinding(clip);
}

TEST(GltfVrm, Vrm0SaysItInAListAndFacesBackwards) {
  GltfMaker maker = VrmFigure(true);
  auto& bones = maker.document["extensions"]["VRM"]["humanoid"]["humanBones"];
  for (const char* bone : kVrmBones) bones.push_back({{"bone", bone}, {"node", NodeOfBone(bone)}});
  bones.push_back({{"bone", "jaw"}, {"node", -1}});
  const GltfClip clip = ParseGltf(maker.Glb(), "a.vrm", "");
  CheckVrmMap(clip);
  EXPECT_TRUE(clip.faces_minus_z);
  CheckVrmBinding(clip);
}

// A rig whose bones have axes of their own, and a motion that never stands: only its rest pose, a
// T-pose, tells which way its bones go.
TEST(GltfVrm, BindsByTheRestPoseWhereNoFrameStands) {
  GltfMaker maker = VrmFigure(false);
  auto& bones = maker.document["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"];
  for (const char* bone : kVrmBones) bones[bone]["node"] = NodeOfBone(bone);
  const GltfOracle straight(maker.Glb());
  std::mt19937 random(23);
  std::vector<Quat> axes = {Quat::Identity()};
  for (size_t n = 1; n < straight.parent.size(); ++n) {
    axes.push_back(SomeRotation(&random, 2));
    const Quat& above = axes[static_cast<size_t>(straight.parent[n])];
    auto& node = maker.document["nodes"][n];
    const auto offset = node["translation"].get<std::vector<double>>();
    const Vec3 t = above.conjugate() * Vec3::Map(offset.data());
    const Quat q = above.conjugate() * axes[n];
    node["translation"] = {t.x(), t.y(), t.z()};
    node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  }
  const GltfClip clip = ParseGltf(maker.Glb(), "a.vrm", "");
  RigMotion tumbling = clip.motion;
  for (Quat& q : tumbling.frames[0].rotation) q = q * SomeRotation(&random);
  RigFacts facts;
  facts.map = *clip.map;
  facts.metres_per_unit = 1;
  const RigBinding binding(tumbling, facts, ChestBone(tumbling, facts.map), 0);
  const Pose pose = binding.PoseOf(clip.motion.frames[0]);
  for (const std::string link :
       {"left_shoulder", "right_elbow", "left_hip", "left_knee", "chest", "waist"}) {
    const Quat& q = pose.rotation[static_cast<size_t>(binding.body().FindLink(link))];
    EXPECT_LT(q.angularDistance(Quat::Identity()), 1e-6) << link;
  }
}

TEST(GltfVrm, VrmaBringsTheMotionOfABareSkeleton) {
  GltfMaker maker = VrmFigure(false);
  auto& bones = maker.document["extensions"]["VRMC_vrm_animation"]["humanoid"]["humanBones"];
  for (const char* bone : kVrmBones) bones[bone]["node"] = NodeOfBone(bone);
  std::mt19937 random(10);
  const int a = maker.AddAnimation("clip");
  const int times = maker.AddArray(Times(4, 30), "SCALAR");
  maker.AddChannel(a, 1, "translation", times,
                   maker.AddArray(SomeTranslations(&random, 4, Vec3(0, 0.9, 0)), "VEC3"));
  maker.AddChannel(a, NodeOfBone("leftUpperArm"), "rotation", times,
                   maker.AddArray(SomeRotations(&random, 4), "VEC4"));
  const GltfClip clip = ParseGltf(maker.Glb(), "a.vrma", "");
  CheckVrmMap(clip);
  EXPECT_EQ(clip.joints.size(), std::size(kVrmBones)) << "bones that do not move count too";
  EXPECT_EQ(clip.motion.num_frames(), 4);
  EXPECT_LT(CompareAll(clip, GltfOracle(maker.Glb()), 0, true).position, 1e-6);
}

// A character with a tube of skin about its two bones.
GltfMaker SkinnedTube() {
  GltfMaker maker;
  maker.AddNode("hip", -1, Vec3(0, 0, 0));
  maker.AddNode("knee", 0, Vec3(0, 0.4, 0));
  std::vector<float> position, weights;
  std::vector<std::uint16_t> joints;
  for (int v = 0; v < 40; ++v) {
    for (const float f : Floats(Vec3(0.1 * std::cos(v), 0.02 * v, 0.1 * std::sin(v)))) {
      position.push_back(f);
    }
    joints.insert(joints.end(), {static_cast<std::uint16_t>(v / 20), 0, 0, 0});
    weights.insert(weights.end(), {1, 0, 0, 0});
  }
  std::vector<float> inverse;
  for (const double y : {0.0, -0.4}) {
    for (const float f : {1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., y, 0., 1.}) {
      inverse.push_back(f);
    }
  }
  const int p = maker.AddArray(position, "VEC3"), j = maker.AddArray(joints, "VEC4"),
            w = maker.AddArray(weights, "VEC4"), b = maker.AddArray(inverse, "MAT4");
  maker.document["meshes"].push_back(
      {{"primitives", {{{"attributes", {{"POSITION", p}, {"JOINTS_0", j}, {"WEIGHTS_0", w}}}}}}});
  maker.document["skins"].push_back({{"joints", {0, 1}}, {"inverseBindMatrices", b}});
  maker.AddNode("mesh", -1, Vec3::Zero());
  maker.document["nodes"][2]["mesh"] = 0;
  maker.document["nodes"][2]["skin"] = 0;
  return maker;
}

TEST(GltfCompression, ASkinThatCannotBeReadIsSaidAndHasNoWidth) {
  const auto radii = [](const GltfClip& clip) { return BoneRadii(clip); };
  const GltfClip plain = ParseGltf(SkinnedTube().Glb(), "a.glb", "");
  EXPECT_TRUE(plain.notes.empty());
  EXPECT_NEAR(radii(plain)[0], 0.1, 1e-3);

  GltfMaker draco = SkinnedTube();
  draco.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  draco.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  draco.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}}}};
  for (int a = 0; a < 3; ++a) draco.document["accessors"][a].erase("bufferView");

  GltfMaker meshopt = SkinnedTube();
  meshopt.document["extensionsUsed"] = {"EXT_meshopt_compression"};
  meshopt.document["extensionsRequired"] = {"EXT_meshopt_compression"};
  meshopt.document["buffers"][1] = {{"byteLength", 4096}};
  meshopt.document["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  for (int v = 0; v < 3; ++v) {
    auto& view = meshopt.document["bufferViews"][v];
    view["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0}, {"byteLength", 16}, {"byteStride", 4}, {"count", 4}, {"mode", "ATTRIBUTES"}};
    view["buffer"] = 1;
  }

  for (const auto& [maker, name] :
       {std::pair(&draco, "KHR_draco_mesh_compression"), {&meshopt, "EXT_meshopt_compression"}}) {
    const GltfClip clip = ParseGltf(maker->Glb(), "a.glb", "");
    ASSERT_EQ(clip.notes.size(), 1U) << name;
    EXPECT_EQ(clip.notes[0],
              std::string("the mesh is compressed (") + name +
                  "): the width of the skin cannot be read, and capsules are as wide as tabulated "
                  "where they would follow it; export it uncompressed");
    EXPECT_EQ(radii(clip), std::vector<double>(2, 0.0)) << name;
  }

  // What the motion or the rig needs cannot be done without.
  meshopt.document["bufferViews"][3]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
  EXPECT_EQ(MessageOf(meshopt.Glb()),
            "a.glb: its data are compressed (EXT_meshopt_compression): export it uncompressed");
  // With a fallback that holds the data, the extension is not required.
  meshopt = SkinnedTube();
  meshopt.document["extensionsUsed"] = {"EXT_meshopt_compression"};
  meshopt.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
  EXPECT_NEAR(radii(ParseGltf(meshopt.Glb(), "a.glb", ""))[0], 0.1, 1e-3);
}

// A player of VRM animations takes the first; so do we.
TEST(GltfVrm, OfSeveralAnimationsOfAVrmaTheFirstIsMeant) {
  GltfMaker maker = VrmFigure(false);
  auto& bones = maker.document["extensions"]["VRMC_vrm_animation"]["humanoid"]["humanBones"];
  for (const char* bone : kVrmBones) bones[bone]["node"] = NodeOfBone(bone);
  std::mt19937 random(10);
  for (const int keys : {4, 7}) {
    const int a = maker.AddAnimation("clip" + std::to_string(keys));
    maker.AddChannel(a, 1, "rotation", maker.AddArray(Times(keys, 30), "SCALAR"),
                     maker.AddArray(SomeRotations(&random, keys), "VEC4"));
  }
  const GltfClip clip = ParseGltf(maker.Glb(), "a.vrma", "");
  EXPECT_EQ(clip.animation, "clip4");
  ASSERT_EQ(clip.notes.size(), 1U);
  EXPECT_NE(clip.notes[0].find("2 animations, the first is taken"), std::string::npos);
  GltfSelect second;
  second.animation = "clip7";
  EXPECT_EQ(ParseGltf(maker.Glb(), "a.vrma", "", second).motion.num_frames(), 7);
}

TEST(GltfVrm, LacksWhatTheModelLacksAndRefusesWhatCannotBe) {
  GltfMaker maker = VrmFigure(false);
  auto& bones = maker.document["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"];
  for (const std::string bone : kVrmBones) {
    const bool optional = bone == "chest" || bone == "upperChest" || bone == "neck" ||
                          bone == "leftShoulder" || bone == "leftToes";
    if (!optional) bones[bone]["node"] = NodeOfBone(bone);
  }
  const JointMap map = ParseGltf(maker.Glb(), "a.vrm", "").map.value();
  EXPECT_EQ(map.spine.size(), 1U);
  EXPECT_TRUE(map.neck.empty());
  EXPECT_EQ(map.left.clavicle, -1);
  EXPECT_EQ(map.left.toe, -1);
  EXPECT_GE(map.right.clavicle, 0);
  bones["neck"]["node"] = 99;
  EXPECT_NE(MessageOf(maker.Glb()).find("bone \"neck\": expected one of 24 nodes"),
            std::string::npos)
      << MessageOf(maker.Glb());
  bones["neck"]["node"] = NodeOfBone("head");
  EXPECT_NE(MessageOf(maker.Glb()).find("is another bone already"), std::string::npos);
  bones["neck"] = "here";
  EXPECT_NE(MessageOf(maker.Glb()).find("bone \"neck\": expected"), std::string::npos);
}

// ---- Files.

TEST(GltfRead, OpensBuffersOfItsFolderAlone) {
  namespace fs = std::filesystem;
  GltfMaker maker = AwkwardCharacter();
  const fs::path base = fs::path(testing::TempDir()) / "gltf_read_test";
  fs::remove_all(base);
  fs::create_directories(base / "in" / "deeper");
  const auto write = [](const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  };
  maker.document["skins"][0]["inverseBindMatrices"] =
      maker.AddArray<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1,
                             0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0,
                             0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                            "MAT4");
  write(base / "in" / "a b.bin", maker.data);
  write(base / "in" / "deeper" / "c.bin", maker.data);
  write(base / "out.bin", maker.data);
  fs::create_symlink(base / "out.bin", base / "in" / "link.bin");
  const auto reads = [&](const std::string& uri) {
    maker.document["buffers"][0]["uri"] = uri;
    write(base / "in" / "figure.gltf", maker.Text());
    try {
      ReadGltf(base / "in" / "figure.gltf");
      return true;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return false;
    }
  };
  EXPECT_TRUE(reads("a b.bin"));
  EXPECT_TRUE(reads("a%20b.bin"));
  EXPECT_TRUE(reads("deeper/c.bin"));
  EXPECT_TRUE(reads("deeper/../a b.bin"));
  EXPECT_FALSE(reads("../out.bin"));
  EXPECT_FALSE(reads("%2E%2E/out.bin"));
  EXPECT_FALSE(reads(base / "out.bin"));
  EXPECT_FALSE(reads("link.bin"));
  EXPECT_FALSE(reads("deeper"));
  EXPECT_FALSE(reads("nothing.bin"));
  EXPECT_FALSE(reads("http://localhost/a.bin"));
  fs::remove_all(base);
  EXPECT_THROW(ReadGltf(base / "none.glb"), InputError);
  maker.document["buffers"][0]["uri"] = "a b.bin";
  EXPECT_NE(MessageOf(maker.Text()).find("not readable"), std::string::npos)
      << "bytes without a folder reach no file";
}

}  // namespace
}  // namespace retarget::io
