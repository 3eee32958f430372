// Unit and up axis; ParseUnits of io/recognition/recognise.h.
#include "io/recognition/rig_units.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace retarget::io {
namespace {

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {
    {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"cmu", 0.0254 / 0.45}};

// Statures (m): of any human, and of most adults.
constexpr double kSmallest = 0.9, kTallest = 2.3, kUsual = 1.70;
constexpr double kUsualSmallest = 1.4, kUsualTallest = 2.1;

std::string UnitName(double metres) {
  for (const Unit& unit : kUnits) {
    if (std::abs(metres - unit.metres) <= 1e-6 * unit.metres) return unit.name;
  }
  return fmt::format("{:g}", metres);
}

// The listed unit that makes `height` (file units) the most usual stature.
double GuessUnit(double height, const OptionWords& words, const std::string& file) {
  const Unit* best = nullptr;
  double least = 0;
  for (const Unit& unit : kUnits) {
    const double stature = height * unit.metres;
    if (stature < kSmallest || stature > kTallest) continue;
    const double distance = std::abs(std::log(stature / kUsual));
    if (best == nullptr || distance < least) {
      best = &unit;
      least = distance;
    }
  }
  if (best == nullptr) {
    throw InputError(
        fmt::format("{}: the figure is {:.4g} units tall, no human height in m, cm, "
                    "mm, in or cmu; give its unit with {}",
                    file, height, words.units));
  }
  return best->metres;
}

// The rig as its offsets draw it: nothing turned.
RigFrame ZeroFrame(const Rig& rig) {
  RigFrame frame;
  for (const RigJoint& joint : rig.joints) {
    frame.translation.push_back(joint.offset);
    frame.rotation.push_back(Quat::Identity());
  }
  return frame;
}

}  // namespace

void FindUnit(double height, const RecogniseOptions& options, const std::string& file,
              RigFacts* facts) {
  if (!std::isfinite(height) || height <= 0) {
    throw InputError(file + ": no human figure: the joints lie in one point");
  }
  if (options.metres_per_unit) {
    facts->metres_per_unit = *options.metres_per_unit;
    if (!std::isfinite(facts->metres_per_unit) || facts->metres_per_unit <= 0) {
      throw InputError(file + ": units must be a positive number of metres");
    }
  } else {
    facts->metres_per_unit = GuessUnit(height, options.words, file);
  }
  facts->unit_name = UnitName(facts->metres_per_unit);
  facts->stature = height * facts->metres_per_unit;
  if (facts->stature < kUsualSmallest || facts->stature > kUsualTallest) {
    facts->notes.push_back(fmt::format("a stature of {:.2f} m is unusual", facts->stature) +
                           (options.metres_per_unit ? ""
                                                    : ": if the unit is not " + facts->unit_name +
                                                          ", give it with " + options.words.units));
  }
}

void FindUp(const RigMeasure& figure, const RecogniseOptions& options, const std::string& file,
            RigFacts* facts) {
  if (options.up && *options.up != 'y' && *options.up != 'z') {
    throw InputError(file + ": the up axis must be y or z");
  }
  constexpr double kStands = 0.7;  // cosine
  const auto stature = [&](const PosedRig& pose) -> Vec3 {
    return At(pose, figure.points.neck) - MidAnkle(pose, figure.points);
  };
  const auto along = [](const Vec3& v, char up) { return up == 'y' ? v.y() : v.z(); };
  Vec3 mean = Vec3::Zero();
  for (const PosedRig& pose : figure.poses) mean += stature(pose);
  facts->up = mean.y() >= mean.z() ? 'y' : 'z';
  if (along(mean, facts->up) < kStands * mean.norm()) {  // who lies tells by how he is drawn
    const Vec3 drawn = stature(PoseRig(*figure.rig, ZeroFrame(*figure.rig)));
    for (const char up : {'y', 'z'}) {
      if (along(drawn, up) > kStands * drawn.norm()) facts->up = up;
    }
  }
  facts->up = options.up.value_or(facts->up);
  if (along(mean, facts->up) < kStands * mean.norm()) {
    facts->notes.push_back(
        fmt::format("the figure seldom stands along +{}: if that is not up, give the axis with {}",
                    facts->up, options.words.up));
  }
}

Vec3 UpAxis(const RigFacts& facts) { return facts.up == 'y' ? Vec3::UnitY() : Vec3::UnitZ(); }

std::optional<double> ParseUnits(const std::string& text) {
  for (const Unit& unit : kUnits) {
    if (text == unit.name) return unit.metres;
  }
  double metres = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, metres);
  if (error != std::errc() || stop != end || !std::isfinite(metres) || metres <= 0) {
    return std::nullopt;
  }
  return metres;
}

}  // namespace retarget::io
