// `retarget render DIR`: a contact sheet of a run, source above result.
#include <fmt/format.h>

#include "io/image.h"
#include "io/render.h"
#include "io/scene_glb.h"
#include "tools/commands.h"
#include "tools/files.h"
#include "tools/report.h"

namespace retarget {
namespace {

constexpr int kColumns = 4, kWidth = 360, kHeight = 450;
constexpr double kAzimuth = 0.9, kElevation = 0.2;  // rad

std::vector<RenderCapsule> CapsulesAt(const MotionView& view, const MeasureSubject& subject,
                                      double frame) {
  PostureSample sample;
  view.at(frame, &sample);
  std::vector<RenderCapsule> out;
  for (int f = 0; f < 2; ++f) {
    const Body& body = subject.body[f];
    PosedBody posed;
    posed.node = sample.node[f];
    posed.rotation.resize(body.links.size());
    posed.centre.resize(body.links.size());
    for (int n = 0; n < body.num_nodes(); ++n) {
      posed.rotation[body.nodes[n].link] = sample.rotation[f][n].toRotationMatrix();
      const int parent = body.nodes[n].parent;
      posed.centre[body.nodes[n].link] = parent < 0 ? posed.node[n] : posed.node[parent];
    }
    for (const RenderCapsule& c : FigureCapsules(body, posed, f == 0 ? kColourA : kColourB)) {
      out.push_back(c);
    }
  }
  return out;
}

}  // namespace

int RunRender(const std::string& folder, const std::string& out, bool force) {
  const std::string report_path = folder + "/report.json";
  const Json report = ReadReport(folder);
  const MeasureSubject subject = SubjectFromJson(report, report_path);
  const SceneMotion source = ReadSceneGlb(folder + "/source.glb");
  const SceneMotion scene = ReadSceneGlb(folder + "/scene.glb");
  std::vector<std::vector<Image>> rows;
  for (const SceneMotion* motion : {&source, &scene}) {
    const MotionView view = ViewOfScene(*motion, subject.body);
    rows.emplace_back();
    for (int k = 0; k < kColumns; ++k) {
      const int frame = (2 * k + 1) * (view.num_frames - 1) / (2 * kColumns);
      const std::vector<RenderCapsule> capsules = CapsulesAt(view, subject, frame);
      const double aspect = static_cast<double>(kWidth) / kHeight;
      Image image = RenderCapsules(capsules, CameraAround(capsules, kAzimuth, kElevation, aspect),
                                   kWidth, kHeight);
      DrawLabel(
          &image, 10, 10,
          fmt::format("{} {:.1f} s", motion == &source ? "source" : "solved", frame / view.fps), 2);
      rows.back().push_back(std::move(image));
    }
  }
  WriteFile(out, EncodePng(TileImages(rows)), force);
  fmt::print("written to {}\n", out);
  return kDone;
}

}  // namespace retarget
