// Map files: what is written reads back, and what is wrong is told with its line.
#include "io/map_file.h"

#include <gtest/gtest.h>

#include "io/recognition/recognise.h"
#include "tests/rig_figure.h"

namespace retarget::io {
namespace {

void ExpectEqual(const JointMap& a, const JointMap& b) {
  EXPECT_EQ(a.root, b.root);
  EXPECT_EQ(a.spine, b.spine);
  EXPECT_EQ(a.neck, b.neck);
  EXPECT_EQ(a.head, b.head);
  EXPECT_EQ(a.head_top, b.head_top);
  for (const auto side : {&JointMap::left, &JointMap::right}) {
    for (const auto joint :
         {&JointMap::Side::clavicle, &JointMap::Side::shoulder, &JointMap::Side::elbow,
          &JointMap::Side::wrist, &JointMap::Side::hand, &JointMap::Side::hip,
          &JointMap::Side::knee, &JointMap::Side::ankle, &JointMap::Side::toe}) {
      EXPECT_EQ(a.*side.*joint, b.*side.*joint);
    }
  }
}

std::string ErrorOf(const std::string& text, const Rig& rig) {
  try {
    ParseMap(text, "m.yaml", rig);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(MapFile, WhatIsWrittenReadsBack) {
  for (const int spines : {0, 1, 4}) {
    for (const bool unnamed : {false, true}) {
      JointNames names = MixamoNames(spines);
      if (spines == 1) names.erase("neck");
      RigFigure figure(names);
      if (unnamed) {
        for (RigJoint& joint : figure.motion.rig.joints) joint.name = "bone";
        if (spines == 0) continue;  // its shape alone does not tell a trunk of no bones
      }
      const RigFacts facts = Recognise(figure.motion, {}, "f");
      const MapFile file = ParseMap(FormatMap(figure.motion, facts), "m", figure.motion.rig);
      ExpectEqual(file.map, facts.map);
      EXPECT_EQ(file.metres_per_unit, facts.metres_per_unit);
      EXPECT_EQ(file.up, facts.up);
      RecogniseOptions options;
      options.map = file.map;
      EXPECT_EQ(Recognise(figure.motion, options, "f").map.profile, "by hand");
    }
  }
}

TEST(MapFile, OddNamesSurvive) {
  RigFigure figure(MixamoNames(2));
  const char* odd[] = {"none",
                       "#3",
                       "a: b",
                       "[x]",
                       "\xFF\xFE",
                       "",
                       "\"",
                       "null",
                       "12",
                       "a\tb",
                       "\u30bb\u30f3\u30bf\u30fc"};
  for (size_t n = 0; n < std::size(odd); ++n) figure.motion.rig.joints[n].name = odd[n];
  RigFacts facts;
  facts.map = Recognise(RigFigure(MixamoNames(2)).motion, {}, "f").map;
  const std::string text = FormatMap(figure.motion, facts);
  ExpectEqual(ParseMap(text, "m", figure.motion.rig).map, facts.map);
}

TEST(MapFile, ErrorsNameTheirPlace) {
  RigFigure figure(MixamoNames(2));
  figure.Add("Twin", 0, Vec3::Zero());
  figure.Add("Twin", 0, Vec3::Zero());
  figure.Rest();
  const Rig& rig = figure.motion.rig;
  const std::string good = FormatMap(figure.motion, Recognise(figure.motion, {}, "f"));
  EXPECT_EQ(ErrorOf(good, rig), "");
  const struct {
    const char *from, *to, *expected;
  } cases[] = {
      {"left_knee: LeftLeg", "left_knee: LeftLegg",
       "joints.left_knee: no bone \"LeftLegg\", the nearest names are \"LeftLeg\""},
      {"left_knee: LeftLeg", "left_kne: LeftLeg",
       "unknown key \"joints.left_kne\", did you mean \"joints.left_knee\"?"},
      {"left_knee: LeftLeg", "left_knee: none", "joints.left_knee: expected a bone, found none"},
      {"left_knee: LeftLeg", "left_knee:", "joints.left_knee: expected the name of a bone"},
      {"  left_knee: LeftLeg\n", "", "missing key \"joints.left_knee\""},
      {"left_knee: LeftLeg", "left_knee: RightLeg",
       "joints.left_knee: \"RightLeg\" does not hang from \"LeftUpLeg\""},
      {"right_knee: RightLeg", "right_knee: LeftLeg",
       "joints.right_knee: \"LeftLeg\" plays joints.left_knee already"},
      {"left_toe: LeftToeBase", "left_toe: Twin", "several bones are called \"Twin\": give \"#"},
      {"left_toe: LeftToeBase", "left_toe: \"#99\"", "joints.left_toe: expected #0 to #"},
      {"spine: [Spine, Spine1]", "spine: [Spine1, Spine]",
       "joints.spine[1]: \"Spine\" does not hang from \"Spine1\""},
      {"format: 1", "format: 2", "format: expected a whole number from 1 to 1"},
      {"units: cm", "units: parsec", "units: expected cm, m, mm, dm, in, cmu or metres per unit"},
      {"up: y", "up: x", "up: unknown axis \"x\""},
      {"up: y", "colour: y", "unknown key \"colour\""}};
  for (const auto& c : cases) {
    const std::string error = ErrorOf(Replaced(good, c.from, c.to), rig);
    EXPECT_NE(error.find(c.expected), std::string::npos) << error;
    EXPECT_TRUE(error.starts_with("m.yaml:")) << error;
  }
}

// What is left out is virtual, as `none` is.
TEST(MapFile, JointsLeftOutAreVirtual) {
  const RigFigure figure(MixamoNames(2));
  std::string text = FormatMap(figure.motion, Recognise(figure.motion, {}, "f"));
  text = Replaced(text, "  neck: [Neck]\n", "");
  text = Replaced(text, "  left_clavicle: LeftShoulder\n", "");
  text = Replaced(text, "  right_clavicle: RightShoulder\n", "  right_clavicle: none\n");
  RecogniseOptions options;
  options.map = ParseMap(text, "m", figure.motion.rig).map;
  EXPECT_EQ(Recognise(figure.motion, options, "f").virtual_joints,
            (std::vector<std::string>{"neck", "left_clavicle", "right_clavicle"}));
}

// A refused figure gets a draft: what it needs is named, and filled in it reads.
TEST(MapFile, DraftsCanBeFilledIn) {
  RigFigure figure(MixamoNames(2));
  auto& joints = figure.motion.rig.joints;
  joints[static_cast<size_t>(figure.motion.rig.Find("LeftLeg"))].name = "Stilt";
  const std::string draft = FormatMapDraft(figure.motion, "refused:\nfor no reason");
  EXPECT_NE(draft.find("  left_knee:  # required; nearest: "), std::string::npos) << draft;
  EXPECT_NE(draft.find("#   Stilt\n"), std::string::npos);
  EXPECT_NE(ErrorOf(draft, figure.motion.rig), "");
  const std::string filled = Replaced(draft, "  left_knee: ", "  left_knee: Stilt");
  EXPECT_EQ(ErrorOf(filled, figure.motion.rig), "") << filled;
}

}  // namespace
}  // namespace retarget::io
