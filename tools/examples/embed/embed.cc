// Two clips and a template into one solved scene, in memory: embed A.bvh B.bvh TEMPLATE.yaml
#include <retarget/retarget.h>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace {

std::string Read(const char* path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: embed A.bvh B.bvh TEMPLATE.yaml\n"), 2;
  retarget::Request request;
  for (int figure = 0; figure < 2; ++figure) {
    request.clip[figure].path = argv[1 + figure];  // what messages call it
    request.clip[figure].bytes = Read(argv[1 + figure]);
  }
  request.template_path = argv[3];
  request.template_text = Read(argv[3]);
  request.frames = {0, 90};
  request.settings.weights.tangle = 30;
  request.page = false;

  try {
    const retarget::Result result = retarget::Run(request, [](const auto& iteration) {
      std::printf("iteration %d: cost %.3f\n", iteration.index, iteration.cost);
      return true;  // false: stop here
    });
    std::printf("smallest s GLI %.3f, deepest penetration %.2f cm, scene.glb %zu bytes\n",
                result.metrics.smallest_gli, 100 * result.metrics.penetration_m,
                result.File("scene.glb").size());
    for (const auto& check : result.requirements) {
      if (!check.met) std::printf("missed: %s\n", retarget::RequirementName(check).c_str());
    }
    return retarget::ExitCodeOf(result.status);
  } catch (const retarget::InputError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
