// Contact detection on made-up feet whose contacts are known by hand: the whole body is slid, so
// the supporting node goes exactly where the test says.
#include "model/body/contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/geometry/so3.h"

namespace retarget {
namespace {

constexpr double kStepM = 0.05;  // per frame: far above the speed limit, even when halved

class ContactTest : public testing::Test {
 protected:
  ContactTest()
      : body_(StandardBody(AverageMeasures(1.75))), ankle_(body_.FindNode("left_ankle")) {}

  // One letter per frame interval: '.' stays, 'x' goes forward by kStepM.
  Clip Sliding(const std::string& intervals, double fps = 30) const {
    Clip clip;
    clip.fps = fps;
    Pose pose = RestPose(body_);
    clip.frames.push_back(pose);
    for (const char c : intervals) {
      if (c == 'x') pose.root_position.z() += kStepM;
      clip.frames.push_back(pose);
    }
    return clip;
  }
  // The body stands at these heights (m), one per frame.
  Clip AtHeights(const std::vector<double>& heights) const {
    Clip clip;
    for (const double y : heights) {
      clip.frames.push_back(RestPose(body_));
      clip.frames.back().root_position.y() = y;
    }
    return clip;
  }
  std::string Detect(const Clip& clip, const std::vector<int>& supports,
                     const ContactSettings& settings = {}) const {
    std::string out;
    for (const Contact& c : DetectContacts(body_, clip, supports, settings)) {
      if (!out.empty()) out += " ";
      out += std::to_string(c.first) + "-" + std::to_string(c.last);
    }
    return out;
  }
  std::string Detect(const Clip& clip, const ContactSettings& settings = {}) const {
    return Detect(clip, {ankle_}, settings);
  }
  static std::string Repeat(char c, int times) {
    return std::string(static_cast<size_t>(times), c);
  }

  Body body_;
  int ankle_;
};

TEST_F(ContactTest, AStandingFootIsPlantedThroughoutAndAMovingOneNever) {
  EXPECT_EQ(Detect(Sliding(Repeat('.', 30))), "0-30");
  EXPECT_EQ(Detect(Sliding(Repeat('x', 30))), "");
}

TEST_F(ContactTest, SpeedIsTheCentralDifference) {
  // Still to frame 10, moving to frame 20, still to 30. Frames 10 and 20 move on one side.
  EXPECT_EQ(Detect(Sliding(Repeat('.', 10) + Repeat('x', 10) + Repeat('.', 10))), "0-9 21-30");
  // At 30 fps one interval of 5 cm counts 0.75 m/s at both its ends.
  ContactSettings settings;
  settings.max_gap_s = 0.01;  // less than a frame
  settings.speed = 0.76;
  EXPECT_EQ(Detect(Sliding(Repeat('.', 10) + "x" + Repeat('.', 10)), settings), "0-21");
  settings.speed = 0.74;
  EXPECT_EQ(Detect(Sliding(Repeat('.', 10) + "x" + Repeat('.', 10)), settings), "0-9 12-21");
}

TEST_F(ContactTest, GapsShorterThanATenthOfASecondAreClosed) {
  // Two frames (67 ms) are lifted: closed. Three (100 ms) are not shorter than the limit.
  EXPECT_EQ(Detect(Sliding(Repeat('.', 20) + "x" + Repeat('.', 20))), "0-41");
  EXPECT_EQ(Detect(Sliding(Repeat('.', 20) + "xx" + Repeat('.', 20))), "0-19 23-42");
  // At 60 fps five frames (83 ms) close, six (100 ms) do not.
  EXPECT_EQ(Detect(Sliding(Repeat('.', 20) + "xxxx" + Repeat('.', 20), 60)), "0-44");
  EXPECT_EQ(Detect(Sliding(Repeat('.', 20) + "xxxxx" + Repeat('.', 20), 60)), "0-19 26-45");
}

TEST_F(ContactTest, ThenRunsShorterThanAFifthOfASecondAreDropped) {
  // A run of k still frames has k + 1 still intervals between moving ones.
  const std::string walk = Repeat('x', 10);
  EXPECT_EQ(Detect(Sliding(walk + Repeat('.', 6) + walk)), "");       // 5 frames, 167 ms
  EXPECT_EQ(Detect(Sliding(walk + Repeat('.', 7) + walk)), "11-16");  // 6 frames, 200 ms
}

TEST_F(ContactTest, GapsAreClosedBeforeShortRunsAreDropped) {
  // Twice 4 frames (133 ms each, too short) with a gap of 2 in between make one run of 10.
  const std::string walk = Repeat('x', 10);
  const std::string twice = walk + Repeat('.', 5) + "x" + Repeat('.', 5) + walk;
  EXPECT_EQ(Detect(Sliding(twice)), "11-20");
  ContactSettings settings;
  settings.max_gap_s = 0.01;  // less than a frame
  EXPECT_EQ(Detect(Sliding(twice), settings), "");
}

TEST_F(ContactTest, HeightCountsFromTheFifthPercentile) {
  // Of 101 frames the 5th percentile is the sixth lowest. Six low frames set it to the low height,
  // five leave it at the high one.
  ContactSettings settings;
  settings.min_length_s = 0.1;
  settings.max_gap_s = 0.01;  // less than a frame
  std::vector<double> heights(101, 0.5);
  for (int t = 0; t < 6; ++t) heights[t] = 0;
  EXPECT_EQ(Detect(AtHeights(heights), settings), "0-4");
  heights[5] = 0.5;
  EXPECT_EQ(Detect(AtHeights(heights), settings), "0-3 6-100");
}

TEST_F(ContactTest, WithinThreeCentimetresOfThePercentile) {
  for (const double shelf : {0.029, 0.031}) {
    std::vector<double> heights(30, 0.0);
    for (int t = 0; t < 30; ++t) heights.push_back(shelf);
    // The rise of 3 cm within one interval is 0.45 m/s at frames 29 and 30.
    EXPECT_EQ(Detect(AtHeights(heights)), shelf < 0.03 ? "0-59" : "0-28") << shelf;
  }
}

TEST_F(ContactTest, EachNodeHasItsOwnHeightAndContactsComeByNode) {
  // The knee is bent for the second half: the ankle goes up, the hip stays.
  Clip clip;
  for (int t = 0; t < 40; ++t) {
    Pose pose = RestPose(body_);
    if (t >= 20) pose.rotation[body_.FindLink("left_knee")] = ExpSo3(Vec3(1, 0, 0));
    clip.frames.push_back(pose);
  }
  const int hip = body_.FindNode("left_hip");
  const auto contacts = DetectContacts(body_, clip, {hip, ankle_}, {});
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].node, hip);
  EXPECT_EQ(contacts[1].node, ankle_);
  EXPECT_EQ(Detect(clip, std::vector<int>{hip, ankle_}), "0-39 0-18");
  EXPECT_EQ(Detect(clip, std::vector<int>{}), "");
}

TEST_F(ContactTest, TurningAndRaisingTheWorldChangesNothing) {
  Clip clip = Sliding(Repeat('.', 12) + Repeat('x', 5) + Repeat('.', 9) + "x" + Repeat('.', 9));
  const std::string before = Detect(clip);
  EXPECT_EQ(before, "0-11 18-36");
  for (Pose& pose : clip.frames) pose = Moved(pose, YawRotation(1.1), Vec3(3, -2, 5));
  EXPECT_EQ(Detect(clip), before);
}

TEST_F(ContactTest, OneFrameIsTooShort) {
  EXPECT_EQ(Detect(Sliding("")), "");
  ContactSettings settings;
  settings.min_length_s = 0;
  EXPECT_EQ(Detect(Sliding(""), settings), "0-0");
}

}  // namespace
}  // namespace retarget
