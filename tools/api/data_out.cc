#include "tools/api/data_out.h"

#include <fmt/format.h>

#include "io/data/npy.h"
#include "io/data/stored_zip.h"
#include "model/geometry/so3.h"
#include "tools/report/report.h"

namespace retarget::api {
namespace {

using Shape = std::vector<size_t>;

class Archive {
 public:
  template <typename Values>
  void Add(const std::string& name, const Values& values, const Shape& shape) {
    files_.push_back({name + ".npy", io::FormatNpy(values, shape)});
  }
  void Add(const std::string& name, const std::vector<std::string>& texts) {
    files_.push_back({name + ".npy", io::FormatNpy(texts)});
  }
  std::string Format() const { return io::FormatStoredZip(files_); }

 private:
  std::vector<std::pair<std::string, std::string>> files_;
};

void Append(const Vec3& v, std::vector<double>* out) {
  out->insert(out->end(), v.data(), v.data() + 3);
}

void AddBody(const Body& body, const std::string& prefix, Archive* archive) {
  std::vector<int32_t> node_parents, node_links, link_parents;
  std::vector<double> radii;
  for (const Node& node : body.nodes) {
    node_parents.push_back(node.parent);
    node_links.push_back(node.link);
    radii.push_back(node.radius);
  }
  for (const Link& link : body.links) link_parents.push_back(link.parent);
  archive->Add(prefix + "stature", std::vector<double>{body.stature}, {});
  archive->Add(prefix + "node_parents", node_parents, {node_parents.size()});
  archive->Add(prefix + "node_links", node_links, {node_links.size()});
  archive->Add(prefix + "link_parents", link_parents, {link_parents.size()});
  archive->Add(prefix + "radii", radii, {radii.size()});
}

void AddMotion(const Body& body, const Clip& clip, const std::vector<Contact>& contacts,
               const std::string& prefix, Archive* archive) {
  const size_t frames = clip.frames.size(), nodes = body.nodes.size(), links = body.links.size();
  std::vector<double> positions, quaternions, six, poses, roots;
  std::vector<bool> planted(frames * nodes, false);
  for (const Pose& pose : clip.frames) {
    for (const Vec3& node : PoseBody(body, pose).node) Append(node, &positions);
    for (const Quat& q : pose.rotation) {
      const Mat3 matrix = q.toRotationMatrix();
      for (const double x : {q.x(), q.y(), q.z(), q.w()}) quaternions.push_back(x);
      Append(matrix.col(0), &six);
      Append(matrix.col(1), &six);
      Append(LogSo3(q), &poses);
    }
    Append(pose.root_position, &roots);
  }
  for (const Contact& contact : contacts) {
    for (int t = contact.first; t <= contact.last; ++t) {
      planted[static_cast<size_t>(t) * nodes + static_cast<size_t>(contact.node)] = true;
    }
  }
  archive->Add(prefix + "positions", positions, {frames, nodes, 3});
  archive->Add(prefix + "rotations", quaternions, {frames, links, 4});
  archive->Add(prefix + "rotations_6d", six, {frames, links, 6});
  archive->Add(prefix + "poses", poses, {frames, 3 * links});
  archive->Add(prefix + "trans", roots, {frames, 3});
  archive->Add(prefix + "contacts", planted, {frames, nodes});
}

// [frames, tags]
std::vector<double> GliOf(const solver::FrameMetrics& series) {
  std::vector<double> gli;
  for (const solver::InstantMetrics& at : series.at) {
    gli.insert(gli.end(), at.gli.begin(), at.gli.end());
  }
  return gli;
}

}  // namespace

std::string FormatSceneNpz(const solver::RetargetResult& result,
                           const solver::FrameMetrics& series) {
  const solver::Scene& scene = result.scene;
  Archive archive;
  const double fps = scene.fps();
  archive.Add("mocap_framerate", std::vector<double>{fps}, {});
  std::vector<std::string> nodes, links, tags;
  std::vector<double> signs;
  for (const Node& node : scene.body[0].nodes) nodes.push_back(node.name);
  for (const Link& link : scene.body[0].links) links.push_back(link.name);
  for (const solver::TangleTarget& target : scene.tangles) {
    tags.push_back(TangleText(scene.body[0], scene.body[1], target.tag.tangle));
    signs.push_back(target.sign);
  }
  archive.Add("nodes", nodes);
  archive.Add("links", links);
  archive.Add("tags", tags);
  archive.Add("tag_signs", signs, {signs.size()});
  archive.Add("tag_gli", GliOf(series), {series.at.size(), tags.size()});
  for (int f = 0; f < 2; ++f) {
    const std::string prefix = std::string(report::kFigure[f]) + "_";
    AddBody(scene.body[f], prefix, &archive);
    AddMotion(scene.body[f], result.solved[f], scene.contacts[f], prefix, &archive);
  }
  return archive.Format();
}

std::string FormatSceneCsv(const solver::RetargetResult& result,
                           const solver::FrameMetrics& series) {
  const solver::Scene& scene = result.scene;
  std::string csv = "frame,time_s";
  for (int f = 0; f < 2; ++f) {
    for (const Node& node : scene.body[f].nodes) {
      for (const char* axis : {"x", "y", "z"}) {
        csv += fmt::format(",{}/{}.{}", report::kFigure[f], node.name, axis);
      }
    }
  }
  for (size_t k = 0; k < scene.tangles.size(); ++k) csv += fmt::format(",tag_{}", k + 1);
  csv += "\n";
  for (int t = 0; t < scene.num_frames(); ++t) {
    const auto frame = static_cast<size_t>(t);
    csv += fmt::format("{},{}", t, t / scene.fps());
    for (int f = 0; f < 2; ++f) {
      for (const Vec3& p : PoseBody(scene.body[f], result.solved[f].frames[frame]).node) {
        csv += fmt::format(",{},{},{}", p.x(), p.y(), p.z());
      }
    }
    for (const double gli : series.at[frame].gli) csv += fmt::format(",{}", gli);
    csv += "\n";
  }
  return csv;
}

}  // namespace retarget::api
