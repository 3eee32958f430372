#include "io/acclaim/acclaim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "io/bvh/bvh.h"
#include "io/recognition/recognise.h"
#include "model/geometry/so3.h"
#include "model/rig/binding.h"
#include "tests/io/acclaim/acclaim_damage.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

// The root with one bone of length 2 along +Z, and a stub of length 1 along +Y at its end.
std::string Asf(const std::string& bone, const std::string& root = "order TX TY TZ RX RY RZ") {
  return "# a comment\n:version 1.10\n:name test\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n"
         ":documentation\n   begin dof # nothing of this counts\n"
         ":root\n  " +
         root +
         "\n  axis XYZ\n  position 0 0 0\n  orientation 0 0 0\n:bonedata\n  begin\n"
         "     id 1\n     name arm\n     direction 0 0 1\n     length 2\n" +
         bone +
         "  end\n  begin\n    id 2\n    name stub\n    direction 0 1 0\n    length 1\n"
         "    axis 0 0 0 XYZ\n  end\n"
         ":hierarchy\n  begin\n    root arm\n    arm stub\n  end\n";
}

std::string Amc(const std::string& arm, const std::string& root = "0 0 0 0 0 0") {
  return "#!OML:ASF x.asf\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot " + root + "\n" +
         (arm.empty() ? "" : "arm " + arm + "\n");
}

AcclaimFile Parse(const std::string& asf, const std::string& amc) {
  return ParseAcclaim(asf, "s", amc, "m");
}

// The end of the stub in the first frame.
Vec3 StubEnd(const AcclaimFile& file) {
  const PosedRig posed = PoseRig(file.motion.rig, file.motion.frames[0]);
  return posed.position[2] + posed.rotation[2] * *file.motion.rig.joints[2].end_site;
}

TEST(AcclaimTest, BonesBeginAtTheirParentsEnd) {
  const AcclaimFile file = Parse(Asf("    axis 0 0 0 XYZ\n"), Amc("", "1 2 3 0 0 0"));
  const Rig& rig = file.motion.rig;
  ASSERT_EQ(rig.num_joints(), 3);
  EXPECT_EQ(rig.joints[0].name, "root");
  EXPECT_TRUE(rig.joints[0].translates);
  EXPECT_EQ(rig.joints[1].name, "arm");
  EXPECT_EQ(rig.joints[1].offset, Vec3::Zero());
  EXPECT_EQ(rig.joints[2].offset, Vec3(0, 0, 2));
  EXPECT_EQ(*rig.joints[2].end_site, Vec3(0, 1, 0));
  EXPECT_FALSE(rig.joints[1].end_site.has_value());
  EXPECT_EQ(StubEnd(file), Vec3(1, 3, 5));
  EXPECT_EQ(file.length_unit, 0.45);
  EXPECT_DOUBLE_EQ(file.motion.frame_time, 1.0 / 120);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "Acclaim files name no frame rate: played at 120 per second");
}

// By hand: where the stub's end goes from (0, 1, 2).
TEST(AcclaimTest, TurnsByOrderAxesAndUnit) {
  const struct {
    const char *bone, *arm;
    Vec3 expected;
  } cases[] = {
      {"axis 0 0 0 XYZ\ndof rx ry rz\n", "90 0 0", {0, -2, 1}},  // y to z, z to -y
      {"axis 0 0 0 XYZ\ndof rx rz\n", "90 90", {2, 0, 1}},       // first about x, then about z
      {"axis 0 0 0 XYZ\ndof rz rx\n", "90 90", {-1, -2, 0}},     // first about z, then about x
      {"axis 0 0 90 XYZ\ndof rx\n", "90", {2, 1, 0}},            // the bone's x is the world's y
      {"axis 90 0 90 XYZ\ndof ry\n", "90", {-1, 0, 2}},          // its y, by x to z: the world's z
      {"axis 90 0 90 ZYX\ndof rz\n", "90", {-2, 1, 0}},          // its z, by x to -y
      {"axis 0 0 0 XYZ\ndof ty rx\n", "5 90", {0, 3, 1}},        // moved, then turned
      {"axis 90 0 0 XYZ\ndof ty\n", "5", {0, 1, 7}},             // along its own y
  };
  for (const auto& c : cases) {
    const AcclaimFile file = Parse(Asf(c.bone), Amc(c.arm));
    EXPECT_LT((StubEnd(file) - c.expected).norm(), 1e-12) << c.bone << StubEnd(file).transpose();
  }
}

TEST(AcclaimTest, RootTurnsByItsOrderAndStandsAtItsPosition) {
  const std::string rigid = "axis 0 0 0 XYZ\n";
  // Values come in the order's order; of the turns about fixed axes the first is done first.
  AcclaimFile file = Parse(Asf(rigid, "order RZ TX RX TZ TY RY"), Amc("", "90 1 90 3 2 0"));
  EXPECT_LT((StubEnd(file) - Vec3(0, 0, 3)).norm(), 1e-12);  // (-1, -2, 0) + (1, 2, 3)
  std::string asf = Asf(rigid);
  asf.replace(asf.find("position 0 0 0"), 14, "position 1,2,3");
  file = Parse(asf, Amc("", "10 0 0 90 0 0"));
  EXPECT_LT((StubEnd(file) - Vec3(11, 0, 4)).norm(), 1e-12);  // (0, -2, 1) + (11, 2, 3)
  asf.replace(asf.find("orientation 0 0 0"), 17, "orientation 0 0 90");
  file = Parse(asf, Amc("", "10 0 0 90 0 0"));
  EXPECT_LT((StubEnd(file) - Vec3(13, 3, 3)).norm(), 1e-12);  // (2, 1, 0) + (11, 2, 3)
}

TEST(AcclaimTest, ReadsRadians) {
  std::string asf = Asf("axis 0 0 1.5707963267948966 XYZ\ndof rx\n");
  asf.replace(asf.find("angle deg"), 9, "angle rad");
  std::string amc = Amc("90");
  const AcclaimFile mixed = Parse(asf, amc);  // each file by its own word
  EXPECT_LT((StubEnd(mixed) - Vec3(2, 1, 0)).norm(), 1e-12);
  amc = Amc("1.5707963267948966");
  amc.erase(amc.find(":DEGREES\n"), 9);
  const AcclaimFile file = Parse(asf, amc);
  EXPECT_FALSE(file.degrees);
  EXPECT_LT((StubEnd(file) - Vec3(2, 1, 0)).norm(), 1e-12);
  EXPECT_NE(FormatAmc(file, file.motion).find("arm 1.570796327\n"), std::string::npos);
}

TEST(AcclaimTest, ReadsLooseText) {
  const std::string asf =
      "\xEF\xBB\xBF:ROOT\r\n Order tx,ty,tz,RX,ry,rz # why not\r\n\r\n:BoneData\r\nbegin\r\nname "
      "HAND\r\n"
      "direction (3 0 4)\r\nlength 0\r\nend\r\nbegin\r\nNAME arm\r\nDOF rx\r\n"
      "limits (-inf inf)\r\n (1 2)\r\nbodymass 1\r\ncofmass 0.5\r\nLength 5\r\n"
      "Direction 3 0 4\r\naxis 0 0 0\r\nend\r\n:HIERARCHY\r\n begin\r\n"
      "ROOT\tArm\r\narm Hand\r\nend";
  const AcclaimFile file = Parse(asf, "# bare\r\n7\r\nROOT 1,2,3,0,0,0\r\n\tARM 30 # so\r\n");
  const Rig& rig = file.motion.rig;
  ASSERT_EQ(rig.num_joints(), 3);
  EXPECT_EQ(rig.joints[2].name, "HAND");
  EXPECT_EQ(rig.joints[2].parent, 1);
  EXPECT_LT((rig.joints[2].offset - Vec3(3, 0, 4)).norm(), 1e-12);  // of length 5
  EXPECT_EQ(*rig.joints[2].end_site, Vec3::Zero());
  EXPECT_TRUE(file.crlf);
  EXPECT_EQ(file.first_frame, 7);
  EXPECT_EQ(FormatAmc(file, file.motion), "# bare\r\n7\r\nroot 1 2 3 0 0 0\r\narm 30\r\n");
  EXPECT_EQ(FormatAsf(file), asf);
}

TEST(AcclaimTest, BonesLeftOutStayAsTheyWere) {
  const std::string asf = Asf("axis 0 0 0 XYZ\ndof rx\n");
  const AcclaimFile file = Parse(
      asf, "3\nroot 1 0 0 0 0 0\n4\nroot 2 0 0 0 0 0\narm 40\n6\nroot 3 0 0 0 0 0\n9\narm 50\n");
  ASSERT_EQ(file.motion.num_frames(), 4);
  const double bend[] = {0, 40, 40, 50}, along[] = {1, 2, 3, 3};
  for (int k = 0; k < 4; ++k) {
    const RigFrame& frame = file.motion.frames[static_cast<size_t>(k)];
    EXPECT_NEAR(LogSo3(frame.rotation[1]).x(), bend[k] * kDegree, 1e-12);
    EXPECT_EQ(frame.translation[0].x(), along[k]);
  }
  EXPECT_EQ(file.warnings[0],
            "no frames between 4 and 6: those there are play one after the other");
  EXPECT_EQ(file.warnings[1], "frame 6 leaves out 'arm': it stays as it was");
  const AcclaimFile never = Parse(asf, Amc(""));
  EXPECT_EQ(never.warnings[0], "no frame names 'arm': it stays at rest");
  EXPECT_NE(FormatAmc(never, file.motion).find("arm 50\n"), std::string::npos);
}

struct Fault {
  const char* what;  // replaced in the sound text
  const char* by;
  const char* message;
};

void ExpectFaults(const std::vector<Fault>& faults, bool in_asf) {
  const std::string asf = Asf("    axis 0 0 0 XYZ\n    dof rx ry\n    limits (-1 1)\n");
  const std::string amc = Amc("1 2") + "2\nroot 0 0 0 0 0 0\narm 3 4\n";
  ASSERT_NO_THROW(Parse(asf, amc));
  for (const Fault& fault : faults) {
    std::string text = in_asf ? asf : amc;
    const size_t at = text.find(fault.what);
    ASSERT_NE(at, std::string::npos) << fault.what;
    text.replace(at, std::string(fault.what).size(), fault.by);
    try {
      Parse(in_asf ? text : asf, in_asf ? amc : text);
      ADD_FAILURE() << "accepted: " << fault.message;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), fault.message);
    }
  }
}

TEST(AcclaimTest, RefusesMalformedSkeletonsWithTheirLine) {
  const char* keys =
      "s:21: found 'lenght', expected id, name, direction, length, axis, bodymass, cofmass, dof, "
      "limits or end";
  ExpectFaults(
      {
          {":version", "version", "s:2: found 'version', expected a keyword such as :bonedata"},
          {"length 0.45", "length",
           "s:6: found the end of the line, expected a length unit above "
           "zero"},
          {"length 0.45", "length 0", "s:6: found '0', expected a length unit above zero"},
          {"angle deg", "angle full", "s:7: found 'full', expected deg or rad"},
          {"order TX", "order TW", "s:11: found 'TW', expected tx, ty, tz, rx, ry or rz"},
          {"order TX", "order TY", "s:11: found 'TY', expected each degree of freedom once"},
          {"order TX TY TZ RX RY RZ\n", "",
           "s:35: found no order of the root's values, expected a :root section with order"},
          {"axis XYZ", "axis XYX", "s:12: found 'XYX', expected an order such as XYZ"},
          {"position 0 0 0", "position 0 0",
           "s:13: found the end of the line, expected three numbers after position"},
          {"position 0 0 0", "place 0 0 0",
           "s:13: found 'place', expected order, axis, position or orientation"},
          {"name arm", "name", "s:18: found no single word, expected the name of the bone"},
          {"name arm\n", "\n", "s:24: found the end of a bone, expected its name"},
          {"name arm", "name root", "s:24: found a second bone 'root', expected each name once"},
          {"name stub", "name ARM", "s:31: found a second bone 'ARM', expected each name once"},
          {"direction 0 0 1", "direction 0 0 0",
           "s:24: found no direction of bone 'arm', expected one that is not zero"},
          {"direction 0 0 1", "direction 0 x 1",
           "s:19: found 'x', expected three numbers after direction"},
          {"direction 0 0 1\n", "\n",
           "s:24: found the end of bone 'arm', expected its direction and length"},
          {"length 2", "length -2", "s:20: found '-2', expected a length that is not negative"},
          {"length 2", "length nan", "s:20: found 'nan', expected a finite number"},
          {"length 2", "length 1e99", "s:20: found '1e99', expected a number of at most 1e+09"},
          {"    axis 0 0 0 XYZ\n    dof", "    lenght 3\n    dof", keys},
          {"dof rx ry", "dof rx l", "s:22: found 'l', expected tx, ty, tz, rx, ry or rz"},
          {":hierarchy", ":skin",
           "s:36: found bone 'arm' apart from the root, expected it in :hierarchy"},
          {"arm stub", "stub arm", "s:35: found 'arm', expected each bone once as a child"},
          {"root arm", "stub arm",
           "s:36: found bone 'arm' apart from the root, expected it in :hierarchy"},
          {"arm stub", "arm stun",
           "s:35: found 'stun', expected a bone of :bonedata, did you mean \"stub\"?"},
      },
      true);
  try {
    Parse(":root\norder rx\n", "");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "s:2: found no bones, expected a :bonedata section");
  }
}

TEST(AcclaimTest, RefusesMalformedMotionsWithTheirLine) {
  ExpectFaults(
      {
          {"1\nroot", "root", "m:4: found 'root', expected a frame number"},
          {"1\nroot", "1 2\nroot", "m:4: found '1', expected a frame number alone on its line"},
          {"1\nroot", "1.5\nroot", "m:4: found '1.5', expected a frame number alone on its line"},
          {"2\nroot", "1\nroot", "m:7: found frame 1 after frame 1, expected numbers that rise"},
          {"arm 1 2", "leg 1 2",
           "m:6: found 'leg', expected a bone of the skeleton, expected one of root, arm, stub"},
          {"arm 1 2", "arm 1",
           "m:6: found 1 numbers, expected 2, one per degree of freedom of 'arm'"},
          {"arm 1 2", "stub 1",
           "m:6: found 1 numbers, expected 0, one per degree of freedom of 'stub'"},
          {"arm 1 2", "arm 1 x", "m:6: found 'x', expected a number"},
          {"arm 1 2", "arm 1 2\narm 1 2", "m:7: found 'arm', expected each bone once per frame"},
          {"2\nroot 0 0 0 0 0 0\narm 3 4\n", "2\n",
           "m:7: found a frame 2 without bones, expected at least one"},
          {"1\nroot 0 0 0 0 0 0\narm 1 2\n2\nroot 0 0 0 0 0 0\narm 3 4\n", "",
           "m:3: found no frames, expected a frame number"},
      },
      false);
  EXPECT_THROW(ParseAcclaim(Asf(""), "s", Amc(""), "m", 0), InputError);
  EXPECT_THROW(ReadAcclaim("/no/such.asf", "/no/such.amc"), InputError);
}

// --- Writing ---

TEST(AcclaimTest, RoundTripForEveryOrderAndAxis) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  int checked = 0;
  for (const char* order : {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}) {
    std::string dof;
    for (const char* c = order; *c; ++c) dof += std::string(" r") + *c;
    const AcclaimFile file =
        Parse(Asf(std::string("axis 40 -70 110 ") + order + "\ndof" + dof + " tx ty tz\n",
                  "order TZ RY TX RX RZ TY"),
              Amc("0 0 0 0 0 0"));
    RigMotion motion = file.motion;
    motion.frames.assign(100, motion.frames[0]);
    for (RigFrame& frame : motion.frames) {
      for (size_t j : {0, 1}) {
        frame.translation[j] = Vec3(normal(random), normal(random), normal(random));
        frame.rotation[j] =
            Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
      }
    }
    const AcclaimFile again = Parse(FormatAsf(file), FormatAmc(file, motion));
    ASSERT_EQ(again.motion.num_frames(), 100);
    for (size_t f = 0; f < 100; ++f) {
      for (size_t j : {0, 1}) {
        const RigFrame &a = motion.frames[f], &b = again.motion.frames[f];
        EXPECT_LT(a.rotation[j].angularDistance(b.rotation[j]), 1e-8);
        EXPECT_LT((a.translation[j] - b.translation[j]).norm(), 1e-6);
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 1200);
}

TEST(AcclaimTest, CurvesStayContinuous) {
  const AcclaimFile file = Parse(Asf("axis 0 0 20 XYZ\ndof rx ry rz\n"), Amc("0 0 0"));
  RigMotion motion = file.motion;
  motion.frames.assign(500, motion.frames[0]);
  const Quat axes = ExpSo3(Vec3(0, 0, 20 * kDegree));
  for (int f = 0; f < 500; ++f) {  // the middle angle passes 90 degrees (exactly, at frame 45)
    motion.frames[static_cast<size_t>(f)].rotation[1] =
        axes * ExpSo3(Vec3(0, 0, 0.3)) * ExpSo3(Vec3(0, 2 * f * kDegree, 0)) *
        ExpSo3(Vec3(3 * f * kDegree, 0, 0)) * axes.conjugate();
  }
  std::istringstream words(FormatAmc(file, motion));
  std::string word;
  Vec3 before = Vec3::Zero();
  int frames = 0;
  while (words >> word) {
    if (word != "arm") continue;
    Vec3 angles;
    words >> angles.x() >> angles.y() >> angles.z();
    if (frames++ > 0) {
      EXPECT_LT((angles - before).cwiseAbs().maxCoeff(), 3.001) << frames;
    }
    before = angles;
  }
  EXPECT_EQ(frames, 500);
}

// A bone keeps what its freedom can hold.
TEST(AcclaimTest, FewerDegreesOfFreedomLoseNoMoreThanTheyMust) {
  std::string asf = Asf("axis 0 0 0 XYZ\n");
  asf.replace(asf.rfind("axis 0 0 0 XYZ"), 14, "axis 0 0 20 XYZ\ndof rz");
  const AcclaimFile file = Parse(asf, Amc("") + "stub 0\n");
  RigMotion motion = file.motion;
  const Quat inside = ExpSo3(Vec3(0, 0, 1.1)), outside = ExpSo3(Vec3(0.3, 0, 0));
  motion.frames[0].rotation[2] = inside * outside;
  const RigMotion back = Parse(asf, FormatAmc(file, motion)).motion;
  EXPECT_LT(back.frames[0].rotation[2].angularDistance(inside), 1e-3);
  EXPECT_LT(back.frames[0].rotation[0].angularDistance(Quat::Identity()), 1e-3);
}

// A knee that only bends, and a foot wanted aside: the thigh rolls, and the foot is there.
TEST(AcclaimTest, OtherBonesMakeGoodWhatOneCannot) {
  std::string asf = Asf("axis 0 0 0 XYZ\ndof rx ry rz\n");
  asf.replace(asf.rfind("axis 0 0 0 XYZ"), 14, "axis 0 0 0 XYZ\ndof rx");
  asf.insert(asf.find(":hierarchy"), "begin\nname foot\ndirection 0 0 1\nlength 1\nend\n");
  asf.insert(asf.find("  end\n", asf.find(":hierarchy")), "stub foot\n");
  const AcclaimFile file = Parse(asf, Amc("0 0 0") + "stub 0\n");
  RigMotion motion = file.motion;
  motion.frames[0].rotation[2] = ExpSo3(Vec3(0.4, 0, 0)) * ExpSo3(Vec3(0, 0, 0.5));
  const RigMotion back = Parse(asf, FormatAmc(file, motion)).motion;
  const PosedRig rest = PoseRig(file.motion.rig, file.motion.frames[0]);
  const PosedRig wanted = PoseRig(motion.rig, motion.frames[0]);
  const PosedRig got = PoseRig(back.rig, back.frames[0]);
  EXPECT_GT((wanted.position[3] - rest.position[3]).norm(), 0.5);
  for (size_t j = 0; j < 4; ++j) {
    EXPECT_LT((wanted.position[j] - got.position[j]).norm(), 1e-3) << j;
  }
  const Quat& knee = back.frames[0].rotation[2];
  EXPECT_LT(std::hypot(knee.y(), knee.z()), 1e-9);
}

TEST(AcclaimTest, ScaledSkeletonsHaveScaledLengths) {
  std::string asf = Asf("axis 0 0 0 XYZ\ndof ty rx\n");
  asf.replace(asf.find("position 0 0 0"), 14, "position 1 2 3");
  const AcclaimFile file = Parse(asf, Amc("4 90", "5 6 7 0 90 0"));
  const std::string scaled = FormatAsf(file, 0.5);
  EXPECT_NE(scaled.find("position 0.5 1 1.5\n"), std::string::npos);
  EXPECT_NE(scaled.find("length 1\n"), std::string::npos);
  EXPECT_NE(scaled.find("length 0.45\n"), std::string::npos);  // of the units
  RigMotion half = file.motion;
  for (Vec3& t : half.frames[0].translation) t *= 0.5;
  const AcclaimFile again = Parse(scaled, FormatAmc(file, half, 0.5));
  EXPECT_LT((StubEnd(again) - 0.5 * StubEnd(file)).norm(), 1e-6);
}

// --- Real files: one motion in two formats ---

const std::string kClip = SharedPath("data/clips/cmu_16_15");

// A motion file as rows of numbers: [bone][frame][value].
using Curves = std::map<std::string, std::vector<std::vector<double>>>;

Curves CurvesOf(const std::string& amc) {
  Curves curves;
  std::istringstream lines(amc);
  std::string line, word;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    words >> word;
    if (word[0] < 'a' || word[0] > 'z') continue;
    std::vector<double> values;
    for (double value; words >> value;) values.push_back(value);
    curves[word].push_back(values);
  }
  return curves;
}

// The file's BVH twin was made through keys at every fourth frame and the last: between them its
// limbs follow Catmull-Rom splines of the angles, with one-sided differences at both ends. Puts the
// curve of one value through the same.
double ThroughEveryFourth(const std::vector<std::vector<double>>& curve, size_t k, int frame) {
  const int last = static_cast<int>(curve.size()) - 1;
  const int keys = last / 4;  // and one more, the last frame
  const auto time = [&](int key) { return key > keys ? last : 4 * key; };
  const auto value = [&](int key) { return curve[static_cast<size_t>(time(key))][k]; };
  const auto slope = [&](int key) {
    if (key == 0) return value(1) - value(0);
    return key > keys ? value(key) - value(key - 1) : (value(key + 1) - value(key - 1)) / 2;
  };
  const int key = frame / 4;
  if (frame == time(key)) return value(key);
  const double t = (frame - 4.0 * key) / (time(key + 1) - 4 * key);
  const double s = 1 - t;
  return s * s * (1 + 2 * t) * value(key) + s * s * t * slope(key) +
         t * t * (3 - 2 * t) * value(key + 1) - t * t * s * slope(key + 1);
}

// World positions, m, of all joints and end points that the BVH file has, in frame `f`.
std::map<std::string, Vec3> PointsOf(const RigMotion& motion, int f, double unit) {
  const PosedRig posed = PoseRig(motion.rig, motion.frames[static_cast<size_t>(f)]);
  std::map<std::string, Vec3> points;
  for (size_t j = 0; j < posed.position.size(); ++j) {
    const RigJoint& joint = motion.rig.joints[j];
    points[joint.name] = unit * posed.position[j];
    if (!joint.end_site) continue;
    points[joint.name + " end"] = unit * (posed.position[j] + posed.rotation[j] * *joint.end_site);
  }
  return points;
}

struct Difference {
  int checked = 0;
  double worst = 0;  // m
};

// The file's length 0.45 makes a unit of it 1 / 0.45 inch, and the BVH file is in cm; its position
// channels replace the OFFSET of its root, so the two share one world and only the unit differs.
void Compare(const RigMotion& acclaim, const RigMotion& bvh, int f,
             bool (*wanted)(std::string_view), Difference* difference) {
  const std::map<std::string, Vec3> points = PointsOf(acclaim, f, 0.0254 / 0.45);
  for (const auto& [name, expected] : PointsOf(bvh, f, 0.01)) {
    if (!wanted(name)) continue;
    difference->worst = std::max(difference->worst, (points.at(name) - expected).norm());
    ++difference->checked;
  }
}

bool EveryPoint(std::string_view) { return true; }

// What only the root and the trunk turn, whose angles the BVH file has at every frame.
bool OnTheTrunk(std::string_view name) {
  static const std::set<std::string_view> kNames = {
      "root",     "lowerback", "upperback", "thorax",   "lowerneck", "upperneck", "head",
      "head end", "lclavicle", "rclavicle", "lhumerus", "rhumerus",  "lfemur",    "rfemur"};
  return kNames.contains(name);
}

TEST(AcclaimTest, AgreesWithTheSameMotionInBvh) {
  SKIP_WITHOUT_SHARED_DATA();
  const RigMotion bvh = ReadBvh(kClip + ".bvh").motion;
  const AcclaimFile file = ReadAcclaim(kClip + ".asf", kClip + ".amc");
  ASSERT_EQ(file.motion.num_frames(), 471);
  ASSERT_EQ(bvh.num_frames(), 471);
  EXPECT_EQ(file.motion.frame_time, bvh.frame_time);
  Difference keys, trunk;
  for (int f = 0; f < 471; ++f) {
    if (f % 4 == 0 || f == 470) Compare(file.motion, bvh, f, EveryPoint, &keys);
    Compare(file.motion, bvh, f, OnTheTrunk, &trunk);
  }
  EXPECT_EQ(keys.checked, 119 * 36);
  EXPECT_LT(keys.worst, 1e-5);
  EXPECT_EQ(trunk.checked, 471 * 14);
  EXPECT_LT(trunk.worst, 5e-5);
}

TEST(AcclaimTest, AgreesWithTheSameMotionInBvhBetweenItsKeys) {
  SKIP_WITHOUT_SHARED_DATA();
  const RigMotion bvh = ReadBvh(kClip + ".bvh").motion;
  const std::string amc = ReadWholeFile(kClip + ".amc");
  const Curves curves = CurvesOf(amc);
  std::string thinned = ":DEGREES\n";
  for (int f = 0; f < 471; ++f) {
    thinned += std::to_string(f + 1) + "\n";
    for (const auto& [bone, curve] : curves) {
      thinned += bone;
      for (size_t k = 0; k < curve[0].size(); ++k) {
        const double value =
            OnTheTrunk(bone) && !bone.ends_with("humerus") && !bone.ends_with("femur")
                ? curve[static_cast<size_t>(f)][k]
                : ThroughEveryFourth(curve, k, f);
        thinned += " " + std::to_string(value);
      }
      thinned += "\n";
    }
  }
  const AcclaimFile file =
      ParseAcclaim(ReadWholeFile(kClip + ".asf"), "16.asf", thinned, "thinned.amc");
  // The left arm is missing at first, and the last key comes after two frames: there the splines
  // depend on which angles were drawn through the keys.
  Difference all;
  for (int f = 8; f < 464; ++f) Compare(file.motion, bvh, f, EveryPoint, &all);
  EXPECT_EQ(all.checked, 456 * 36);
  EXPECT_LT(all.worst, 5e-4);
}

TEST(AcclaimTest, TheRealFileComesBackAsItWas) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string amc = ReadWholeFile(kClip + ".amc"), asf = ReadWholeFile(kClip + ".asf");
  const AcclaimFile file = ParseAcclaim(asf, "16.asf", amc, "16.amc");
  EXPECT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(FormatAsf(file), asf);
  const std::string written = FormatAmc(file, file.motion);
  const AcclaimFile again = ParseAcclaim(asf, "16.asf", written, "again.amc");
  ASSERT_EQ(again.motion.num_frames(), 471);
  int checked = 0;
  for (size_t f = 0; f < 471; ++f) {
    const PosedRig a = PoseRig(file.motion.rig, file.motion.frames[f]);
    const PosedRig b = PoseRig(again.motion.rig, again.motion.frames[f]);
    for (size_t j = 0; j < a.position.size(); ++j) {
      ASSERT_LT((a.position[j] - b.position[j]).norm() * 0.0254 / 0.45, 1e-6);
      ASSERT_LT(a.rotation[j].angularDistance(b.rotation[j]), 1e-3 * kDegree);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 471 * 31);
  // The very numbers, but for a few that have an equal turn nearer to the frame before, or are zero
  // to seven places.
  const Curves before = CurvesOf(amc), after = CurvesOf(written);
  int same = 0, all = 0;
  for (const auto& [bone, curve] : before) {
    for (size_t f = 0; f < curve.size(); ++f) {
      const auto& back = after.at(bone)[f];
      ASSERT_EQ(back.size(), curve[f].size());
      for (size_t k = 0; k < back.size(); ++k, ++all)
        same += std::abs(back[k] - curve[f][k]) < 1e-6;
    }
  }
  EXPECT_EQ(all, 471 * 62);
  EXPECT_GT(same, 0.999 * all);
  EXPECT_TRUE(written.starts_with(amc.substr(0, amc.find("\n1\r\n"))));
}

struct Bound {
  RigMotion motion;
  RigFacts facts;
  std::unique_ptr<RigBinding> binding;
};

// Frames past the left arm's gap at the start.
Bound Bind(RigMotion motion, const std::string& name) {
  Bound bound;
  bound.motion = std::move(motion);
  bound.motion.frames.erase(bound.motion.frames.begin(), bound.motion.frames.begin() + 12);
  bound.facts = Recognise(bound.motion, {}, name);
  bound.binding = std::make_unique<RigBinding>(bound.motion, bound.facts,
                                               ChestBone(bound.motion, bound.facts.map), 0);
  return bound;
}

TEST(AcclaimTest, IsRecognisedAndBoundAsItsTwin) {
  SKIP_WITHOUT_SHARED_DATA();
  const Bound amc = Bind(ReadAcclaim(kClip + ".asf", kClip + ".amc").motion, "16.amc");
  const Bound bvh = Bind(ReadBvh(kClip + ".bvh").motion, "16.bvh");
  EXPECT_EQ(amc.facts.map.profile, "cmu_asf");
  EXPECT_EQ(amc.facts.unit_name, "cmu");
  EXPECT_EQ(amc.facts.up, 'y');
  EXPECT_NEAR(amc.facts.stature, bvh.facts.stature, 1e-3);
  const auto name = [](const Bound& b, int joint) { return b.motion.rig.joints[joint].name; };
  EXPECT_EQ(name(amc, amc.facts.map.left.hip), "lfemur");
  EXPECT_EQ(name(amc, amc.facts.map.right.elbow), "rradius");
  const Body &body = amc.binding->body(), &twin = bvh.binding->body();
  int checked = 0;
  double worst_angle = 0, worst_roll = 0, worst_distance = 0;
  std::vector<Quat> roll(body.links.size(), Quat::Identity());
  for (int f = 0; f < amc.motion.num_frames(); f += 4) {  // the twin's keys
    const Pose p = amc.binding->PoseOf(amc.motion.frames[static_cast<size_t>(f)]);
    const Pose q = bvh.binding->PoseOf(bvh.motion.frames[static_cast<size_t>(f)]);
    const PosedBody a = PoseBody(body, p), b = PoseBody(twin, q);
    for (size_t n = 0; n < a.node.size(); ++n) {
      worst_distance = std::max(worst_distance, (a.node[n] - b.node[n]).norm());
    }
    for (size_t l = 0; l < a.rotation.size(); ++l, ++checked) {
      // The twin's arms hang in its rest pose with any roll, and the binding cannot know which: the
      // links of an arm agree but for a constant turn about themselves.
      const Quat apart(Mat3(a.rotation[l].transpose() * b.rotation[l]));
      const std::string& link = body.links[l].name;
      const bool arm =
          link.ends_with("shoulder") || link.ends_with("elbow") || link.ends_with("wrist");
      if (f == 0 && arm) roll[l] = TwistAbout(apart, body.links[l].limit.axis);
      const double angle = apart.angularDistance(roll[l]);
      (arm ? worst_roll : worst_angle) = std::max(arm ? worst_roll : worst_angle, angle);
    }
  }
  EXPECT_GT(checked, 2000);
  EXPECT_LT(worst_angle, 0.01 * kDegree);
  EXPECT_LT(worst_roll, 0.01 * kDegree);
  EXPECT_LT(worst_distance, 5e-5);
}

// An edit as the solver makes it, on bones that can hold only a part of it.
TEST(AcclaimTest, EditedPosesComeBackAsFarAsTheBonesAllow) {
  SKIP_WITHOUT_SHARED_DATA();
  const AcclaimFile file = ReadAcclaim(kClip + ".asf", kClip + ".amc");
  const Bound bound = Bind(file.motion, "16.amc");
  const Body& body = bound.binding->body();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  RigMotion edited = bound.motion;
  edited.frames.clear();
  std::vector<Pose> wanted;
  for (int f = 0; f < bound.motion.num_frames(); f += 20) {
    const RigFrame& frame = bound.motion.frames[static_cast<size_t>(f)];
    Pose pose = bound.binding->PoseOf(frame);
    pose.root_position += 0.1 * Vec3(normal(random), normal(random), normal(random));
    for (Quat& q : pose.rotation) {
      q = q * ExpSo3(0.1 * Vec3(normal(random), normal(random), normal(random)));
    }
    wanted.push_back(pose);
    edited.frames.push_back(bound.binding->Apply(frame, pose));
  }
  const AcclaimFile back =
      ParseAcclaim(file.asf_text, "16.asf", FormatAmc(file, edited), "edited.amc");
  double worst = 0, sum = 0;
  int checked = 0;
  for (size_t f = 0; f < wanted.size(); ++f) {
    const PosedBody a = PoseBody(body, wanted[f]);
    const PosedBody b = PoseBody(body, bound.binding->PoseOf(back.motion.frames[f]));
    for (size_t n = 0; n < a.node.size(); ++n, ++checked) {
      const double distance = (a.node[n] - b.node[n]).norm();
      sum += distance;
      worst = std::max(worst, distance);
    }
  }
  EXPECT_GT(checked, 400);
  EXPECT_LT(sum / checked, 0.003);  // several times that, were each bone fitted alone
  EXPECT_LT(worst, 0.03);
}

TEST(AcclaimTest, DamagedFilesAreReadOrRefused) {
  const std::string seed = ReadWholeFile(ProjectPath("tests/fuzz/seeds/acclaim_fuzz/figure.txt"));
  const size_t cut = seed.find('\f');
  std::vector<std::pair<std::string, std::string>> files = {
      {seed.substr(0, cut), seed.substr(cut + 1)}};
  if (std::filesystem::exists(kClip + ".asf")) {
    files.emplace_back(ReadWholeFile(kClip + ".asf"), CutAmc(ReadWholeFile(kClip + ".amc"), 40));
    ASSERT_LT(files.back().second.size(), 50'000u);
  }
  for (const auto& [asf, amc] : files) ASSERT_TRUE(ReadsOrRefusesAcclaim(asf, amc));
  int accepted = 0;
  constexpr int kCopies = 500;
  for (uint64_t copy = 0; copy < kCopies; ++copy) {
    auto [asf, amc] = files[copy % files.size()];
    DamageAcclaim(copy, &asf, &amc);
    ASSERT_NO_THROW(accepted += ReadsOrRefusesAcclaim(asf, amc) ? 1 : 0) << copy;
  }
  EXPECT_GT(accepted, 20);  // both outcomes were reached
  EXPECT_LT(accepted, kCopies - 20);
}

}  // namespace
}  // namespace retarget::io
