// FormatTemplate of io/template_file.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "io/template_file.h"
#include "io/template_keys.h"
#include "io/text/yaml.h"
#include "model/geometry/so3.h"

namespace retarget::io {
namespace {

constexpr double kSameBody = 1e-9;  // m

// Shortest text of x rounded to `decimals`.
std::string Rounded(double x, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return fmt::format("{}", std::round(x * scale) / scale + 0.0);  // + 0.0 turns -0 into 0
}
std::string Number(double x) { return Rounded(x, 9); }
std::string Number(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", Number(v.x()), Number(v.y()), Number(v.z()));
}

// A rotation vector in degrees to 1e-6; empty for no rotation.
std::string RotationText(const Quat& rotation) {
  const Vec3 v = LogSo3(rotation) / kDegree;
  const std::string text =
      fmt::format("[{}, {}, {}]", Rounded(v.x(), 6), Rounded(v.y(), 6), Rounded(v.z(), 6));
  return text == "[0, 0, 0]" ? "" : text;
}

// "[x, y]".
std::string ListText(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string NodeList(const Body& body, const std::vector<int>& nodes) {
  std::vector<std::string> names;
  for (const int n : nodes) names.push_back(body.nodes[n].name);
  return ListText(names);
}

// The measures that StandardBody would make `body` from.
BodyMeasures MeasuresOf(const Body& body) {
  const auto centre = [&](const std::string& name) {
    return body.links[body.FindLink(name)].centre;
  };
  const auto node = [&](const std::string& name) { return body.nodes[body.FindNode(name)].offset; };
  BodyMeasures m;
  m.root_chest = centre("chest").norm();
  m.chest_neck = centre("neck").norm();
  m.neck_head = centre("head").norm();
  m.head_top = node("head_top").norm();
  for (const std::string name : {"left", "right"}) {
    BodyMeasures::Side& side = name == "left" ? m.left : m.right;
    side.clavicle = centre(name + "_clavicle");
    side.clavicle_shoulder = centre(name + "_shoulder").norm();
    side.shoulder_elbow = centre(name + "_elbow").norm();
    side.elbow_wrist = centre(name + "_wrist").norm();
    side.wrist_hand = node(name + "_hand").norm();
    side.hip = centre(name + "_hip");
    side.hip_knee = centre(name + "_knee").norm();
    side.knee_ankle = centre(name + "_ankle").norm();
    side.ankle_toe = node(name + "_toe").norm();
  }
  return m;
}

bool SameShape(const Body& x, const Body& y) {
  const auto near = [](const Vec3& u, const Vec3& v) {
    return (u - v).cwiseAbs().maxCoeff() <= kSameBody;
  };
  return std::equal(x.links.begin(), x.links.end(), y.links.begin(), y.links.end(),
                    [&](const Link& u, const Link& v) { return near(u.centre, v.centre); }) &&
         std::equal(x.nodes.begin(), x.nodes.end(), y.nodes.begin(), y.nodes.end(),
                    [&](const Node& u, const Node& v) { return near(u.offset, v.offset); });
}

std::string SideText(const BodyMeasures::Side& side) {
  std::vector<std::string> items;
  VisitSide(side, [&](const char* key, const auto& length) {
    items.push_back(fmt::format("{}: {}", key, Number(length)));
  });
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}

std::string LengthsText(const BodyMeasures& measures) {
  std::string out = "  lengths:\n";
  VisitTrunk(measures, [&](const char* key, const auto& length) {
    out += fmt::format("    {}: {}\n", key, Number(length));
  });
  out += "    left: " + SideText(measures.left) + "\n";
  return out + "    right: " + SideText(measures.right) + "\n";
}

// `stature` or `lengths`, then the radii that do not follow from them.
std::string BodyText(const Body& body) {
  Body standard = StandardBody(AverageMeasures(body.stature));
  assert(NodeNames(body) == NodeNames(standard) && LinkNames(body) == LinkNames(standard));
  std::string out;
  if (SameShape(body, standard)) {
    out = fmt::format("  stature: {}\n", Number(body.stature));
  } else {
    const BodyMeasures measures = MeasuresOf(body);
    standard = StandardBody(measures);
    out = LengthsText(measures);
  }
  std::vector<std::string> radii;
  for (int n = 1; n < body.num_nodes(); ++n) {
    const Node& node = body.nodes[n];
    if (std::abs(node.radius - standard.nodes[n].radius) <= kSameBody) continue;
    radii.push_back(fmt::format("{}: {}", node.name, Number(node.radius)));
  }
  if (!radii.empty()) out += fmt::format("  radii: {{{}}}\n", fmt::join(radii, ", "));
  return out;
}

std::string FigureText(const Body& body, const Pose& pose) {
  std::string out = BodyText(body);
  const std::string turn = RotationText(pose.rotation[0]);
  out += fmt::format("  root: {{position: {}, rotation: {}}}\n", Number(pose.root_position),
                     turn.empty() ? "[0, 0, 0]" : turn);
  std::string joints;
  for (int l = 1; l < body.num_links(); ++l) {
    const std::string rotation = RotationText(pose.rotation[l]);
    if (!rotation.empty()) joints += fmt::format("    {}: {}\n", body.links[l].name, rotation);
  }
  return joints.empty() ? out : out + "  joints:\n" + joints;
}

std::string HoldPointText(const HoldPoint& point, const std::array<Body, 2>& body) {
  if (point.figure == kWorld) {
    return fmt::format("{{figure: world, position: {}}}", Number(point.offset));
  }
  return fmt::format("{{figure: {}, node: {}, offset: {}}}", FigureNames()[point.figure],
                     body[point.figure].nodes[point.node].name, Number(point.offset));
}

std::string HoldsText(const TemplatePosture& posture) {
  if (posture.holds.empty()) return "";
  std::string out = "holds:\n";
  for (const Hold& hold : posture.holds) {
    out += fmt::format("  - from: {}\n    to: {}\n    rotation: {}\n",
                       HoldPointText(hold.from, posture.body), HoldPointText(hold.to, posture.body),
                       hold.rotation);
  }
  return out;
}

std::string TanglesText(const TemplatePosture& posture) {
  if (posture.tangles.empty()) return "";
  std::string out = "tangles:\n";
  for (const TangleRequest& tangle : posture.tangles) {
    out += fmt::format("  - {{a: {}, b: {}}}\n",
                       NodeList(posture.body[0], {tangle.a.from, tangle.a.to}),
                       NodeList(posture.body[1], {tangle.b.from, tangle.b.to}));
  }
  return out;
}

std::string ContactsText(const TemplatePosture& posture) {
  if (!posture.contacts) return "";
  if (posture.contacts->empty()) return "contacts: []\n";
  std::string out = "contacts:\n";
  const auto end = [&](int figure, int node, double along) {
    return fmt::format("{{figure: {}, node: {}, along: {}}}", FigureNames()[figure],
                       posture.body[figure].nodes[node].name, Number(along));
  };
  for (const HandContact& c : *posture.contacts) {
    out += fmt::format("  - from: {}\n    to: {}\n", end(c.figure, c.hand, c.along),
                       end(1 - c.figure, c.to, c.to_along));
  }
  return out;
}

std::string ViewText(const TemplatePosture& posture) {
  std::string out;
  if (const auto& photo = posture.photo) {
    out += fmt::format("photo: {{file: {}, opacity: {}, scale: {}, offset: [{}, {}]}}\n",
                       YamlText(photo->file), photo->opacity, photo->scale, photo->offset.x(),
                       photo->offset.y());
  }
  if (const auto& camera = posture.camera) {
    out += fmt::format("camera: {{eye: {}, target: {}, fov_deg: {}}}\n", Number(camera->eye),
                       Number(camera->target), camera->fov_deg);
  }
  return out;
}

std::string HeadText(const TemplatePosture& posture) {
  std::vector<std::string> tags;
  for (const std::string& tag : posture.keywords) tags.push_back(YamlText(tag));
  return fmt::format(
      "# Template posture. Lengths and positions in m, rotation vectors in degrees.\n"
      "format: {}\nname: {}\ndescription: {}\ntags: {}\n",
      kTemplateFormat, YamlText(posture.name), YamlText(posture.description), ListText(tags));
}

}  // namespace

std::string FormatTemplate(const TemplatePosture& posture) {
  const auto leader = [&](int f) {
    return posture.root[f] == RootReference::kPartner ? "partner" : "world";
  };
  std::string out = HeadText(posture);
  for (int f = 0; f < 2; ++f) {
    out += FigureNames()[f] + ":\n" + FigureText(posture.body[f], posture.pose[f]);
  }
  out += HoldsText(posture);
  out +=
      fmt::format("supports:\n  a: {}\n  b: {}\n", NodeList(posture.body[0], posture.supports[0]),
                  NodeList(posture.body[1], posture.supports[1]));
  out += fmt::format("root: {{a: {}, b: {}}}\n", leader(0), leader(1));
  return out + TanglesText(posture) + ContactsText(posture) + ViewText(posture);
}

}  // namespace retarget::io
