// Long for its table of words.
#include "io/recognition/joint_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace retarget::io {
namespace {

enum class Meaning {
  kLeft,
  kRight,
  kCentre,
  kUpper,
  kLower,
  kArm,
  kLeg,
  kNoise,  // known, and says nothing
  kHelper,
  kTrunk,
  kPelvis,  // a trunk word; of a side a helper
  kNeck,
  kHead,
  kClavicle,
  kShoulder,
  kUpperArm,
  kForearm,
  kWrist,
  kHand,
  kMiddle,
  kFinger,
  kHip,
  kThigh,
  kShin,
  kAnkle,
  kFoot,
  kToe
};

struct Word {
  std::string_view text;
  Meaning meaning;
};

constexpr auto kWords = std::to_array<Word>({
    {"left", Meaning::kLeft},
    {"lft", Meaning::kLeft},
    {"lt", Meaning::kLeft},
    {"lf", Meaning::kLeft},
    {"right", Meaning::kRight},
    {"rgt", Meaning::kRight},
    {"rt", Meaning::kRight},
    {"center", Meaning::kCentre},
    {"centre", Meaning::kCentre},
    {"upper", Meaning::kUpper},
    {"up", Meaning::kUpper},
    {"upr", Meaning::kUpper},
    {"uppr", Meaning::kUpper},
    {"lower", Meaning::kLower},
    {"low", Meaning::kLower},
    {"lo", Meaning::kLower},
    {"lwr", Meaning::kLower},
    {"fore", Meaning::kLower},
    {"arm", Meaning::kArm},
    {"leg", Meaning::kLeg},
    {"humerus", Meaning::kUpperArm},
    {"bicep", Meaning::kUpperArm},
    {"biceps", Meaning::kUpperArm},
    {"forearm", Meaning::kForearm},
    {"elbow", Meaning::kForearm},
    {"radius", Meaning::kForearm},
    {"ulna", Meaning::kForearm},
    {"clavicle", Meaning::kClavicle},
    {"clav", Meaning::kClavicle},
    {"collar", Meaning::kClavicle},
    {"collarbone", Meaning::kClavicle},
    {"scapula", Meaning::kClavicle},
    {"shoulder", Meaning::kShoulder},
    {"shldr", Meaning::kShoulder},
    {"shoulders", Meaning::kTrunk},
    {"wrist", Meaning::kWrist},
    {"hand", Meaning::kHand},
    {"palm", Meaning::kHand},
    {"fist", Meaning::kHand},
    {"middle", Meaning::kMiddle},
    {"mid", Meaning::kMiddle},
    {"thumb", Meaning::kFinger},
    {"index", Meaning::kFinger},
    {"ring", Meaning::kFinger},
    {"pinky", Meaning::kFinger},
    {"pinkie", Meaning::kFinger},
    {"little", Meaning::kFinger},
    {"finger", Meaning::kFinger},
    {"fingers", Meaning::kFinger},
    {"metacarpal", Meaning::kFinger},
    {"carpal", Meaning::kFinger},
    {"proximal", Meaning::kFinger},
    {"intermediate", Meaning::kFinger},
    {"distal", Meaning::kFinger},
    {"phalanx", Meaning::kFinger},
    {"hip", Meaning::kHip},
    {"thigh", Meaning::kThigh},
    {"femur", Meaning::kThigh},
    {"knee", Meaning::kShin},
    {"shin", Meaning::kShin},
    {"calf", Meaning::kShin},
    {"tibia", Meaning::kShin},
    {"crus", Meaning::kShin},
    {"ankle", Meaning::kAnkle},
    {"talus", Meaning::kAnkle},
    {"foot", Meaning::kFoot},
    {"feet", Meaning::kFoot},
    {"toe", Meaning::kToe},
    {"toes", Meaning::kToe},
    {"ball", Meaning::kToe},
    {"head", Meaning::kHead},
    {"skull", Meaning::kHead},
    {"neck", Meaning::kNeck},
    {"hips", Meaning::kTrunk},
    {"pelvis", Meaning::kPelvis},
    {"waist", Meaning::kTrunk},
    {"spine", Meaning::kTrunk},
    {"abdomen", Meaning::kTrunk},
    {"belly", Meaning::kTrunk},
    {"stomach", Meaning::kTrunk},
    {"torso", Meaning::kTrunk},
    {"trunk", Meaning::kTrunk},
    {"chest", Meaning::kTrunk},
    {"thorax", Meaning::kTrunk},
    {"back", Meaning::kTrunk},
    {"lumbar", Meaning::kTrunk},
    {"ribs", Meaning::kTrunk},
    {"ribcage", Meaning::kTrunk},
    {"root", Meaning::kTrunk},
    {"body", Meaning::kTrunk},
    {"base", Meaning::kNoise},
    {"bone", Meaning::kNoise},
    {"joint", Meaning::kNoise},
    {"jnt", Meaning::kNoise},
    {"bind", Meaning::kNoise},
    {"skin", Meaning::kNoise},
    {"rig", Meaning::kNoise},
    {"bend", Meaning::kNoise},
    {"def", Meaning::kNoise},
    {"twist", Meaning::kHelper},
    {"roll", Meaning::kHelper},
    {"ik", Meaning::kHelper},
    {"target", Meaning::kHelper},
    {"goal", Meaning::kHelper},
    {"pole", Meaning::kHelper},
    {"helper", Meaning::kHelper},
    {"aim", Meaning::kHelper},
    {"corrective", Meaning::kHelper},
    {"muscle", Meaning::kHelper},
    {"socket", Meaning::kHelper},
    {"attach", Meaning::kHelper},
    {"prop", Meaning::kHelper},
    {"weapon", Meaning::kHelper},
    {"ctrl", Meaning::kHelper},
    {"control", Meaning::kHelper},
    {"org", Meaning::kHelper},
    {"mch", Meaning::kHelper},
    {"end", Meaning::kHelper},
    {"nub", Meaning::kHelper},
    {"tip", Meaning::kHelper},
    {"top", Meaning::kHelper},
    {"leaf", Meaning::kHelper},
    {"effector", Meaning::kHelper},
    {"eff", Meaning::kHelper},
    {"site", Meaning::kHelper},
    {"heel", Meaning::kHelper},
    {"hair", Meaning::kHelper},
    {"eye", Meaning::kHelper},
    {"eyes", Meaning::kHelper},
    {"jaw", Meaning::kHelper},
    {"ear", Meaning::kHelper},
    {"brow", Meaning::kHelper},
    {"skirt", Meaning::kHelper},
    {"cloth", Meaning::kHelper},
    {"breast", Meaning::kHelper},
    {"bust", Meaning::kHelper},
    {"pec", Meaning::kHelper},
    {"tail", Meaning::kHelper},
    {"buttock", Meaning::kHelper},
});

std::optional<Meaning> MeaningOf(std::string_view text) {
  for (const Word& word : kWords) {
    if (word.text == text) return word.meaning;
  }
  return std::nullopt;
}

// The letter of a side, which may also lean on a word: "lForeArm", "armr".
std::optional<Meaning> SideLetter(std::string_view text) {
  if (text == "l") return Meaning::kLeft;
  if (text == "r") return Meaning::kRight;
  if (text == "c" || text == "m") return Meaning::kCentre;
  return std::nullopt;
}

// Words written in one, "upperarm", "leftforearm": all of the text, or nothing.
bool Segment(std::string_view text, std::vector<Meaning>* out) {
  if (text.empty()) return true;
  for (size_t length = text.size(); length >= 2; --length) {  // long words first
    const auto meaning = MeaningOf(text.substr(0, length));
    if (!meaning) continue;
    const size_t kept = out->size();
    out->push_back(*meaning);
    if (Segment(text.substr(length), out)) return true;
    out->resize(kept);
  }
  return false;
}

void ReadText(std::string_view text, std::vector<Meaning>* out) {
  constexpr size_t kLongest = 40;  // of a name's part that is looked at
  if (text.size() > kLongest) return;
  if (const auto side = SideLetter(text)) {
    out->push_back(*side);
    return;
  }
  std::vector<Meaning> words;
  if (Segment(text, &words)) {
    out->insert(out->end(), words.begin(), words.end());
    return;
  }
  if (text.size() < 3) return;
  for (const bool first : {true, false}) {
    const auto side = SideLetter(text.substr(first ? 0 : text.size() - 1, 1));
    words.clear();
    if (!side || !Segment(text.substr(first ? 1 : 0, text.size() - 1), &words)) continue;
    out->push_back(*side);
    out->insert(out->end(), words.begin(), words.end());
    return;
  }
}

// Splits at what is no letter and where a capital begins a word; lower case.
std::vector<std::string> SplitName(std::string_view name) {
  if (const size_t space = name.find_last_of(":|"); space != std::string_view::npos) {
    name.remove_prefix(space + 1);
  }
  const auto is = [&](auto test, size_t k) {
    return k < name.size() && test(static_cast<unsigned char>(name[k])) != 0;
  };
  std::vector<std::string> words(1);
  for (size_t k = 0; k < name.size(); ++k) {
    if (!is(isalpha, k)) {
      words.emplace_back();
      continue;
    }
    const bool begins = is(isupper, k) && k > 0 &&
                        (is(islower, k - 1) || (is(isupper, k - 1) && is(islower, k + 1)));
    if (begins) words.emplace_back();
    words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(name[k])));
  }
  std::erase_if(words, [](const std::string& word) { return word.empty(); });
  return words;
}

BodyPart PartOf(const std::vector<Meaning>& words, bool sided) {
  const auto has = [&](Meaning meaning) {
    return std::find(words.begin(), words.end(), meaning) != words.end();
  };
  if (has(Meaning::kHelper)) return BodyPart::kHelper;
  if (has(Meaning::kToe)) return BodyPart::kToe;
  if (sided && has(Meaning::kMiddle)) return BodyPart::kMiddleFinger;
  if (has(Meaning::kFinger)) return BodyPart::kFinger;
  if (sided && has(Meaning::kPelvis)) return BodyPart::kHelper;
  if (has(Meaning::kArm) && has(Meaning::kUpper)) return BodyPart::kUpperArm;
  if (has(Meaning::kArm) && has(Meaning::kLower)) return BodyPart::kForearm;
  if (has(Meaning::kLeg) && has(Meaning::kUpper)) return BodyPart::kThigh;
  if (has(Meaning::kLeg) && has(Meaning::kLower)) return BodyPart::kShin;
  constexpr std::pair<Meaning, BodyPart> kSided[] = {{Meaning::kAnkle, BodyPart::kAnkle},
                                                     {Meaning::kFoot, BodyPart::kFoot},
                                                     {Meaning::kWrist, BodyPart::kWrist},
                                                     {Meaning::kHand, BodyPart::kHand},
                                                     {Meaning::kShin, BodyPart::kShin},
                                                     {Meaning::kThigh, BodyPart::kThigh},
                                                     {Meaning::kForearm, BodyPart::kForearm},
                                                     {Meaning::kUpperArm, BodyPart::kUpperArm},
                                                     {Meaning::kClavicle, BodyPart::kClavicle},
                                                     {Meaning::kShoulder, BodyPart::kShoulder},
                                                     {Meaning::kLeg, BodyPart::kLeg},
                                                     {Meaning::kArm, BodyPart::kArm},
                                                     {Meaning::kHip, BodyPart::kHip}};
  for (const auto& [meaning, part] : kSided) {
    if (sided && has(meaning)) return part;
  }
  if (sided) return BodyPart::kNone;
  if (has(Meaning::kNeck)) return BodyPart::kNeck;
  if (has(Meaning::kHead)) return BodyPart::kHead;
  for (const Meaning trunk :
       {Meaning::kTrunk, Meaning::kPelvis, Meaning::kHip, Meaning::kShoulder}) {
    if (has(trunk)) return BodyPart::kTrunk;
  }
  return BodyPart::kNone;
}

}  // namespace

JointWords ReadJointWords(std::string_view name) {
  std::vector<Meaning> words;
  for (const std::string& text : SplitName(name)) ReadText(text, &words);
  const auto has = [&](Meaning meaning) {
    return std::find(words.begin(), words.end(), meaning) != words.end();
  };
  JointWords out;
  if (has(Meaning::kLeft) != has(Meaning::kRight)) {
    out.side = has(Meaning::kLeft) ? BodySide::kLeft : BodySide::kRight;
  }
  out.part = PartOf(words, out.side != BodySide::kNone);
  return out;
}

std::vector<JointWords> ReadJointWords(const Rig& rig) {
  std::vector<JointWords> out;
  for (const RigJoint& joint : rig.joints) out.push_back(ReadJointWords(joint.name));
  return out;
}

}  // namespace retarget::io
