#include "solver/simulation/mjcf.h"

#include <algorithm>
#include <cstdio>

namespace retarget::solver {
namespace {

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string Numbers(const Vec3& v) {
  return Number(v.x()) + " " + Number(v.y()) + " " + Number(v.z());
}

std::string Attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

// Where a node is in the frame of `link` when the body is at rest.
Vec3 AtRest(const Body& body, int node, int link) {
  const auto origin = [&](int l) {
    Vec3 p = Vec3::Zero();
    for (; l > 0; l = body.links[l].parent) p += body.links[l].centre;
    return p;
  };
  return origin(body.nodes[node].link) + body.nodes[node].offset - origin(link);
}

std::string Capsule(const PhysicsFigure& figure, int index, int node,
                    const PhysicsOptions& options) {
  const Node& n = figure.body.nodes[node];
  const Vec3 from = AtRest(figure.body, n.parent, n.link);
  const bool point = (n.offset - from).norm() < 1e-6;  // MuJoCo refuses a capsule without length
  std::string out = "<geom" + Attribute("name", SegmentName(index, node));
  out += point ? Attribute("type", "sphere") + Attribute("pos", Numbers(n.offset))
               : Attribute("type", "capsule") +
                     Attribute("fromto", Numbers(from) + " " + Numbers(n.offset));
  out += Attribute("size", Number(std::max(n.radius, 1e-3))) + Attribute("mass", Number(n.mass));
  const int own = 1 << index, other = 1 << (1 - index);
  out += Attribute("contype", std::to_string(options.collide ? own : 0));
  out += Attribute("conaffinity", std::to_string((options.collide ? other : 0) | kFloorBit));
  return out + "/>\n";
}

std::string LinkTree(const PhysicsFigure& figure, int index, int link,
                     const PhysicsOptions& options) {
  const Body& body = figure.body;
  const std::string name = Attribute("name", LinkName(index, link));
  std::string out = "<body" + name + Attribute("pos", Numbers(body.links[link].centre)) + ">\n";
  out += link == 0
             ? "<freejoint" + name + "/>\n"
             : "<joint type=\"ball\"" + name + Attribute("damping", Number(figure.damping[link])) +
                   Attribute("armature", Number(options.armature)) + "/>\n";
  for (int n = 1; n < body.num_nodes(); ++n) {
    if (body.nodes[n].link == link) out += Capsule(figure, index, n, options);
  }
  for (int l = link + 1; l < body.num_links(); ++l) {
    if (body.links[l].parent == link) out += LinkTree(figure, index, l, options);
  }
  return out + "</body>\n";
}

std::string TieElement(const EqualityConstraint& tie, int index, const PhysicsOptions& options) {
  std::string out = tie.rotation ? "<weld" : "<connect";
  out += Attribute("name", TieName(index)) + Attribute("active", "false");
  out += Attribute("body1", LinkName(tie.figure, tie.link));
  if (tie.to_figure >= 0) out += Attribute("body2", LinkName(tie.to_figure, tie.to_link));
  out += tie.rotation ? "" : Attribute("anchor", "0 0 0");
  return out + Attribute("solref", Number(options.tie_time) + " 1") + "/>\n";
}

}  // namespace

std::string LinkName(int figure, int link) {
  return std::to_string(figure) + "/" + std::to_string(link);
}

std::string SegmentName(int figure, int node) {
  return std::to_string(figure) + "/" + std::to_string(node);
}

std::string TieName(int tie) { return "tie" + std::to_string(tie); }

std::string FormatMjcf(const std::vector<PhysicsFigure>& figures,
                       const std::vector<EqualityConstraint>& ties, const PhysicsOptions& options) {
  std::string out =
      "<mujoco>\n<compiler angle=\"radian\" boundmass=\"1e-3\" boundinertia=\"1e-6\"/>";
  out += "\n<option integrator=\"Euler\"" + Attribute("timestep", Number(options.time_step)) +
         Attribute("gravity", Numbers(Vec3(0, -options.gravity, 0))) +
         ">\n<flag energy=\"enable\"/>\n</option>\n";
  out += "<size njmax=\"4000\" nconmax=\"800\"/>\n<default><geom" +
         Attribute("friction", Number(options.friction) + " 0.005 0.0001") +
         Attribute("solref", Number(options.contact_time) + " 1") + "/></default>\n<worldbody>\n";
  if (options.floor) {
    // A plane's normal is its z axis: turned upwards, to y.
    out +=
        "<geom name=\"floor\" type=\"plane\" size=\"50 50 1\" quat=\"0.70710678118654757 "
        "-0.70710678118654757 0 0\"" +
        Attribute("contype", std::to_string(kFloorBit)) + " conaffinity=\"0\"/>\n";
  }
  for (size_t f = 0; f < figures.size(); ++f) {
    out += LinkTree(figures[f], static_cast<int>(f), 0, options);
  }
  out += "</worldbody>\n<equality>\n";
  for (size_t k = 0; k < ties.size(); ++k) {
    out += TieElement(ties[k], static_cast<int>(k), options);
  }
  return out + "</equality>\n</mujoco>\n";
}

}  // namespace retarget::solver
