// Feeds damaged copies of BVH files to the reader and the recogniser, meant for a build with
// sanitizers. Usage: bvh_fuzz [copies, 10000] [file.bvh ...]; without files, the shared clips.
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/io/bvh/bvh_damage.h"

namespace retarget::io {
namespace {

std::vector<std::string> SeedFiles(int argc, char** argv) {
  std::vector<std::string> paths(argv + std::min(argc, 2), argv + argc);
  for (const char* folder : {"/data/clips", "/data/odd_bvh"}) {
    const std::string path = std::string(RETARGET_SHARED_DIR) + folder;
    if (argc > 2 || !std::filesystem::exists(path)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      if (entry.path().extension() == ".bvh") paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

int Run(int argc, char** argv) {
  const int copies = argc > 1 ? std::atoi(argv[1]) : 10000;
  constexpr int kFrames = 50;
  std::vector<std::string> texts;
  for (const std::string& path : SeedFiles(argc, argv)) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    texts.push_back(CutToFrames(text.str(), kFrames));
  }
  if (texts.empty()) {
    std::cerr << "no BVH files to damage\n";
    return 1;
  }
  int accepted = 0;
  double slowest = 0;
  for (int copy = 0; copy < copies; ++copy) {
    const std::string damaged = Damager(static_cast<uint64_t>(copy))
                                    .Damage(texts[static_cast<size_t>(copy) % texts.size()]);
    const auto begin = std::chrono::steady_clock::now();
    try {
      accepted += ReadsOrRefuses(damaged) ? 1 : 0;
    } catch (const std::exception& error) {
      std::cerr << "copy " << copy << ": " << error.what() << "\n";
      std::ofstream("bvh_fuzz_failure.bvh", std::ios::binary) << damaged;
      return 1;
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    slowest = std::max(slowest, spent.count());
  }
  std::cout << copies << " damaged copies of " << texts.size() << " files: " << accepted
            << " accepted, " << copies - accepted << " refused, slowest " << slowest << " s\n";
  return 0;
}

}  // namespace
}  // namespace retarget::io

int main(int argc, char** argv) { return retarget::Run(argc, argv); }
