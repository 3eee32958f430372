#include "tools/report/contact_sheet.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "io/render/render.h"
#include "io/scene/scene_glb.h"
#include "tools/report/measured_scene.h"
#include "tools/report/report.h"
#include "tools/report/subject_json.h"

namespace retarget::report {
namespace {

constexpr double kElevation = 0.2;  // rad
constexpr int kBand = 28;           // pixels over a picture, for its label

std::vector<io::RenderCapsule> CapsulesAt(const solver::PostureSample& sample,
                                          const solver::MetricsContext& subject) {
  std::vector<io::RenderCapsule> out;
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
    for (const io::RenderCapsule& c :
         io::FigureCapsules(body, posed, f == 0 ? io::kColourA : io::kColourB)) {
      out.push_back(c);
    }
  }
  return out;
}

// Where a's pelvis faces (rad about the vertical from +Z).
double FacingOfA(const solver::PostureSample& sample) {
  const Vec3 ahead = sample.rotation[0][0] * Vec3::UnitZ();
  return std::atan2(ahead.x(), ahead.z());
}

// A label above the capsules as seen from `azimuth` (rad).
io::Image LabelledPicture(const std::vector<io::RenderCapsule>& capsules, double azimuth,
                          const std::string& label, int width, int height) {
  const int picture = height - kBand;
  const io::RenderCamera camera =
      io::CameraAround(capsules, azimuth, kElevation, static_cast<double>(width) / picture);
  io::Image band = io::BlankImage(width, kBand, Vec3::Ones());
  io::DrawLabel(&band, 4, 6, label, 2);
  return io::TileImages({{band}, {io::RenderCapsules(capsules, camera, width, picture)}}, 0);
}

}  // namespace

io::Image TemplateSheet(const TemplatePosture& posture, int width, int height) {
  std::vector<io::RenderCapsule> capsules;
  for (int f = 0; f < 2; ++f) {
    const PosedBody posed = PoseBody(posture.body[f], posture.pose[f]);
    for (const io::RenderCapsule& c :
         io::FigureCapsules(posture.body[f], posed, f == 0 ? io::kColourA : io::kColourB)) {
      capsules.push_back(c);
    }
  }
  const Vec3 ahead = posture.pose[0].rotation[0] * Vec3::UnitZ();
  const double facing = std::atan2(ahead.x(), ahead.z());
  std::vector<io::Image> views;
  const std::pair<const char*, double> sides[] = {
      {"front of a", 15}, {"left", 105}, {"behind", 195}, {"right", 285}};
  for (const auto& [name, degrees] : sides) {
    views.push_back(LabelledPicture(capsules, facing + kDegree * degrees, name, width, height));
  }
  return io::TileImages({views});
}

io::Image SolvedPicture(const std::string& folder, const SheetInstant& instant,
                        const std::string& label, int width, int height) {
  const solver::MetricsContext subject =
      SubjectFromJson(ReadReport(folder), folder + "/report.json");
  const io::SceneMotion scene = io::ReadSceneGlb(folder + "/scene.glb");
  const solver::MotionView view = ViewOfScene(scene, subject.body);
  solver::PostureSample sample;
  view.at(std::lround(instant.share * (view.num_frames - 1)), &sample);
  return LabelledPicture(CapsulesAt(sample, subject),
                         FacingOfA(sample) + kDegree * instant.azimuth_deg, label, width, height);
}

io::Image ContactSheet(const std::string& folder, const std::vector<SheetInstant>& instants,
                       bool baseline, int width, int height) {
  const Json report = ReadReport(folder);
  const solver::MetricsContext subject = SubjectFromJson(report, folder + "/report.json");
  std::vector<std::pair<const char*, io::SceneMotion>> motions;
  motions.emplace_back("source", io::ReadSceneGlb(folder + "/source.glb"));
  if (baseline && std::filesystem::exists(folder + "/baseline.glb")) {
    motions.emplace_back("simulated", io::ReadSceneGlb(folder + "/baseline.glb"));
  }
  motions.emplace_back("solved", io::ReadSceneGlb(folder + "/scene.glb"));
  std::vector<std::vector<io::Image>> rows(motions.size());
  const solver::MotionView solved = ViewOfScene(motions.back().second, subject.body);
  for (const SheetInstant& instant : instants) {
    const int frame = static_cast<int>(std::lround(instant.share * (solved.num_frames - 1)));
    solver::PostureSample sample;
    solved.at(frame, &sample);
    const double azimuth = FacingOfA(sample) + kDegree * instant.azimuth_deg;
    for (size_t m = 0; m < motions.size(); ++m) {
      const solver::MotionView view = ViewOfScene(motions[m].second, subject.body);
      view.at(frame, &sample);
      const std::vector<io::RenderCapsule> capsules = CapsulesAt(sample, subject);
      rows[m].push_back(LabelledPicture(
          capsules, azimuth, fmt::format("{} {:.1f} s", motions[m].first, frame / view.fps), width,
          height));
    }
  }
  return io::TileImages(rows);
}

}  // namespace retarget::report
