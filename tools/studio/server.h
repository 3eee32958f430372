// The studio over HTTP, on this machine alone.
#pragma once

#include <memory>
#include <string>

#include "tools/studio/guard.h"
#include "tools/studio/routes.h"

namespace retarget::studio {

class StudioServer {
 public:
  // `page`: what / gives.
  StudioServer(StudioRoutes* routes, std::string page);
  ~StudioServer();

  // Listens on 127.0.0.1; 0: any free port. Throws InputError where the port is taken.
  void Bind(int port);
  // "http://127.0.0.1:PORT/?token=TOKEN".
  std::string url() const;
  // Answers until Stop, from another thread.
  void Run();
  void Stop();

 private:
  struct Http;
  std::unique_ptr<Http> http_;
};

}  // namespace retarget::studio
