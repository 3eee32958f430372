#include "tools/studio/server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>
#include <time.h>

#include "tools/studio/error.h"

namespace retarget::studio {
namespace {

constexpr int kThreads = 48;  // each connection that a browser keeps open takes one
constexpr int kKeepAliveSeconds = 30;

// Nothing from elsewhere, nothing kept, in nobody else's frame.
const httplib::Headers& SafetyHeaders() {
  static const httplib::Headers headers = {
      {"Content-Security-Policy",
       "default-src 'self' 'unsafe-inline' data: blob:; connect-src 'self' data: blob:; "
       "form-action 'none'; base-uri 'none'; frame-ancestors 'self'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"}};
  return headers;
}

RequestOrigin OriginOf(const httplib::Request& request) {
  RequestOrigin origin;
  origin.host = request.get_header_value("Host");
  if (request.has_header("Origin")) origin.origin = request.get_header_value("Origin");
  origin.token = request.has_header("X-Retarget-Token")
                     ? request.get_header_value("X-Retarget-Token")
                     : request.get_param_value("token");
  return origin;
}

double MillisecondsOf(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// As a stream of known length: httplib would compress a body, which takes longer than a drag.
void Send(const StudioAnswer& answer, httplib::Response* response) {
  response->status = answer.status;
  if (answer.more) {
    response->set_chunked_content_provider(
        answer.type, [more = answer.more](size_t, httplib::DataSink& sink) {
          std::string text;
          const bool last = !more(&text);
          if (text.empty()) text = ":\n\n";  // shows whether anybody is listening still
          if (!sink.is_writable() || !sink.write(text.data(), text.size())) return false;
          if (last) sink.done();
          return true;
        });
    return;
  }
  if (answer.body.empty()) {
    response->set_content("", answer.type);
    return;
  }
  response->set_content_provider(
      answer.body.size(), answer.type,
      [body = answer.body](size_t offset, size_t length, httplib::DataSink& sink) {
        return sink.write(body.data() + offset, length);
      });
}

}  // namespace

struct StudioServer::Http {
  StudioRoutes* routes;
  std::string page;
  StudioGuard guard{RandomToken()};
  httplib::Server server;
  int port = 0;

  StudioAnswer AnswerTo(const httplib::Request& request) {
    try {
      guard.Check(OriginOf(request));
      if (request.path == "/" && request.method == "GET") {
        return {200, "text/html; charset=utf-8", page};
      }
      if (request.path != "/api/photo") CheckMessageSize(request.body.size());
      StudioRequest own{request.method, request.path, {}, request.body};
      for (const auto& [name, value] : request.params) own.parameters[name] = value;
      if (request.has_header("Last-Event-ID")) {
        own.parameters["after"] = request.get_header_value("Last-Event-ID");
      }
      return routes->Answer(own);
    } catch (const std::exception& error) {
      return AnswerOf(error);
    }
  }

  void Build() {
    server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // Not shared with another server, which httplib would allow.
    server.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server.set_tcp_nodelay(true);
    server.set_keep_alive_max_count(1'000'000);
    server.set_keep_alive_timeout(kKeepAliveSeconds);
    server.set_payload_max_length(kMostBytes);
    server.set_default_headers(SafetyHeaders());
    const auto handle = [this](const httplib::Request& request, httplib::Response& response) {
      const double wall = MillisecondsOf(CLOCK_MONOTONIC);
      const double cpu = MillisecondsOf(CLOCK_THREAD_CPUTIME_ID);
      const StudioAnswer answer = AnswerTo(request);
      response.set_header(
          "Server-Timing",
          fmt::format("total;dur={:.3f}, cpu;dur={:.3f}", MillisecondsOf(CLOCK_MONOTONIC) - wall,
                      MillisecondsOf(CLOCK_THREAD_CPUTIME_ID) - cpu));
      Send(answer, &response);
    };
    const char* any = R"([\s\S]*)";
    server.Get(any, handle);
    server.Post(any, handle);
    server.Put(any, handle);
    server.Patch(any, handle);
    server.Delete(any, handle);
    server.Options(any, handle);
    // What httplib refuses itself: no HTTP, or too much of it.
    server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (!response.body.empty() || response.content_length_ > 0) return;
      const StudioAnswer answer = ErrorAnswer(
          response.status, response.status == 413 ? "the body is larger than the studio takes"
                                                  : "this is no request that the studio knows");
      response.set_content(answer.body, answer.type);
    });
  }
};

StudioServer::StudioServer(StudioRoutes* routes, std::string page)
    : http_(std::make_unique<Http>()) {
  http_->routes = routes;
  http_->page = std::move(page);
  http_->Build();
}

StudioServer::~StudioServer() = default;

void StudioServer::Bind(int port) {
  Http& http = *http_;
  if (port == 0) {
    http.port = http.server.bind_to_any_port("127.0.0.1");
  } else if (http.server.bind_to_port("127.0.0.1", port)) {
    http.port = port;
  }
  if (http.port <= 0) throw InputError(fmt::format("--port {}: is taken, choose another", port));
  http.guard.set_port(http.port);
}

std::string StudioServer::url() const {
  return fmt::format("http://127.0.0.1:{}/?token={}", http_->port, http_->guard.token());
}

void StudioServer::Run() { http_->server.listen_after_bind(); }

void StudioServer::Stop() { http_->server.stop(); }

}  // namespace retarget::studio
