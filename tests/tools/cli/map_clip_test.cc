// Joint maps from the command line's side: print, edit, give back.
#include <unistd.h>

#include "io/load_clip.h"
#include "io/recognition/recognise.h"
#include "tests/test_data.h"

namespace retarget::cli {
namespace {

class MapClip : public testing::Test {
 protected:
  MapClip() {
    std::string name = (std::filesystem::temp_directory_path() / "retarget-map-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~MapClip() override { std::filesystem::remove_all(folder_); }

  std::string Write(const std::string& text) {
    const std::string path = folder_ + "/a.map.yaml";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string Error(const io::ClipOptions& options) {
    try {
      io::LoadClip(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const std::string bear_hug_ = ProjectPath("data/holds/bear_hug/a.bvh");
  std::string folder_;
};

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST_F(MapClip, ThePrintedMapGivesTheSameClip) {
  io::ClipOptions options;
  options.path = bear_hug_;
  const io::LoadedClip guessed = io::LoadClip(options);
  options.map = Write(io::MapOfClip(options));
  const io::LoadedClip mapped = io::LoadClip(options);
  EXPECT_EQ(mapped.facts.map.profile, "by hand");
  EXPECT_EQ(mapped.facts.metres_per_unit, guessed.facts.metres_per_unit);
  const Pose p = guessed.binding->PoseOf(guessed.file.motion.frames[10]);
  const Pose q = mapped.binding->PoseOf(mapped.file.motion.frames[10]);
  for (size_t l = 0; l < p.rotation.size(); ++l) {
    EXPECT_LT(p.rotation[l].angularDistance(q.rotation[l]), 1e-9);
  }
}

TEST_F(MapClip, AnEditedMapLocksAJointAndOptionsWin) {
  io::ClipOptions options;
  options.path = bear_hug_;
  const io::LoadedClip guessed = io::LoadClip(options);
  const Rig& rig = guessed.file.motion.rig;
  const std::string clavicle =
      rig.joints[static_cast<size_t>(guessed.facts.map.left.clavicle)].name;
  std::string text = io::MapOfClip(options);
  text = Replaced(text, "left_clavicle: " + clavicle, "left_clavicle: none");
  text = Replaced(text, "units: " + guessed.facts.unit_name, "units: 0.5");
  options.map = Write(text);
  options.units = guessed.facts.unit_name;
  const io::LoadedClip mapped = io::LoadClip(options);
  EXPECT_EQ(mapped.facts.metres_per_unit, guessed.facts.metres_per_unit);
  const Body& body = mapped.binding->body();
  EXPECT_TRUE(body.links[static_cast<size_t>(body.FindLink("left_clavicle"))].locked);
  EXPECT_FALSE(body.links[static_cast<size_t>(body.FindLink("right_clavicle"))].locked);
}

TEST_F(MapClip, ErrorsAreOneLineWithTheirPlace) {
  io::ClipOptions options;
  options.path = bear_hug_;
  options.map = Write("format: 1\njoints: {root: Nobody}\n");
  EXPECT_NE(Error(options).find("a.map.yaml:2: joints.root: no bone \"Nobody\", the nearest "),
            std::string::npos)
      << Error(options);
  options.map = folder_ + "/nowhere.yaml";
  EXPECT_NE(Error(options).find("nowhere.yaml: found no readable file, expected a joint map"),
            std::string::npos);
}

// A figure that is refused prints a draft with the reason; its joints are to be filled in.
TEST_F(MapClip, RefusedFiguresPrintADraft) {
  io::ClipOptions options;
  options.path = Write(
      "HIERARCHY\nROOT Base\n{\n OFFSET 0 0 0\n CHANNELS 3 Xrotation Yrotation Zrotation\n"
      " JOINT Arm\n {\n  OFFSET 0 1 0\n  CHANNELS 3 Xrotation Yrotation Zrotation\n"
      "  End Site\n  {\n   OFFSET 0 1 0\n  }\n }\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n"
      "0 0 0 0 0 0\n");
  EXPECT_NE(Error(options).find("no human figure: it has 2 joints"), std::string::npos);
  const std::string draft = io::MapOfClip(options);
  EXPECT_NE(draft.find("no human figure: it has 2 joints"), std::string::npos);
  EXPECT_NE(draft.find("  left_hip:  # required; nearest: "), std::string::npos) << draft;
  EXPECT_NE(draft.find("#   Base\n"), std::string::npos);
}

}  // namespace
}  // namespace retarget::cli
