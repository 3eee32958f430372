// Blender as an independent reader of what is written, where it is installed (Debian: blender,
// python3-numpy).
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/geometry/types.h"
#include "tests/test_data.h"

namespace retarget {

// World positions per joint and frame, in the file's unit, Y up.
using JointCurves = std::map<std::string, std::vector<Vec3>>;

// What Blender makes of a .glb, .gltf or .bvh file at `fps`, of the named animation where there are
// several; empty, with a failure, where it does not read it.
inline JointCurves BlenderJoints(const std::string& file, double fps,
                                 const std::string& animation = "") {
  const std::string stem =
      (std::filesystem::temp_directory_path() / ("blender-" + std::to_string(::getpid()))).string();
  const std::string command =
      "blender --background --factory-startup --python-exit-code 1 --python '" +
      ProjectPath("tests/blender/blender_joints.py") + "' -- '" + file + "' '" + stem +
      ".json' --fps " + std::to_string(fps) +
      (animation.empty() ? "" : " --animation '" + animation + "'") + " >'" + stem + ".log' 2>&1";
  const int status = std::system(command.c_str());
  const std::string log = ReadWholeFile(stem + ".log");
  const std::string json = ReadWholeFile(stem + ".json");
  std::filesystem::remove(stem + ".log");
  std::filesystem::remove(stem + ".json");
  JointCurves curves;
  if (status != 0) {
    ADD_FAILURE() << command << "\n" << log;
    return curves;
  }
  const nlohmann::json parsed = nlohmann::json::parse(json);
  for (const auto& [name, points] : parsed["joints"].items()) {
    for (const auto& p : points) curves[name].emplace_back(p[0], p[1], p[2]);
  }
  return curves;
}

}  // namespace retarget

// Skips (CTest counts it) where Blender is not installed.
#define SKIP_WITHOUT_BLENDER()                                             \
  if (std::system("command -v blender >/dev/null 2>&1") != 0) {            \
    GTEST_SKIP() << "no blender; see the head of tests/blender/blender.h"; \
  }
