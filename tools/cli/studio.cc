// `retarget studio`: the posing page, served on this machine.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "io/files.h"
#include "io/template_file.h"
#include "io/text/read_file.h"
#include "tools/cli/commands.h"
#include "tools/report/embedded_page.h"
#include "tools/studio/child_process.h"
#include "tools/studio/image.h"
#include "tools/studio/jobs.h"
#include "tools/studio/server.h"

namespace retarget::cli {
namespace {

studio::StudioStart StartOf(const StudioOptions& options, studio::StudioLibrary* library) {
  studio::StudioStart start;
  start.settings = SettingsOf(options.settings);
  start.has_template = !options.template_path.empty();
  start.posture = start.has_template ? studio::PostureOfLibrary(library, library->named_id())
                                     : studio::UnsavedPosture(posing::RestPosture(1.75, 1.75, 1));
  if (options.photo_path.empty()) return start;
  start.posture.photo = io::ReadFile(options.photo_path);
  const auto kind = studio::ImageKindOf(start.posture.photo);
  if (!kind || start.posture.photo.size() > studio::kMostBytes) {
    throw InputError(options.photo_path + ": expected a PNG, JPEG or WebP picture under 16 MB");
  }
  TemplatePhoto photo;
  photo.file = std::string("photo.") + kind->extension;
  start.posture.posture.photo = photo;
  return start;
}

std::string Page() {
  const std::string_view page = report::EmbeddedStudioPage();
  if (!page.empty()) return std::string(page);
  return "<!doctype html><title>retarget studio</title>"
         "<p>This program was built without the studio's page (RETARGET_STUDIO=OFF).\n";
}

}  // namespace

int RunStudio(const StudioOptions& options) {
  // Before any thread is started: all of them leave the signals to this one.
  sigset_t ends;
  sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, signal);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  std::signal(SIGPIPE, SIG_IGN);

  studio::StudioLibrary library(options.library, options.template_path);
  studio::StudioClips clips(options.clip, library.ClipFolders());
  studio::StudioJobs jobs;
  studio::StudioRoutes routes(StartOf(options, &library), &library, &clips, &jobs);
  studio::StudioServer server(&routes, Page());
  server.Bind(options.port);
  std::thread serving([&] { server.Run(); });
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  if (options.browser && !studio::Launch({"xdg-open", server.url()})) {
    fmt::print(stderr, "open this address in a browser\n");
  }
  int signal = 0;
  sigwait(&ends, &signal);
  server.Stop();
  jobs.Close();
  library.Close();  // what is being written is written
  // Connections that browsers keep open are not waited for.
  std::fflush(stdout);
  std::_Exit(kDone);
}

}  // namespace retarget::cli
