// Any bytes as a message of the studio's page: refused with one line, or operations whose posture,
// after all that need no solver were done, can be saved and read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/template_file.h"
#include "io/text/base64.h"
#include "io/text/json.h"
#include "tools/posing/edit.h"
#include "tools/posing/json.h"

namespace retarget {
namespace {

constexpr const char* kStart =
    "format: 1\nname: x\na: {stature: 1.8, root: {position: [0, 0.95, -0.3], rotation: [0, 0, "
    "0]}}\n"
    "b: {stature: 1.7, root: {position: [0, 0.95, 0], rotation: [0, 10, 0]}, joints: {waist: [5, "
    "0, "
    "0]}}\nholds:\n  - {from: {figure: a, node: left_hand}, to: {figure: b, node: chest}}\n";

void Expect(bool good) {
  if (!good) std::abort();
}

void ExpectOneLine(const InputError& error) {
  const std::string line = error.what();
  Expect(!line.empty() && line.size() < 1000 && line.find('\n') == std::string::npos);
}

bool NeedsSolver(const posing::Operation& operation) {
  return std::holds_alternative<posing::Drag>(operation) ||
         std::holds_alternative<posing::DragRay>(operation) ||
         std::holds_alternative<posing::Settle>(operation);
}

// The state after a message's operations; throws InputError.
posing::PoseState Done(const std::string& text, posing::PoseState state) {
  const io::Document message = io::ParseJson(text);
  const io::Value fields = message.root();
  fields.CheckKeys({"session", "ops", "live", "thumbnail"});
  fields.Flag("live");
  if (fields.Has("thumbnail")) io::DecodeBase64(fields.Require("thumbnail").Text(1000));
  for (const io::Value& op : fields.Require("ops").List(64)) {
    const posing::PoseStep step = posing::ParsePoseJson(op, state.posture);
    const posing::Operation* operation = std::get_if<posing::Operation>(&step);
    if (operation && !NeedsSolver(*operation)) state = posing::Edited(state, *operation);
  }
  return state;
}

void Try(const std::string& text) {
  posing::PoseState state;
  static const TemplatePosture start = io::ParseTemplate(kStart, "start");
  state.posture = start;
  try {
    state = Done(text, state);
  } catch (const InputError& error) {
    ExpectOneLine(error);
    return;
  }
  std::string saved;
  try {
    saved = io::FormatTemplate(state.posture);
    io::ParseTemplate(saved, "saved");
  } catch (const InputError& error) {  // what was accepted can be saved
    fprintf(stderr, "%s\n%s\n", error.what(), saved.c_str());
    std::abort();
  }
}

}  // namespace
}  // namespace retarget

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  retarget::Try(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
