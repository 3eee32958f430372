// Who may speak to the studio, and what it does with messages that are not what they should be.
#include <arpa/inet.h>

#include <random>

#include "tests/tools/studio/studio_program.h"
#include "tools/report/report.h"

namespace retarget::studio {
namespace {

TEST(StudioSafety, TheTokenHostAndOriginAreAsked) {
  Studio studio;
  const std::string host = "127.0.0.1:" + std::to_string(studio.port);
  const struct {
    httplib::Headers headers;
    std::string path;
    int status;
  } cases[] = {
      {{}, "/", 403},
      {{}, "/?token=", 403},
      {{}, "/?token=" + studio.token.substr(1), 403},
      {{}, "/?token=" + studio.token + "0", 403},
      {{}, "/?token=" + studio.token, 200},
      {{}, "/api/library", 403},
      {{}, "/nothing/here", 403},
      {{}, "/api/library?token=" + studio.token, 200},
      {studio.Token(), "/api/library", 200},
      {studio.Token(), "/nothing/here", 404},
      {{{"X-Retarget-Token", std::string(32, '0')}}, "/api/library", 403},
      // The header counts where there are both.
      {{{"X-Retarget-Token", "wrong"}}, "/api/library?token=" + studio.token, 403},
      {{{"Host", "evil.example"}, {"X-Retarget-Token", studio.token}}, "/api/library", 403},
      {{{"Host", "evil.example:" + std::to_string(studio.port)},
        {"X-Retarget-Token", studio.token}},
       "/api/library",
       403},
      {{{"Host", "localhost:" + std::to_string(studio.port)}, {"X-Retarget-Token", studio.token}},
       "/api/library",
       200},
      {{{"Origin", "http://evil.example"}, {"X-Retarget-Token", studio.token}},
       "/api/library",
       403},
      {{{"Origin", "null"}, {"X-Retarget-Token", studio.token}}, "/api/library", 403},
      {{{"Origin", "https://" + host}, {"X-Retarget-Token", studio.token}}, "/api/library", 403},
      {{{"Origin", "http://127.0.0.1:1"}, {"X-Retarget-Token", studio.token}}, "/api/library", 403},
      {{{"Origin", "http://" + host}, {"X-Retarget-Token", studio.token}}, "/api/library", 200},
  };
  for (const auto& c : cases) {
    const auto result = studio.client->Get(c.path, c.headers);
    ASSERT_TRUE(result) << c.path;
    EXPECT_EQ(result->status, c.status) << c.path << " " << result->body.substr(0, 200);
    if (c.status == 403) {
      EXPECT_EQ(result->body.find(studio.token), std::string::npos);
    }
  }
  for (const char* path : {"/api/do", "/api/session", "/api/save", "/api/delete", "/api/solve"}) {
    const auto result = studio.client->Post(path, "{}", "application/json");
    ASSERT_TRUE(result);
    EXPECT_EQ(result->status, 403) << path;
  }
}

// Whether somebody listens at an address of this machine.
bool Listens(const char* address, int port) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<uint16_t>(port));
  inet_pton(AF_INET, address, &to.sin_addr);
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const bool yes = connect(socket, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
  close(socket);
  return yes;
}

TEST(StudioSafety, ListensOnOneAddressOnly) {
  Studio studio;
  EXPECT_TRUE(Listens("127.0.0.1", studio.port));
  EXPECT_FALSE(Listens("127.0.0.2", studio.port));  // where 0.0.0.0 would answer
  EXPECT_NE(studio.url.find("http://127.0.0.1:"), std::string::npos);
  EXPECT_EQ(studio.token.size(), 32u);
  Studio other;
  EXPECT_NE(other.token, studio.token);
  EXPECT_EQ(studio.End(SIGTERM), 0);
  EXPECT_EQ(other.End(SIGINT), 0);
  EXPECT_FALSE(Listens("127.0.0.1", studio.port));
}

TEST(StudioSafety, ATakenPortIsOneLine) {
  Studio studio;
  Scratch scratch;
  const Outcome outcome =
      RunProgram(scratch, "studio --no-browser --port " + std::to_string(studio.port));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--port"), std::string::npos) << outcome.err;
  for (const char* options : {"--template /nowhere.yaml", "--library /nowhere", "--photo /nowhere",
                              "--clip-a /nowhere.bvh"}) {
    const Outcome refused = RunProgram(scratch, std::string("studio --no-browser ") + options);
    EXPECT_EQ(refused.code, 2) << options;
    EXPECT_NE(refused.err.find("/nowhere"), std::string::npos) << refused.err;
  }
}

TEST(StudioSafety, BodiesAreLimited) {
  Studio studio;
  const std::string session = studio.Open();
  const std::string huge(17 << 20, ' '), long_message(1200 * 1000, ' ');
  for (const char* path : {"/api/do", "/api/photo", "/api/nothing"}) {
    const auto reply = studio.PostBytes(path, huge);
    EXPECT_TRUE(reply.status == 413 || reply.status == -1) << path << " " << reply.status;
  }
  ExpectRefusal(studio.PostBytes("/api/do", long_message), 413, "1048576");
  ExpectRefusal(studio.PostBytes("/api/photo?session=" + session, std::string(3 << 20, 'x')), 400,
                "PNG");
  EXPECT_EQ(studio.Get("/api/state?session=" + session).status, 200);
}

TEST(StudioSafety, BadMessagesAreRefusedInOneSentenceAndChangeNothing) {
  Studio studio;
  const std::string session = studio.Open();
  const report::Json before = studio.Get("/api/state?session=" + session).json;
  const std::string head = R"({"session":")" + session + R"(","ops":[)";
  const struct {
    std::string body, words;
  } cases[] = {
      {"", "JSON"},
      {"{", "JSON"},
      {"[]", "object"},
      {"nul", "JSON"},
      {"{\"session\":1e999}", "out of range"},
      {"\xff\xfe", "JSON"},
      {std::string(100000, '['), "nested"},
      {"{}", "ops is missing"},
      {R"({"ops":[]})", "session is missing"},
      {R"({"ops":{},"session":"x"})", "ops: expected a list"},
      {R"({"ops":[],"sesion":"x"})", "did you mean \"session\""},
      {head + "7]}", "ops[0]: expected an object"},
      {head + "{}]}", "ops[0].op is missing"},
      {head + R"({"op":7}]})", "ops[0].op: expected a name"},
      {head + R"({"op":"drgg"}]})", "did you mean \"drag\""},
      {head + R"({"op":"drag"}]})", "figure is missing"},
      {head + R"({"op":"drag","figure":"c","node":"head","target":[0,0,0]}]})", "\"c\""},
      {head + R"({"op":"drag","figure":"a","node":"left_hnad","target":[0,0,0]}]})",
       "did you mean \"left_hand\""},
      {head + R"({"op":"drag","figure":"a","node":"head","target":[0,0]}]})", "3 numbers"},
      {head + R"({"op":"drag","figure":"a","node":"head","target":[0,0,"x"]}]})", "3 numbers"},
      {head + R"({"op":"drag","figure":"a","node":"head","target":[0,0,1e30]}]})", "1000"},
      {head + R"({"op":"drag","figure":"a","node":"head","target":[0,0,0],"gesture":-1}]})",
       "gesture"},
      {head + R"({"op":"drag","figure":"a","node":"head","target":[0,0,0],"gesture":1.5}]})",
       "whole number"},
      {head + R"({"op":"drag","figure":"a","node":"head","target":[0,0,0],"gestures":1}]})",
       "did you mean \"gesture\""},
      {head +
           R"({"op":"drag_ray","figure":"a","node":"head","origin":[0,0,0],"direction":[0,0,0]}]})",
       "not zero"},
      {head + R"({"op":"unpin","figure":"a","node":"head"}]})", "not pinned"},
      {head + R"({"op":"turn_figure","figure":"a","rotation":[0,0,0,0]}]})", "quaternion"},
      {head + R"({"op":"set_stature","figure":"a","stature":30}]})", "0.5 to 3"},
      {head + R"({"op":"remove_hold","index":0}]})", "hold"},
      {head +
           R"({"op":"edit_hold","index":-1,"from":{"figure":"a","node":"head"},"to":{"figure":"world"}}]})",
       "index"},
      {head +
           R"({"op":"add_hold","from":{"figure":"a","node":"head"},"to":{"figure":"world","node":"head"}}]})",
       "unknown field"},
      {head + R"({"op":"set_option","option":"hold","on":true}]})", "did you mean \"holds\""},
      {head + R"({"op":"set_option","option":"holds","on":"yes"}]})", "true or false"},
      {head + R"({"op":"set_tangles","tangles":[{"a":["head"],"b":["head","neck"]}]}]})",
       "two different nodes"},
      {head + R"({"op":"set_name","name":")" + std::string(5000, 'x') + "\"}]}", "200 bytes"},
      {head + R"({"op":"set_photo","photo":{"file":"x","opacity":7}}]})", "opacity"},
      {head + R"({"op":"set_camera","camera":{"eye":[0,0,0],"target":[0,0,0]}}]})", "direction"},
      {head + R"({"op":"undo"}]})", "nothing to undo"},
      {head + R"({"op":"settle"},{"op":"undo"}]})", "only operation"},
      // The first would do; the second does not, so neither is done.
      {head + R"({"op":"set_name","name":"x"},{"op":"remove_hold","index":3}]})",
       "nothing was done"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.body.substr(0, 200));
    ExpectRefusal(studio.PostBytes("/api/do", c.body), 400, c.words);
  }
  ExpectRefusal(studio.Do("0123", {}), 404, "session");
  EXPECT_EQ(studio.Get("/api/state?session=" + session).json, before);
  const std::pair<const char*, const char*> elsewhere[] = {
      {"/api/load", R"({"session":"S"})"},
      {"/api/load", R"({"session":"S","yaml":"format: 9"})"},
      {"/api/load", R"({"session":"S","yaml":"x","template":"bear_hug"})"},
      {"/api/load", R"({"session":"S","rest":{"stature":{"a":0}}})"},
      {"/api/load", R"({"session":"S","clips":{"frame_a":0}})"},
      {"/api/save", R"({"session":"S"})"},
      {"/api/save", R"({"session":"S","as":"x","thumbnail":"AAAA"})"},
      {"/api/duplicate", R"({"id":"bear_hug"})"},
      {"/api/solve", R"({"session":"S","clip_a":"bear_hug/a.bvh"})"},
      {"/api/solve",
       R"({"session":"S","clip_a":"bear_hug/a.bvh","clip_b":"bear_hug/b.bvh","frames":"1"})"},
      {"/api/solve",
       R"({"session":"S","clip_a":"bear_hug/a.bvh","clip_b":"bear_hug/b.bvh","settings":{"x":[]}})"},
  };
  for (const auto& [path, body] : elsewhere) {
    std::string text = body;
    const size_t at = text.find("\"S\"");
    if (at != std::string::npos) text.replace(at + 1, 1, session);
    SCOPED_TRACE(text);
    ExpectRefusal(studio.PostBytes(path, text), 400);
  }
  EXPECT_EQ(studio.Get("/api/state?session=" + session).json, before);
}

// Sends bytes as they are; the beginning of what comes back.
std::string Raw(int port, const std::string& bytes) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<uint16_t>(port));
  inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_EQ(connect(socket, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  const timeval patience{1, 0};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  shutdown(socket, SHUT_WR);
  std::string answer(4096, '\0');
  const ssize_t count = recv(socket, answer.data(), answer.size(), 0);
  close(socket);
  answer.resize(count > 0 ? static_cast<size_t>(count) : 0);
  return answer;
}

TEST(StudioSafety, BytesThatAreNoHttpDoNotEndIt) {
  Studio studio;
  const std::string session = studio.Open();
  const std::string host = "Host: 127.0.0.1:" + std::to_string(studio.port) + "\r\n";
  const std::string token = "X-Retarget-Token: " + studio.token + "\r\n";
  const std::string cases[] = {
      "",
      "\r\n\r\n",
      "GARBAGE\r\n\r\n",
      std::string("\0\1\2\3\r\n\r\n", 8),
      "GET / HTTP/9.9\r\n\r\n",
      "GET /" + std::string(20000, 'a') + " HTTP/1.1\r\n" + host + "\r\n",
      "GET / HTTP/1.1\r\n" + host + "X: " + std::string(20000, 'a') + "\r\n\r\n",
      "GET /" + std::string(8000, '(') + " HTTP/1.1\r\n" + host + token + "\r\n",
      "GET /%00%0a%zz?%=&&&= HTTP/1.1\r\n" + host + token + "\r\n",
      "POST /api/do HTTP/1.1\r\n" + host + token + "Content-Length: -5\r\n\r\n{}",
      "POST /api/do HTTP/1.1\r\n" + host + token + "Content-Length: 99999999999999999999\r\n\r\n{}",
      "POST /api/do HTTP/1.1\r\n" + host + token + "Content-Length: 50\r\n\r\n{\"ops\"",
      "POST /api/do HTTP/1.1\r\n" + host + token + "Transfer-Encoding: chunked\r\n\r\nzz\r\n{}",
      "POST /api/do HTTP/1.1\r\n" + host + token +
          "Content-Encoding: gzip\r\nContent-Length: 4\r\n\r\nabcd",
      "POST /api/do HTTP/1.1\r\n" + host + token +
          "Content-Type: multipart/form-data; boundary=\r\nContent-Length: 4\r\n\r\nabcd",
      "GET /api/library HTTP/1.1\r\n" + host + token + "Range: bytes=9-1,-,a\r\n\r\n",
      "GET /api/library HTTP/1.1\r\n" + token + "\r\n",
      // A second request in the body of one that is refused.
      "POST /api/do HTTP/1.1\r\nHost: evil\r\nContent-Length: 40\r\n\r\nGET /api/library "
      "HTTP/1.1\r\n" +
          host + "\r\n",
  };
  for (const std::string& bytes : cases) {
    SCOPED_TRACE(bytes.substr(0, 100));
    const std::string answer = Raw(studio.port, bytes);
    EXPECT_EQ(answer.find("templates\":"), bytes.find("Range") != std::string::npos
                                               ? answer.find("templates\":")
                                               : std::string::npos);
    EXPECT_TRUE(studio.Lives());
  }
  EXPECT_EQ(studio.Get("/api/state?session=" + session).status, 200);
}

// Valid messages, damaged at random: refused or done, never an internal error.
TEST(StudioSafety, DamagedMessagesNeverReachAnInternalError) {
  Studio studio;
  const std::string session = studio.Open();
  studio.Post("/api/load", {{"session", session}, {"template", "bear_hug"}});
  const std::vector<std::string> messages = {
      R"({"op":"drag","figure":"b","node":"head_top","target":[0.1,1.6,0.1],"gesture":3})",
      R"({"op":"drag_ray","figure":"a","node":"left_hand","origin":[0,1,4],"direction":[0,0,-1]})",
      R"({"op":"pin","figure":"a","node":"left_toe","ray":{"origin":[0,1,4],"direction":[0,0,-1]}})",
      R"({"op":"rotate_joint","figure":"a","joint":"chest","rotation":[0,0.1,0,1],"world":true})",
      R"({"op":"set_joint","figure":"b","joint":"neck","rotation_vector":[10,-20,5],"gesture":2})",
      R"({"op":"add_hold","from":{"figure":"a","node":"right_hand"},"to":{"figure":"b","node":"neck","offset":[0,0.1,0]},"rotation":true})",
      R"({"op":"set_tangles","tangles":[{"a":["left_hand","right_wrist"],"b":["left_wrist","left_knee"]}]})",
      R"({"op":"set_tags","tags":["one","two"]})",
      R"({"op":"set_photo","photo":{"file":"x.jpg","opacity":0.5,"scale":1,"offset":[0,0]}})",
      R"({"op":"mirror","figure":"both"})",
      R"({"op":"undo"})",
  };
  std::mt19937 random(7);
  const auto any = [&](size_t n) { return static_cast<size_t>(random() % n); };
  std::map<int, int> counts;
  for (int round = 0; round < 600; ++round) {
    std::string op = messages[any(messages.size())];
    for (size_t k = any(4); k > 0; --k) {
      switch (any(4)) {
        case 0:
          op[any(op.size())] = static_cast<char>(random());
          break;
        case 1:
          op.erase(any(op.size()), 1 + any(5));
          break;
        case 2:
          op.insert(any(op.size()), std::to_string(static_cast<int>(random())));
          break;
        default: {
          const std::string& other = messages[any(messages.size())];
          op.insert(any(op.size()), other.substr(any(other.size()), any(20)));
        }
      }
      if (op.empty()) op = "{";
    }
    const std::string body = R"({"session":")" + session + R"(","live":true,"ops":[)" + op + "]}";
    const auto reply = studio.PostBytes("/api/do", body);
    ASSERT_TRUE(reply.status == 200 || reply.status == 400 || reply.status == 404)
        << reply.status << " " << reply.body.substr(0, 200) << "\n"
        << body;
    ++counts[reply.status];
  }
  EXPECT_GT(counts[200], 50);
  EXPECT_GT(counts[400], 200);
  // What came of it can be saved and read.
  const auto saved = studio.Post("/api/save", {{"session", session}, {"as", "damaged"}});
  EXPECT_EQ(saved.status, 200) << saved.body.substr(0, 200);
}

}  // namespace
}  // namespace retarget::studio
