#include "model/body/body.h"

#include <array>
#include <cassert>
#include <cmath>

namespace retarget {
namespace {

// Segment radii (m) and mass shares for a stature of 1.756 m. Radii: circumferences of US Army men,
// mean of the two ends of a segment over 2 pi, trunk from half the chest and waist depth; rounded
// to 5 mm (Gordon et al., "2012 Anthropometric Survey of U.S. Army Personnel", 2014). Mass shares:
// Dempster 1955 as printed in Winter 2009, Table 4.1; the trunk is split as there between abdomen
// with pelvis and thorax, and the root-hip and neck-shoulder segments take a part of each.
struct SegmentTable {
  const char* node;
  double radius;
  double mass_share;
};
constexpr double kTableStature = 1.756;
constexpr SegmentTable kSegments[] = {
    {"chest", 0.120, 0.139},          {"neck", 0.130, 0.186},
    {"head", 0.055, 0.020},           {"head_top", 0.085, 0.061},
    {"left_shoulder", 0.055, 0.015},  {"left_elbow", 0.050, 0.028},
    {"left_wrist", 0.040, 0.016},     {"left_hand", 0.030, 0.006},
    {"right_shoulder", 0.055, 0.015}, {"right_elbow", 0.050, 0.028},
    {"right_wrist", 0.040, 0.016},    {"right_hand", 0.030, 0.006},
    {"left_hip", 0.100, 0.071},       {"left_knee", 0.080, 0.100},
    {"left_ankle", 0.050, 0.0465},    {"left_toe", 0.040, 0.0145},
    {"right_hip", 0.100, 0.071},      {"right_knee", 0.080, 0.100},
    {"right_ankle", 0.050, 0.0465},   {"right_toe", 0.040, 0.0145},
};
// Mass of a man of kTableStature at a body mass index of 23 kg/m^2.
constexpr double kTableMass = 23.0 * kTableStature * kTableStature;

struct BodyBuilder {
  Body body;

  int AddLink(const std::string& name, int parent, const Vec3& centre) {
    Link link;
    link.name = name;
    link.parent = parent;
    link.centre = centre;
    body.links.push_back(link);
    return body.num_links() - 1;
  }
  int AddNode(const std::string& name, int parent, int link, const Vec3& offset) {
    Node node;
    node.name = name;
    node.parent = parent;
    node.link = link;
    node.offset = offset;
    body.nodes.push_back(node);
    return body.num_nodes() - 1;
  }
};

// Links and nodes of one arm; `x` is +1 for the left side.
void AddArmLinks(const std::string& side, double x, const BodyMeasures::Side& m, int chest,
                 BodyBuilder* b) {
  const int clavicle = b->AddLink(side + "_clavicle", chest, m.clavicle);
  const int shoulder =
      b->AddLink(side + "_shoulder", clavicle, Vec3(x * m.clavicle_shoulder, 0, 0));
  const int elbow = b->AddLink(side + "_elbow", shoulder, Vec3(x * m.shoulder_elbow, 0, 0));
  b->AddLink(side + "_wrist", elbow, Vec3(x * m.elbow_wrist, 0, 0));
}

void AddLegLinks(const std::string& side, const BodyMeasures::Side& m, BodyBuilder* b) {
  const int hip = b->AddLink(side + "_hip", 0, m.hip);
  const int knee = b->AddLink(side + "_knee", hip, Vec3(0, -m.hip_knee, 0));
  b->AddLink(side + "_ankle", knee, Vec3(0, -m.knee_ankle, 0));
}

void AddArmNodes(const std::string& side, double x, const BodyMeasures::Side& m, int neck_node,
                 BodyBuilder* b) {
  const auto link = [&](const char* name) { return b->body.FindLink(side + name); };
  int n = b->AddNode(side + "_shoulder", neck_node, link("_clavicle"),
                     Vec3(x * m.clavicle_shoulder, 0, 0));
  n = b->AddNode(side + "_elbow", n, link("_shoulder"), Vec3(x * m.shoulder_elbow, 0, 0));
  n = b->AddNode(side + "_wrist", n, link("_elbow"), Vec3(x * m.elbow_wrist, 0, 0));
  b->AddNode(side + "_hand", n, link("_wrist"), Vec3(x * m.wrist_hand, 0, 0));
}

void AddLegNodes(const std::string& side, const BodyMeasures::Side& m, BodyBuilder* b) {
  const auto link = [&](const char* name) { return b->body.FindLink(side + name); };
  int n = b->AddNode(side + "_hip", 0, 0, m.hip);
  n = b->AddNode(side + "_knee", n, link("_hip"), Vec3(0, -m.hip_knee, 0));
  n = b->AddNode(side + "_ankle", n, link("_knee"), Vec3(0, -m.knee_ankle, 0));
  b->AddNode(side + "_toe", n, link("_ankle"), Vec3(0, 0, m.ankle_toe));
}

}  // namespace

int Body::FindLink(const std::string& name) const {
  for (int l = 0; l < num_links(); ++l) {
    if (links[l].name == name) return l;
  }
  return -1;
}

int Body::FindNode(const std::string& name) const {
  for (int n = 0; n < num_nodes(); ++n) {
    if (nodes[n].name == name) return n;
  }
  return -1;
}

double Body::SegmentLength(int node) const {
  const auto rest = [&](int n) {
    Vec3 p = nodes[n].offset;
    for (int l = nodes[n].link; l > 0; l = links[l].parent) p += links[l].centre;
    return p;
  };
  return (rest(node) - rest(nodes[node].parent)).norm();
}

Body ScaledTo(const Body& body, double stature) {
  Body out = body;
  const double k = stature / body.stature;
  out.stature = stature;
  for (Link& link : out.links) link.centre *= k;
  for (Node& node : out.nodes) {
    node.offset *= k;
    node.radius *= k;
    node.mass *= k * k * k;
  }
  return out;
}

BodyMeasures AverageMeasures(double stature) {
  const double h = stature;
  BodyMeasures m;
  m.root_chest = 0.125 * h;
  m.chest_neck = 0.145 * h;
  m.neck_head = 0.050 * h;
  m.head_top = 0.120 * h;
  for (const double x : {1.0, -1.0}) {
    BodyMeasures::Side& side = x > 0 ? m.left : m.right;
    side.clavicle = Vec3(0.012 * x, 0.130, 0) * h;
    side.clavicle_shoulder = 0.092 * h;
    side.shoulder_elbow = 0.186 * h;
    side.elbow_wrist = 0.146 * h;
    side.wrist_hand = kHandLength * h;
    side.hip = Vec3(0.0515 * x, -0.030, 0) * h;
    side.hip_knee = 0.245 * h;
    side.knee_ankle = 0.246 * h;
    side.ankle_toe = kFootLength * h;
  }
  return m;
}

double StatureOf(const BodyMeasures& m) {
  const double hips = 0.5 * (m.left.hip.y() + m.right.hip.y());
  const double legs =
      0.5 * (m.left.hip_knee + m.left.knee_ankle + m.right.hip_knee + m.right.knee_ankle);
  const double ankle_to_top = legs - hips + m.root_chest + m.chest_neck + m.neck_head + m.head_top;
  return ankle_to_top / (1 - kAnkleHeight);
}

Body StandardBody(const BodyMeasures& m) {
  BodyBuilder b;
  b.AddLink("root", -1, Vec3::Zero());
  const int waist = b.AddLink("waist", 0, Vec3::Zero());
  const int chest = b.AddLink("chest", waist, Vec3(0, m.root_chest, 0));
  const int neck = b.AddLink("neck", chest, Vec3(0, m.chest_neck, 0));
  const int head = b.AddLink("head", neck, Vec3(0, m.neck_head, 0));
  AddArmLinks("left", 1, m.left, chest, &b);
  AddArmLinks("right", -1, m.right, chest, &b);
  AddLegLinks("left", m.left, &b);
  AddLegLinks("right", m.right, &b);

  int n = b.AddNode("root", -1, 0, Vec3::Zero());
  n = b.AddNode("chest", n, waist, Vec3(0, m.root_chest, 0));
  const int neck_node = b.AddNode("neck", n, chest, Vec3(0, m.chest_neck, 0));
  n = b.AddNode("head", neck_node, neck, Vec3(0, m.neck_head, 0));
  b.AddNode("head_top", n, head, Vec3(0, m.head_top, 0));
  AddArmNodes("left", 1, m.left, neck_node, &b);
  AddArmNodes("right", -1, m.right, neck_node, &b);
  AddLegNodes("left", m.left, &b);
  AddLegNodes("right", m.right, &b);

  Body& body = b.body;
  body.stature = StatureOf(m);
  const double k = body.stature / kTableStature;
  for (const SegmentTable& row : kSegments) {
    Node& node = body.nodes[body.FindNode(row.node)];
    node.radius = row.radius * k;
    node.mass = row.mass_share * kTableMass * k * k * k;
  }
  for (int l = 1; l < body.num_links(); ++l)
    body.links[l].limit = StandardLimit(body.links[l].name);
  return body;
}

}  // namespace retarget
