#include "io/bvh/bvh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <random>
#include <tuple>

#include "model/geometry/so3.h"
#include "tests/io/bvh/bvh_damage.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

// A root with one child at (0, 1, 0) and one frame; the root turns by its three channels.
std::string TwoJoints(const std::string& root_channels, const std::string& frame) {
  return "HIERARCHY\nROOT a\n{\n\tOFFSET 5 6 7\n\tCHANNELS " + root_channels +
         "\n\tJOINT b\n\t{\n\t\tOFFSET 0 1 0\n\t\tCHANNELS 0\n\t\tEnd Site\n\t\t{\n"
         "\t\t\tOFFSET 0 0 2\n\t\t}\n\t}\n}\nMOTION\nFrames: 1\nFrame Time: 0.0333333\n" +
         frame + "\n";
}

Vec3 ChildPosition(const std::string& text) {
  const RigMotion motion = ParseBvh(text, "inline.bvh").motion;
  return PoseRig(motion.rig, motion.frames[0]).position[1];
}

// Worst distance of a joint's world position in two motions of one rig.
double WorstDistance(const RigMotion& a, const RigMotion& b) {
  double worst = 0;
  for (int f = 0; f < std::min(a.num_frames(), b.num_frames()); ++f) {
    const PosedRig pa = PoseRig(a.rig, a.frames[f]), pb = PoseRig(b.rig, b.frames[f]);
    for (size_t j = 0; j < pa.position.size(); ++j) {
      worst = std::max(worst, (pa.position[j] - pb.position[j]).norm());
    }
  }
  return worst;
}

TEST(BvhTest, ChannelsApplyInFileOrder) {
  // By hand: Rz(90) Rx(90) takes y to z and leaves it there; Rx(90) Rz(90) takes y to -x.
  EXPECT_LT((ChildPosition(TwoJoints("3 Zrotation Xrotation Yrotation", "90 90 0")) - Vec3(5, 6, 8))
                .norm(),
            1e-12);
  EXPECT_LT((ChildPosition(TwoJoints("3 Xrotation Zrotation Yrotation", "90 90 0")) - Vec3(4, 6, 7))
                .norm(),
            1e-12);
  // Ry(90) Rz(90): y to -x to z.
  EXPECT_LT((ChildPosition(TwoJoints("3 Yrotation Zrotation Xrotation", "90 90 0")) - Vec3(5, 6, 8))
                .norm(),
            1e-12);
}

TEST(BvhTest, PositionChannelsReplaceTheirAxisOfTheOffset) {
  EXPECT_LT((ChildPosition(TwoJoints("2 Zposition Xposition", "30 10")) - Vec3(10, 7, 30)).norm(),
            1e-12);
  // Rotations before positions.
  EXPECT_LT((ChildPosition(TwoJoints("4 Zrotation Xposition Yposition Zposition", "180 1 2 3")) -
             Vec3(1, 1, 3))
                .norm(),
            1e-12);
}

TEST(BvhTest, AJointTranslatesWithPositionChannelsOnAllAxes) {
  for (const auto& [channels, frame, translates] :
       {std::tuple("6 Zposition Xrotation Xposition Yrotation Yposition Zrotation", "1 2 3 4 5 6",
                   true),
        std::tuple("3 Xposition Yposition Zposition", "1 2 3", true),
        std::tuple("5 Xposition Zposition Xrotation Yrotation Zrotation", "1 2 3 4 5", false),
        std::tuple("3 Xrotation Yrotation Zrotation", "1 2 3", false)}) {
    const Rig rig = ParseBvh(TwoJoints(channels, frame), "moves.bvh").motion.rig;
    EXPECT_EQ(rig.joints[0].translates, translates) << channels;
    EXPECT_FALSE(rig.joints[1].translates);
  }
}

TEST(BvhTest, ReadsLooseText) {
  const std::string text =
      "\xEF\xBB\xBFhierarchy\r\nroot Bip01 Pelvis {\r\n\toffset 0, 0, 0\r\n  channels 1 "
      "xROTATION\r\n"
      " Joint\tBip01 L Thigh  \r\n{\r\nOFFSET +1 -2e0 .5\r\n}\r\nEnd  site\r\n{ OFFSET 0 0 1 "
      "}\r\n}\r\n"
      "ROOT second {OFFSET 0 0 0 CHANNELS 1 Yposition}\r\n"
      "motion\r\nframes :\t3\r\nFRAME  TIME:\t.0083333\r\n\r\n 90,\t1 \r\n0 2";
  const BvhFile file = ParseBvh(text, "loose.bvh");
  const Rig& rig = file.motion.rig;
  ASSERT_EQ(rig.num_joints(), 3);
  EXPECT_EQ(rig.joints[0].name, "Bip01 Pelvis");
  EXPECT_EQ(rig.joints[1].name, "Bip01 L Thigh");
  EXPECT_EQ(rig.joints[1].parent, 0);
  EXPECT_EQ(rig.joints[2].parent, -1);
  EXPECT_EQ(rig.joints[1].offset, Vec3(1, -2, 0.5));
  EXPECT_FALSE(rig.joints[1].end_site.has_value());
  EXPECT_EQ(*rig.joints[0].end_site, Vec3(0, 0, 1));
  EXPECT_EQ(file.motion.num_frames(), 2);
  EXPECT_DOUBLE_EQ(file.motion.frame_time, 1.0 / 120);
  EXPECT_EQ(file.frame_time_text, ".0083333");
  EXPECT_TRUE(file.crlf);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "3 frames declared, 2 found and used");
  EXPECT_EQ(file.hierarchy_text, text.substr(0, text.find("motion")));
}

TEST(BvhTest, MoreFramesThanDeclaredAreUsed) {
  const BvhFile file = ParseBvh(TwoJoints("1 Xrotation", "1\n2\n3"), "more.bvh");
  EXPECT_EQ(file.motion.num_frames(), 3);
  EXPECT_EQ(file.warnings.size(), 1u);
}

TEST(BvhTest, DuplicateNamesWarn) {
  std::string text = TwoJoints("1 Xrotation", "1");
  text.replace(text.find("JOINT b"), 7, "JOINT a");
  const BvhFile file = ParseBvh(text, "twice.bvh");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "joint name 'a' occurs more than once");
}

TEST(BvhTest, SnapsTheFrameTime) {
  EXPECT_DOUBLE_EQ(SnappedFrameTime(0.008333), 1.0 / 120);
  EXPECT_DOUBLE_EQ(SnappedFrameTime(0.004184), 1.0 / 239);
  EXPECT_DOUBLE_EQ(SnappedFrameTime(0.033333), 1.0 / 30);
  EXPECT_DOUBLE_EQ(SnappedFrameTime(0.016667), 1.0 / 60);
  EXPECT_DOUBLE_EQ(SnappedFrameTime(0.0417083750417), 0.0417083750417);  // 23.976
  EXPECT_DOUBLE_EQ(SnappedFrameTime(2.5), 2.5);
}

struct Fault {
  const char* what;  // replaced in the sound text
  const char* by;
  const char* message;  // begins with the line
};

TEST(BvhTest, RefusesMalformedTextWithItsLine) {
  const std::string sound = TwoJoints("3 Xposition Yposition Zrotation", "1 2 3");
  ASSERT_NO_THROW(ParseBvh(sound, "f"));
  const Fault faults[] = {
      {"HIERARCHY", "", "f:2: found 'ROOT', expected HIERARCHY"},
      {"HIERARCHY", "<bvh>", "f:1: found '<bvh>', expected HIERARCHY"},
      {"ROOT a", "ROOT", "f:2: found a joint without a name, expected a name on the same line"},
      {"ROOT a", "JOINT a", "f:2: found 'JOINT', expected ROOT"},
      {"OFFSET 5 6 7", "OFFSET 5 6", "f:5: found 'CHANNELS', expected three numbers after OFFSET"},
      {"OFFSET 5 6 7", "OFFSET 5 6 7 8",
       "f:4: found 4 numbers after OFFSET, expected three, or six of a place and a rotation"},
      {"OFFSET 5 6 7", "OFFSET 5 nan 7", "f:4: found 'nan', expected a finite number"},
      {"OFFSET 5 6 7", "OFFSET 5 1e400 7",
       "f:4: found '1e400', expected a number of at most 1e+09"},
      {"OFFSET 5 6 7", "OFFSET 5 -1e99 7",
       "f:4: found '-1e99', expected a number of at most 1e+09"},
      {"OFFSET 5 6 7", "", "f:15: found the end of joint 'a', expected its OFFSET"},
      {"OFFSET 5 6 7", "OFFSET 5 6 7\nOFFSET 5 6 7",
       "f:5: found a second OFFSET, expected one per joint"},
      {"CHANNELS 3", "CHANNELS 7", "f:5: found '7', expected 0 to 6 channels"},
      {"CHANNELS 3", "CHANNELS 2", "f:5: found more channel names, expected 2 as declared"},
      {"CHANNELS 3", "CHANNELS 4",
       "f:6: found 'JOINT', expected a channel such as Xposition or Zrotation"},
      {"Yposition", "Xposition", "f:5: found 'Xposition', expected each channel once per joint"},
      {"Yposition", "Wposition",
       "f:5: found 'Wposition', expected a channel such as Xposition or Zrotation"},
      {"JOINT b", "BONE b", "f:6: found 'BONE', expected OFFSET, CHANNELS, JOINT, End Site or }"},
      {"JOINT b\n\t{", "JOINT b\n", "f:8: found 'OFFSET', expected {"},
      {"End Site", "End", "f:10: found '', expected Site after End"},
      {"OFFSET 0 0 2", "", "f:13: found '}', expected OFFSET of the End Site"},
      {"}\n\t}\n}\n", "}\n\t}\n",
       "f:15: found 'MOTION', expected OFFSET, CHANNELS, JOINT, End Site or }"},
      {"MOTION", "MOTIONS", "f:16: found 'MOTIONS', expected ROOT or MOTION"},
      {"Frames: 1", "Frames: some",
       "f:17: found 'Frames: some', expected Frames: and their number"},
      {"Frames: 1\n", "", "f:17: found 'Frame Time: 0.0333333', expected Frames: and their number"},
      {"Time: 0.0333333", "Time: 0",
       "f:18: found 'Frame Time: 0', expected Frame Time: and seconds greater than zero"},
      {"Time: 0.0333333", "Time: -1",
       "f:18: found 'Frame Time: -1', expected Frame Time: and seconds greater than zero"},
      {"Time: 0.0333333", "Time: soon",
       "f:18: found 'soon', expected Frame Time: and seconds greater than zero"},
      {"1 2 3\n", "1 2 3\n1 2", "f:20: found 2 numbers, expected 3, one per channel"},
      {"1 2 3\n", "1 2 3 4\n", "f:19: found 4 numbers, expected 3, one per channel"},
      {"1 2 3\n", "1 2 x\n", "f:19: found 'x', expected a number"},
      {"1 2 3\n", "1 2 inf\n", "f:19: found 'inf', expected a finite number"},
      {"1 2 3\n", "", "f:19: found no frames, expected at least one line of numbers"},
      {"CHANNELS 3 Xposition Yposition Zrotation", "CHANNELS 0",
       "f:18: found no channel in any joint, expected position and rotation channels"},
  };
  for (const Fault& fault : faults) {
    std::string text = sound;
    const size_t at = text.find(fault.what);
    ASSERT_NE(at, std::string::npos) << fault.what;
    text.replace(at, std::string(fault.what).size(), fault.by);
    try {
      ParseBvh(text, "f");
      ADD_FAILURE() << "accepted: " << fault.message;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), fault.message);
    }
  }
}

TEST(BvhTest, RefusesEndlessNestingAndManyJoints) {
  std::string deep = "HIERARCHY\n", wide = "HIERARCHY\n";
  for (int n = 0; n < 100'000; ++n) {
    deep += n == 0 ? "ROOT a {\nOFFSET 0 0 0\n" : "JOINT a {\nOFFSET 0 0 0\n";
    wide += "ROOT a {\nOFFSET 0 0 0\n}\n";
  }
  EXPECT_THROW(ParseBvh(deep, "deep"), InputError);
  EXPECT_THROW(ParseBvh(wide, "wide"), InputError);
}

TEST(BvhTest, DeclaredFrameCountAllocatesNothing) {
  std::string text = TwoJoints("1 Xrotation", "1");
  text.replace(text.find("Frames: 1"), 9, "Frames: 2000000000");
  EXPECT_EQ(ParseBvh(text, "many.bvh").motion.frames.capacity(), 1u);
}

TEST(BvhTest, MissingFileIsNamed) {
  try {
    ReadBvh("/no/such/file.bvh");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/no/such/file.bvh: found no readable file, expected a BVH file");
  }
}

// --- Writing ---

BvhFile RandomFile(const std::string& order, int num_frames, std::mt19937_64* random) {
  std::string text = TwoJoints("6 Xposition Yposition Zposition " + order, "0 0 0 0 0 0");
  BvhFile file = ParseBvh(text, "random.bvh");
  std::normal_distribution<double> normal;
  const RigFrame first = file.motion.frames[0];
  file.motion.frames.assign(static_cast<size_t>(num_frames), first);
  for (RigFrame& frame : file.motion.frames) {
    frame.translation[0] = 100 * Vec3(normal(*random), normal(*random), normal(*random));
    frame.rotation[0] =
        Quat(normal(*random), normal(*random), normal(*random), normal(*random)).normalized();
  }
  return file;
}

TEST(BvhTest, RoundTripInEveryOrder) {
  std::mt19937_64 random(7);
  for (const std::string order :
       {"Xrotation Yrotation Zrotation", "Xrotation Zrotation Yrotation",
        "Yrotation Xrotation Zrotation", "Yrotation Zrotation Xrotation",
        "Zrotation Xrotation Yrotation", "Zrotation Yrotation Xrotation"}) {
    const BvhFile file = RandomFile(order, 200, &random);
    const BvhFile again = ParseBvh(FormatBvh(file, file.motion), "again.bvh");
    EXPECT_EQ(again.hierarchy_text, file.hierarchy_text);
    EXPECT_EQ(again.frame_time_text, file.frame_time_text);
    EXPECT_TRUE(again.warnings.empty());
    ASSERT_EQ(again.motion.num_frames(), 200);
    EXPECT_LT(WorstDistance(again.motion, file.motion), 1e-6) << order;
    for (int f = 0; f < 200; ++f) {
      EXPECT_LT(
          again.motion.frames[f].rotation[0].angularDistance(file.motion.frames[f].rotation[0]),
          1e-8);
    }
  }
}

// The written angles of the root, degrees.
std::vector<Vec3> WrittenAngles(const BvhFile& file) {
  const std::string text = FormatBvh(file, file.motion);
  std::istringstream lines(text.substr(text.find("Frame Time")));
  std::string line;
  std::getline(lines, line);
  std::vector<Vec3> angles;
  while (std::getline(lines, line)) {
    std::istringstream numbers(line);
    Vec3 skip, triple;
    for (Vec3* v : {&skip, &triple}) numbers >> v->x() >> v->y() >> v->z();
    angles.push_back(triple);
  }
  return angles;
}

TEST(BvhTest, CurvesStayContinuousThroughTurnsAndGimbalLock) {
  std::mt19937_64 random(3);
  BvhFile file = RandomFile("Zrotation Yrotation Xrotation", 500, &random);
  for (int f = 0; f < 500; ++f) {  // the middle angle passes 90 degrees (exactly, at frame 45)
    file.motion.frames[f].rotation[0] = ExpSo3(Vec3(0, 0, 0.3)) *
                                        ExpSo3(Vec3(0, 2 * f * kDegree, 0)) *
                                        ExpSo3(Vec3(3 * f * kDegree, 0, 0));
  }
  const std::vector<Vec3> angles = WrittenAngles(file);
  for (size_t f = 1; f < angles.size(); ++f) {
    EXPECT_LT((angles[f] - angles[f - 1]).cwiseAbs().maxCoeff(), 3.001) << f;
  }
  EXPECT_NEAR(angles.back().z(), 3 * 499, 1e-5);
  EXPECT_LT(WorstDistance(ParseBvh(FormatBvh(file, file.motion), "again").motion, file.motion),
            1e-6);
}

TEST(BvhTest, FewerRotationChannelsKeepWhatTheyCanHold) {
  for (const std::string channels : {"1 Yrotation", "2 Zrotation Xrotation"}) {
    const std::string frame = channels[0] == '1' ? "123" : "170 -60";
    const BvhFile file = ParseBvh(TwoJoints(channels, frame), "few.bvh");
    const BvhFile again = ParseBvh(FormatBvh(file, file.motion), "again.bvh");
    EXPECT_LT(WorstDistance(again.motion, file.motion), 1e-6);
  }
}

TEST(BvhTest, WritesLineEndsFrameTimeAndScaledOffsets) {
  std::string text = TwoJoints("3 Xrotation Yrotation Zrotation", "10 20 30");
  for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.insert(at, "\r");
  }
  const BvhFile file = ParseBvh(text, "crlf.bvh");
  EXPECT_TRUE(file.crlf);
  RigMotion slower = file.motion;
  slower.frame_time = 0.04;
  const std::string scaled = FormatBvh(file, slower, 0.5);
  EXPECT_NE(scaled.find("\tOFFSET 2.5000000 3.0000000 3.5000000\r\n"), std::string::npos);
  EXPECT_NE(scaled.find("\r\nFrame Time: 0.04\r\n"), std::string::npos);
  EXPECT_EQ(std::count(scaled.begin(), scaled.end(), '\r'),
            std::count(scaled.begin(), scaled.end(), '\n'));
  const BvhFile again = ParseBvh(scaled, "scaled.bvh");
  EXPECT_EQ(again.motion.rig.joints[1].offset, Vec3(0, 0.5, 0));
  EXPECT_EQ(*again.motion.rig.joints[1].end_site, Vec3(0, 0, 1));
}

// --- Real files ---

std::vector<std::string> SharedBvhFiles() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SharedPath("data"))) {
    if (entry.path().extension() == ".bvh") {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(BvhTest, RealFilesRoundTrip) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::vector<std::string> paths = SharedBvhFiles();
  ASSERT_GE(paths.size(), 27u);
  for (const std::string& path : paths) {
    const std::string text = ReadWholeFile(path);
    const BvhFile file = ReadBvh(path);
    const bool odd =
        path.ends_with("soma_zero_frame0.bvh") || path.ends_with("02_positions_are_deltas/a.bvh");
    EXPECT_EQ(file.warnings.size(), odd ? 1u : 0u) << path;
    EXPECT_TRUE(text.starts_with(file.hierarchy_text + "MOTION")) << path;
    const BvhFile again = ParseBvh(FormatBvh(file, file.motion), path);
    EXPECT_EQ(again.motion.num_frames(), file.motion.num_frames());
    EXPECT_EQ(again.motion.frame_time, file.motion.frame_time);
    double size = 0;
    for (const RigJoint& joint : file.motion.rig.joints) size += joint.offset.norm();
    EXPECT_LT(WorstDistance(again.motion, file.motion), 1e-6 * size) << path;
  }
}

TEST(BvhTest, ReadsQuickly) {
  SKIP_WITHOUT_SHARED_DATA();
  const auto begin = std::chrono::steady_clock::now();
  ReadBvh(SharedPath("data/clips/lafan_dance1_subject2.bvh"));  // 2.7 MB
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(spent.count(), 3.0);  // 0.03 s alone; room for sanitizers and busy machines
}

TEST(BvhTest, ScaledTwinAgrees) {
  SKIP_WITHOUT_SHARED_DATA();
  const RigMotion raw = ReadBvh(SharedPath("data/clips/cmu_131_01.bvh")).motion;
  const RigMotion metres = ReadBvh(SharedPath("data/clips/cmu_131_01_metres.bvh")).motion;
  ASSERT_EQ(raw.num_frames() + 1, metres.num_frames());
  const double unit = *ParseUnits("cmu");
  double worst = 0;
  for (int f = 0; f < raw.num_frames(); ++f) {
    const PosedRig a = PoseRig(raw.rig, raw.frames[f]), b = PoseRig(metres.rig, metres.frames[f]);
    for (size_t j = 0; j < a.position.size(); ++j) {
      worst = std::max(worst, (unit * a.position[j] - b.position[j]).norm());
    }
  }
  EXPECT_LT(worst, 1e-3);
}

// Six numbers after OFFSET: a place and a rotation, as the position channels confirm.
TEST(BvhTest, ReadsTheFirstThreeOfSixNumbersInAnOffset) {
  const std::string six =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0 0 0 0\nCHANNELS 6 Xposition Yposition Zposition "
      "Zrotation Yrotation Xrotation\nJOINT b\n{\nOFFSET 5 6 7 90 80 70\nCHANNELS 6 Xposition "
      "Yposition Zposition Zrotation Yrotation Xrotation\nEnd Site\n{\nOFFSET 1 0 0\n}\n}\n}\n"
      "MOTION\nFrames: 1\nFrame Time: 0.02\n0 0 0 0 0 0 ";
  const BvhFile file = ParseBvh(six + "5 6 7 0 0 0\n", "f");
  EXPECT_EQ(file.motion.rig.joints[1].offset, Vec3(5, 6, 7));
  EXPECT_EQ(file.motion.frames[0].translation[1], Vec3(5, 6, 7));
  EXPECT_EQ(file.warnings,
            (std::vector<std::string>{
                "2 joints have six numbers after OFFSET: the first three are read, as the place"}));
  const std::string doubled = FormatBvh(file, file.motion, 2);
  EXPECT_NE(doubled.find("OFFSET 10.0000000 12.0000000 14.0000000 90 80 70\n"), std::string::npos);
  try {
    ParseBvh(six + "90 80 70 0 0 0\n", "f");
    FAIL() << "the position channels follow the last three";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "f:4: found six numbers after OFFSET, of which the position channels follow the "
                 "last three, expected the joint's place first");
  }
}

// A figure whose joints have position channels of values that `value` gives from OFFSETs.
BvhFile FileOfPositions(const std::function<Vec3(const Vec3&, int frame)>& value,
                        const Vec3& root_offset, const Vec3& root) {
  const Vec3 offsets[] = {{0, 12, 0}, {5, 3, 1}, {0, -40, 2}};
  std::string text = "HIERARCHY\nROOT a\n{\n";
  const std::string channels =
      "CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n";
  const auto numbers = [](const Vec3& v) { return fmt::format("{} {} {} ", v.x(), v.y(), v.z()); };
  text += "OFFSET " + numbers(root_offset) + "\n" + channels;
  for (const Vec3& offset : offsets) {
    text += "JOINT j\n{\nOFFSET " + numbers(offset) + "\n" + channels;
  }
  text += "}\n}\n}\n}\nMOTION\nFrames: 3\nFrame Time: 0.02\n";
  for (int frame = 0; frame < 3; ++frame) {
    text += numbers(root) + "1 2 3 ";
    for (const Vec3& offset : offsets) text += numbers(value(offset, frame)) + "4 5 6 ";
    text += "\n";
  }
  return ParseBvh(text, "f.bvh");
}

TEST(BvhTest, PositionsNearZeroAreDisplacements) {
  const auto moved = [](const Vec3& offset, int frame) -> Vec3 {
    return offset + Vec3(frame, 0, 0);
  };
  const BvhFile usual = FileOfPositions(moved, {0, 0, 0}, {0, 95, 0});
  const BvhFile deltas = FileOfPositions(
      [&](const Vec3& offset, int frame) -> Vec3 { return moved(offset, frame) - offset; },
      {0, 0, 0}, {0, 95, 0});
  EXPECT_LT(WorstDistance(usual.motion, deltas.motion), 1e-9);
  EXPECT_EQ(usual.warnings.size() + 1, deltas.warnings.size());
  // A root with an OFFSET: its channels hold the OFFSET, or are displacements too.
  for (const Vec3& root : {Vec3(0, 95, 0), Vec3(0, 0, 0)}) {
    const BvhFile file =
        FileOfPositions([](const Vec3&, int) -> Vec3 { return Vec3::Zero(); }, {0, 95, 0}, root);
    EXPECT_EQ(file.motion.frames[0].translation[0], Vec3(0, 95, 0));
  }
  // They are written as they were read, on a body of any size.
  for (const double scale : {1.0, 0.5}) {
    RigMotion motion = deltas.motion;
    for (RigFrame& frame : motion.frames) {
      for (Vec3& translation : frame.translation) translation *= scale;
    }
    const BvhFile again = ParseBvh(FormatBvh(deltas, motion, scale), "again.bvh");
    EXPECT_LT(WorstDistance(again.motion, motion), 1e-5);
  }
  // OFFSETs of zero say nothing, and positions far from both are taken as they stand.
  EXPECT_TRUE(FileOfPositions([](const Vec3&, int) { return Vec3(30, 1, 2); }, {0, 0, 0}, {0, 0, 0})
                  .motion.frames[0]
                  .translation[1]
                  .isApprox(Vec3(30, 1, 2)));
}

TEST(BvhTest, DisplacementsAreTheSameFigure) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string folder = SharedPath("data/faults/02_positions_are_deltas/");
  const RigMotion deltas = ReadBvh(folder + "a.bvh").motion;
  const RigMotion usual = ReadBvh(folder + "absolute.bvh").motion;
  EXPECT_LT(WorstDistance(deltas, usual), 1e-4);
}

TEST(BvhTest, DamagedFilesAreReadOrRefused) {
  SKIP_WITHOUT_SHARED_DATA();
  std::vector<std::string> texts;
  for (const std::string& path : SharedBvhFiles()) {
    texts.push_back(CutToFrames(ReadWholeFile(path), 50));
  }
  int accepted = 0;
  constexpr int kCopies = 500;
  for (int copy = 0; copy < kCopies; ++copy) {
    const std::string damaged =
        Damager(static_cast<uint64_t>(copy)).Damage(texts[copy % texts.size()]);
    ASSERT_NO_THROW(accepted += ReadsOrRefuses(damaged) ? 1 : 0) << copy;
  }
  EXPECT_GT(accepted, 20);  // both outcomes were reached
  EXPECT_LT(accepted, kCopies - 20);
}

}  // namespace
}  // namespace retarget::io
