// Any bytes as a message of the studio's page: refused with one line, or operations whose posture,
// after all that need no solver were done, can be saved and read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/template_file.h"
#include "io/text/message.h"
#include "tools/posing/edit.h"
#include "tools/posing/json.h"
#include "tools/studio/image.h"

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

bool NeedsSolver(const Operation& operation) {
  return std::holds_alternative<Drag>(operation) || std::holds_alternative<DragRay>(operation) ||
         std::holds_alternative<Settle>(operation);
}

// The state after a message's operations; throws InputError.
PoseState Done(const std::string& text, PoseState state) {
  const Message message = ParseMessage(text);
  const Fields fields(message, "");
  fields.Only({"session", "ops", "live", "thumbnail"});
  fields.Bool("live", false);
  if (fields.Has("thumbnail")) FromBase64(fields.Text("thumbnail", 1000));
  for (const Fields& op : fields.ObjectList("ops", 64)) {
    const PoseStep step = ParsePoseJson(op, state.posture);
    const Operation* operation = std::get_if<Operation>(&step);
    if (operation && !NeedsSolver(*operation)) state = Edited(state, *operation);
  }
  return state;
}

void Try(const std::string& text) {
  PoseState state;
  static const TemplatePosture start = ParseTemplate(kStart, "start");
  state.posture = start;
  try {
    state = Done(text, state);
  } catch (const InputError& error) {
    ExpectOneLine(error);
    return;
  }
  std::string saved;
  try {
    saved = FormatTemplate(state.posture);
    ParseTemplate(saved, "saved");
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
