// The table of operations: each by the command line, by JSON and by its label; and the page's types
// that are made from it.
#include "tools/posing/operation_table.h"

#include <gtest/gtest.h>

#include <set>

#include "io/text/json.h"
#include "tests/test_data.h"
#include "tools/posing/command_line.h"
#include "tools/posing/json.h"
#include "tools/posing/label.h"
#include "tools/posing/session.h"
#include "tools/posing/typescript.h"

namespace retarget::posing {
namespace {

const PoseState& State() {
  static const PoseState state{RestPosture(1.7, 1.8, 1), {}, {}};
  return state;
}

PoseStep OfJson(const std::string& text) {
  const io::Document message = io::ParseJson(text);
  return ParsePoseJson(message.root(), State().posture);
}

std::string Written(const PoseStep& step) {
  return PoseJson(std::get<Operation>(step), State().posture).dump();
}

// What an option makes of "?": an operation, or a refusal.
std::string Outcome(const std::string& option) {
  try {
    return Written(ParsePoseStep(option, "?", State()));
  } catch (const InputError& error) {
    return error.what();
  }
}

// An operation as a user says it and as the page does.
struct Spelling {
  const char *option, *value, *json, *label;
};
const Spelling kSpellings[] = {
    {"drag", "a/left_hand=0.5,1,-2",
     R"({"op":"drag","figure":"a","node":"left_hand","target":[0.5,1,-2]})", "drag of a/left_hand"},
    {"drag-ray", "b/head=0,1,4,0,0,-1",
     R"({"op":"drag_ray","figure":"b","node":"head","origin":[0,1,4],"direction":[0,0,-1]})",
     "drag of b/head"},
    {"settle", "", R"({"op":"settle"})", "settle"},
    {"pin", "b/left_toe", R"({"op":"pin","figure":"b","node":"left_toe"})", "pin of b/left_toe"},
    {"pin-ray", "a/neck=0,1,4,0,0,-1",
     R"({"op":"pin","figure":"a","node":"neck","ray":{"origin":[0,1,4],"direction":[0,0,-1]}})",
     "pin of a/neck"},
    {"unpin", "b/left_foot", R"({"op":"unpin","figure":"b","node":"left_ankle"})",
     "unpin of b/left_ankle"},
    {"option", "feet=off", R"({"op":"set_option","option":"feet","on":false})", "option"},
    {"move", "b=1,2,3", R"({"op":"move_figure","figure":"b","shift":[1,2,3]})", "move of b"},
    {"turn", "a=180", R"({"op":"turn_figure","figure":"a","rotation":[0,1,0,0]})", "turn of a"},
    {"rotate", "a/left_elbow=180,0,0,world",
     R"({"op":"rotate_joint","figure":"a","joint":"left_elbow","rotation":[1,0,0,0],"world":true})",
     "turn of a/left_elbow"},
    {"set-joint", "a/left_elbow=0,-80,0",
     R"({"op":"set_joint","figure":"a","joint":"left_elbow","rotation_vector":[0,-80,0]})",
     "turn of a/left_elbow"},
    {"root", "a=0,0.95,0", R"({"op":"set_root","figure":"a","position":[0,0.95,0]})", "move of a"},
    {"root", "b=0,1,0,0,90,0",
     R"({"op":"set_root","figure":"b","position":[0,1,0],"rotation_vector":[0,90,0]})",
     "move of b"},
    {"stature", "b=1.75", R"({"op":"set_stature","figure":"b","stature":1.75})", "stature of b"},
    {"mirror", "both", R"({"op":"mirror","figure":"both"})", "mirror"},
    {"mirror", "b", R"({"op":"mirror","figure":"b"})", "mirror of b"},
    {"swap", "", R"({"op":"swap_figures"})", "exchange of a and b"},
    {"copy-side", "a=right", R"({"op":"copy_side","figure":"a","from":"right"})",
     "copy of a side of a"},
    {"reset", "a/neck", R"({"op":"reset_joint","figure":"a","joint":"neck"})", "reset of a/neck"},
    {"reset", "b", R"({"op":"reset_figure","figure":"b"})", "reset of b"},
    {"hold", "a/left_hand=world:0,1,0,rotation",
     R"({"op":"add_hold","from":{"figure":"a","node":"left_hand"},)"
     R"("to":{"figure":"world","offset":[0,1,0]},"rotation":true})",
     "new hold"},
    {"edit-hold", "2:a/left_hand=b/chest",
     R"({"op":"edit_hold","index":1,"from":{"figure":"a","node":"left_hand"},)"
     R"("to":{"figure":"b","node":"chest"}})",
     "change of a hold"},
    {"remove-hold", "1", R"({"op":"remove_hold","index":0})", "removal of a hold"},
    {"supports", "a=left_toe,right_foot",
     R"({"op":"set_supports","figure":"a","nodes":["left_toe","right_ankle"]})", "supports of a"},
    {"leader", "b=partner", R"({"op":"set_root_leader","figure":"b","leader":"partner"})",
     "leader of b"},
    {"tangles", "left_hand..right_hand:neck..head",
     R"({"op":"set_tangles","tangles":[{"a":["right_hand","left_hand"],"b":["head","neck"]}]})",
     "tangles"},
    {"name", "a name", R"({"op":"set_name","name":"a name"})", "name"},
    {"description", "what it is", R"({"op":"set_description","description":"what it is"})",
     "description"},
    {"tags", "one,two", R"({"op":"set_tags","tags":["one","two"]})", "tags"},
    {"photo", "p.jpg", R"({"op":"set_photo","photo":{"file":"p.jpg"}})", "photo"},
    {"photo", "none", R"({"op":"set_photo","photo":null})", "photo"},
    {"camera", "1,2,3,0,1,0,50",
     R"({"op":"set_camera","camera":{"eye":[1,2,3],"target":[0,1,0],"fov_deg":50}})", "camera"},
};

TEST(OperationTable, SaysTheSameOnTheCommandLineAndInJson) {
  std::set<size_t> seen;
  for (const Spelling& s : kSpellings) {
    const PoseStep step = ParsePoseStep(s.option, s.value, State());
    EXPECT_EQ(Written(step), Written(OfJson(s.json))) << s.option;
    EXPECT_EQ(Written(OfJson(Written(step))), Written(step)) << s.option;
    EXPECT_EQ(LabelOf(std::get<Operation>(step), State().posture), s.label);
    seen.insert(std::get<Operation>(step).index());
  }
  EXPECT_EQ(seen.size(), OperationTable().size() - 1);  // a posture cannot be asked for
  EXPECT_EQ(LabelOf(SetPosture{}, State().posture), "new posture");
  for (const char* name : {"undo", "redo"}) {
    const PoseStep step = ParsePoseStep(name, "", State());
    EXPECT_EQ(std::get<HistoryStep>(step),
              std::get<HistoryStep>(OfJson("{\"op\":\"" + std::string(name) + "\"}")));
  }
}

TEST(OperationTable, HasEachOperationAtItsPlaceUnderItsOwnNames) {
  std::set<std::string> names, options;
  for (size_t k = 0; k < OperationTable().size(); ++k) {
    const OperationRow& row = OperationTable()[k];
    EXPECT_EQ(row.index, k);
    EXPECT_FALSE(row.label.empty());
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    for (const OperationOption& option : row.options) {
      EXPECT_TRUE(options.insert(option.name).second) << option.name;
    }
  }
  EXPECT_EQ(PoseWords().size(), options.size() + HistoryTable().size());
}

TEST(OperationTable, TakesTheNamesOfBothPlaces) {
  EXPECT_EQ(Written(OfJson(R"({"op":"move","figure":"a","shift":[1,2,3]})")),
            Written(ParsePoseStep("move-figure", "a=1,2,3", State())));
  for (const PoseWord& word : PoseWords()) {
    if (word.alias.empty()) continue;
    EXPECT_EQ(Outcome(word.alias), Outcome(word.name)) << word.alias;
  }
}

TEST(OperationTable, FieldsOfOtherOperationsAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"op":"settle","figure":"a"})", "figure: unknown field"},
      {R"({"op":"undo","figure":"a"})", "figure: unknown field"},
      {R"({"op":""})", "op: unknown name \"\""},
      {R"({"op":"add_hld"})", "op: unknown name \"add_hld\", did you mean \"add_hold\"?"},
      {R"({"op":"set_camera","camera":{"eye":[0,0,0]}})", "camera.target is missing"},
      {R"({"op":"set_photo","photo":{"file":"x","offset":[1]}})",
       "photo.offset: expected 2 numbers"},
      {R"({"op":"pin","figure":"a","node":"head","ray":null})",
       "ray: expected an object {...}, found null"}};
  for (const auto& [json, expected] : cases) {
    try {
      OfJson(json);
      ADD_FAILURE() << json;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

TEST(OperationTable, MakesTheTypesOfThePage) {
  EXPECT_EQ(ReadWholeFile(ProjectPath("tools/web/src/studio/state/operations.ts")),
            OperationsTypeScript())
      << "cmake --build build/release --target operations_ts";
}

}  // namespace
}  // namespace retarget::posing
