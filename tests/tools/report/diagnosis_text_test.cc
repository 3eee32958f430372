// Conflicts that are known beforehand, in words.
#include "tools/report/diagnosis_text.h"

#include "tests/solver/metrics/diagnosis_fixture.h"
#include "tools/report/requirement_text.h"

namespace retarget::report {
namespace {

using solver::HandTo;
using solver::Solved;

void ExpectSays(const std::string& sentence, const std::string& words) {
  EXPECT_NE(sentence.find(words), std::string::npos) << words << " in: " << sentence;
}
std::string OfHold(const Solved& s, int k) { return DiagnosisSentence(s.OfHold(k), s.subject); }

TEST(DiagnosisSentence, TwoHoldsThatPullOneHandApart) {
  const Solved s(HandTo({Vec3(0, 0.2, -0.1), Vec3(0, -0.2, 0.1)}), {});
  for (const int k : {0, 1}) {
    ExpectSays(OfHold(s, k), "hold " + std::to_string(2 - k));
    ExpectSays(OfHold(s, k), "no weight settles that");
  }
}

TEST(DiagnosisSentence, AHoldFarAwayAgainstPlantedFeet) {
  const Solved s(HandTo({Vec3(0, 3, 0)}), solver::PlantedSettings());
  ExpectSays(OfHold(s, 0), "`hold` and `foot_lock` (a ");
  ExpectSays(OfHold(s, 0), "contradict each other");
}

TEST(DiagnosisSentence, AFeebleWeightIsNamedWithItsDefault) {
  Settings settings;
  settings.weights.hold = 0.1;
  const std::string feeble = OfHold(Solved(HandTo({Vec3(0, 0.15, 0)}), settings), 0);
  ExpectSays(feeble, "a left_hand misses its place in the world by 1");
  ExpectSays(feeble, "far below its default: --set weights.hold=60");
  settings.weights.hold = 0;
  ExpectSays(OfHold(Solved(HandTo({Vec3(0, 0.15, 0)}), settings), 0), "weights.hold is 0");
}

TEST(DiagnosisSentence, NamesTheSuggestion) {
  const Solved s(HandTo({Vec3(0.1, 0.3, 0)}), solver::StiffSettings());
  const std::string sentence = OfHold(s, 0);
  const size_t at = sentence.find("--set weights.hold=");
  ASSERT_NE(at, std::string::npos) << sentence;
  EXPECT_EQ(std::stod(sentence.substr(at + 19)), s.OfHold(0).suggestion->value);
}

class MissSentence : public solver::MissTest {
 protected:
  std::string Say(const solver::RequirementCheck& check) const {
    return DiagnosisSentence(ConflictAbout(check), subject_);
  }
};

TEST_F(MissSentence, TwoPlantedFeetInOnePlace) {
  const std::string sentence = Say(FeetInOnePlace());
  ExpectSays(sentence, "penetration: a right_toe is 6.0 cm inside b right_toe at frame 5");
  ExpectSays(sentence,
             "plant both feet in one place (a right_toe, planted in frames 3 to 8; b right_toe, "
             "planted in frames 3 to 8)");
}

TEST_F(MissSentence, RequirementsThatNoTermServes) {
  ExpectSays(Say(PassThroughs()),
             "a left_wrist goes through b head between frames 3 and 4 (the first of 2)");
  ExpectSays(Say(WriteBack()), "write-back a: 0.007 m, 0.005 m is allowed");
}

TEST_F(MissSentence, ATagThatAimsTooLowOrHasComeApart) {
  solver::RequirementCheck check = TagFarAway();
  ExpectSays(Say(check), "hardly changes");
  subject_.tangles[0].target = 0.45;
  subject_.tangles[0].tag.tangle.gli = 0.45;
  ExpectSays(Say(check), "the template itself shows no more than 0.45");
  subject_.tangles[0].tag.tangle.gli = -0.97;
  check.limit = 0.6;
  ExpectSays(Say(check), "--set tangle.margin=0.16");
}

// Names, units and places, which report.json has and people read.
TEST_F(MissSentence, PlacesOfRequirements) {
  using Kind = solver::RequirementKind;
  EXPECT_EQ(WorstPlace(FeetInOnePlace(), subject_.body), "frame 5, a right_toe in b right_toe");
  EXPECT_EQ(WorstPlace(PassThroughs(), subject_.body), "frame 3, a left_wrist through b head");
  solver::RequirementCheck tangle{.kind = Kind::kTangle, .item = 0, .frame = 4};
  tangle.limbs = {{0, Node(0, "left_hand")},
                  {0, Node(0, "right_hand")},
                  {1, Node(1, "root")},
                  {1, Node(1, "head_top")}};
  EXPECT_EQ(WorstPlace(tangle, subject_.body),
            "a (left_hand, right_hand) x b (root, head_top), frame 4");
  EXPECT_EQ(NameOf(tangle), "tangle 1");
  const solver::RequirementCheck drift{.kind = Kind::kFootDrift, .figure = 1, .frame = 5};
  EXPECT_EQ(NameOf(drift), "foot drift b");
  EXPECT_EQ(WorstPlace(drift, subject_.body), "frame 5");
  EXPECT_EQ(WorstPlace({.kind = Kind::kFloor, .figure = 0, .frame = 5}, subject_.body), "");
  EXPECT_EQ(WorstPlace({.kind = Kind::kPassThroughs}, subject_.body), "");
  EXPECT_EQ(NameOf({.kind = Kind::kPenetrationOver1cm}), "penetration over 1 cm");
}

}  // namespace
}  // namespace retarget::report
