// A studio that runs for a test, as a user would start it, and messages to it.
#pragma once

#include <fcntl.h>
#include <httplib.h>
#undef _res  // of <resolv.h>, a name that Eigen uses
#include <spawn.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/tools/run_program.h"

namespace retarget::studio {

using Json = nlohmann::ordered_json;

class Studio {
 public:
  explicit Studio(const std::vector<std::string>& options = {}) {
    std::vector<std::string> words = {RETARGET_BINARY, "studio", "--no-browser"};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    // Its own folders: nothing of the user's is touched.
    std::vector<std::string> own = {"HOME=" + scratch / "home", "XDG_DATA_HOME=" + scratch / "data",
                                    "TMPDIR=" + scratch / "tmp", "PATH=/usr/bin:/bin"};
    fs::create_directories(scratch / "tmp");
    std::vector<char*> environment;
    for (std::string& variable : own) environment.push_back(variable.data());
    environment.push_back(nullptr);
    int ends[2];
    EXPECT_EQ(pipe2(ends, O_CLOEXEC), 0);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    EXPECT_EQ(
        posix_spawn(&pid_, RETARGET_BINARY, &files, nullptr, arguments.data(), environment.data()),
        0);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    for (char c; read(ends[0], &c, 1) == 1 && c != '\n';) url += c;
    close(ends[0]);
    const size_t colon = url.find(':', 6), slash = url.find('/', 8);
    if (slash == std::string::npos) return;  // it refused to start
    port = std::stoi(url.substr(colon + 1, slash - colon - 1));
    token = url.substr(url.find('=') + 1);
    client.emplace("127.0.0.1", port);
    client->set_keep_alive(true);
    client->set_tcp_nodelay(true);
    client->set_read_timeout(60);
  }
  ~Studio() { End(); }
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  // As Ctrl-C does; its exit code.
  int End(int signal = SIGINT) {
    if (pid_ <= 0) return code_;
    kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  bool Lives() const {
    return pid_ > 0 && kill(pid_, 0) == 0 && waitpid(pid_, nullptr, WNOHANG) == 0;
  }
  pid_t pid() const { return pid_; }

  httplib::Headers Token() const { return {{"X-Retarget-Token", token}}; }

  struct Reply {
    int status = -1;  // -1: no answer
    Json json;        // null where it is none
    std::string body;
  };
  Reply Get(const std::string& path) { return ReplyOf(client->Get(path, Token())); }
  Reply PostBytes(const std::string& path, const std::string& body) {
    return ReplyOf(client->Post(path, Token(), body, "application/json"));
  }
  Reply Post(const std::string& path, const Json& message) {
    return PostBytes(path, message.dump());
  }
  Reply Delete(const std::string& path) { return ReplyOf(client->Delete(path, Token())); }

  // A new editing session.
  std::string Open() { return Post("/api/session", Json::object()).json.value("session", ""); }
  Reply Do(const std::string& session, const std::vector<Json>& ops, bool live = false) {
    return Post("/api/do", {{"session", session}, {"ops", ops}, {"live", live}});
  }

  Scratch scratch;
  std::string url, token;
  int port = 0;
  std::optional<httplib::Client> client;

 private:
  static Reply ReplyOf(const httplib::Result& result) {
    Reply reply;
    if (!result) return reply;
    reply.status = result->status;
    reply.body = result->body;
    reply.json = Json::parse(result->body, nullptr, false);
    if (reply.json.is_discarded()) reply.json = nullptr;
    return reply;
  }

  pid_t pid_ = -1;
  int code_ = -1;
};

// One sentence, as every refusal is.
inline void ExpectRefusal(const Studio::Reply& reply, int status, const std::string& words = "") {
  EXPECT_EQ(reply.status, status) << reply.body;
  ASSERT_TRUE(reply.json.is_object() && reply.json.contains("error")) << reply.body;
  const std::string error = reply.json["error"];
  EXPECT_GT(error.size(), 10u);
  EXPECT_LT(error.size(), 600u);
  EXPECT_EQ(error.find('\n'), std::string::npos);
  EXPECT_NE(error.find(words), std::string::npos) << error;
}

}  // namespace retarget::studio
