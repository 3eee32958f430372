// Two runs at once in one process, in memory: embed_twice FOLDER. Exit code 0 where both are equal
// to the last byte, one of them cancelled where it is asked to be, and nothing was printed by the
// library (the caller looks at that).
#include <retarget/retarget.h>

#include <fstream>
#include <iterator>
#include <thread>

namespace {

std::string Read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

retarget::Request RequestOf(const std::string& folder) {
  retarget::Request request;
  for (int figure = 0; figure < 2; ++figure) {
    request.clip[figure].path = figure == 0 ? "a.bvh" : "b.bvh";
    request.clip[figure].bytes = Read(folder + "/" + request.clip[figure].path);
  }
  request.template_path = "template.yaml";
  request.template_text = Read(folder + "/template.yaml");
  request.frames = {0, 40};
  request.settings.solve.threads = 1;
  request.page = false;
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const retarget::Request request = RequestOf(argv[1]);
  retarget::Result result[2], cancelled;
  std::thread first([&] { result[0] = retarget::Run(request); });
  std::thread third([&] { cancelled = retarget::Run(request, [](const auto&) { return false; }); });
  result[1] = retarget::Run(request);
  first.join();
  third.join();
  for (const char* name : {"scene.glb", "source.glb", "baseline.glb", "a.bvh", "b.bvh"}) {
    if (result[0].File(name).empty() || result[0].File(name) != result[1].File(name)) return 1;
  }
  if (result[0].status != retarget::Status::kSolved) return 3;
  if (cancelled.status != retarget::Status::kInterrupted || cancelled.File("scene.glb").empty()) {
    return 4;
  }
  retarget::Request bad = request;
  bad.template_text = "version: 1\nfigures: none\n";
  try {
    retarget::Run(bad);
    return 5;
  } catch (const retarget::InputError&) {
    return 0;
  }
}
