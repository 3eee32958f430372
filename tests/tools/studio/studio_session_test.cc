// Editing over HTTP: the same as the posing session itself does, and nothing is lost on the way.
#include <chrono>
#include <thread>

#include "io/template_file.h"
#include "model/geometry/so3.h"
#include "tests/tools/studio/studio_program.h"
#include "tools/api/clip_posture.h"
#include "tools/posing/label.h"
#include "tools/posing/queries.h"
#include "tools/posing/session.h"

namespace retarget::studio {
namespace {

report::Json VectorJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

int NodeOf(const posing::PoseSession& session, int figure, const char* name) {
  return session.posture().body[figure].FindNode(name);
}
int LinkOf(const posing::PoseSession& session, int figure, const char* name) {
  return session.posture().body[figure].FindLink(name);
}

io::LoadedClip Loaded(const char* name) {
  io::ClipOptions options;
  options.path = kHold + "/" + name;
  return io::LoadClip(options);
}

// Every operation that the page can send, and what the core does for it.
TEST(StudioSession, EveryOperationIsThatOfTheCore) {
  Studio studio;
  const std::string session = studio.Open();
  ASSERT_EQ(studio.Post("/api/load", {{"session", session}, {"template", "bear_hug"}}).status, 200);
  posing::PoseSession core(io::ReadTemplate(kHold + "/template.yaml"));
  const int hand = NodeOf(core, 0, "left_hand"), toe = NodeOf(core, 1, "left_toe");
  const int head = NodeOf(core, 1, "head_top"), knee = NodeOf(core, 1, "left_knee");
  const Vec3 target(0.1, 1.65, 0.05), origin(0.3, 1.2, 4), direction(0, 0, -1);
  const Quat turn = ExpSo3(Vec3(0.1, 0.2, -0.1));
  const report::Json quaternion = {turn.x(), turn.y(), turn.z(), turn.w()};
  const report::Json left_hand = {{"figure", "a"}, {"node", "left_hand"}};
  TemplateCamera camera;
  camera.eye = Vec3(1, 2, 3);
  const std::pair<report::Json, posing::Operation> steps[] = {
      {{{"op", "pin"}, {"figure", "b"}, {"node", "left_toe"}}, posing::Pin{1, toe, std::nullopt}},
      {{{"op", "set_option"}, {"option", "floor"}, {"on", false}},
       posing::SetOption{&posing::PoseOptions::floor, false}},
      {{{"op", "drag"}, {"figure", "b"}, {"node", "head_top"}, {"target", VectorJson(target)}},
       posing::Drag{1, head, target, 0}},
      {{{"op", "unpin"}, {"figure", "b"}, {"node", "left_toe"}}, posing::Unpin{1, toe}},
      {{{"op", "drag_ray"},
        {"figure", "b"},
        {"node", "left_knee"},
        {"origin", VectorJson(origin)},
        {"direction", VectorJson(direction)}},
       posing::DragRay{1, knee, origin, direction, 0}},
      {{{"op", "settle"}}, posing::Settle{}},
      {{{"op", "move_figure"}, {"figure", "a"}, {"shift", {0.01, 0, 0.02}}},
       posing::MoveFigure{0, Vec3(0.01, 0, 0.02)}},
      {{{"op", "turn_figure"}, {"figure", "b"}, {"rotation", quaternion}},
       posing::TurnFigure{1, turn}},
      {{{"op", "rotate_joint"}, {"figure", "a"}, {"joint", "chest"}, {"rotation", quaternion}},
       posing::RotateJoint{0, LinkOf(core, 0, "chest"), turn, false}},
      {{{"op", "rotate_joint"},
        {"figure", "a"},
        {"joint", "neck"},
        {"rotation", quaternion},
        {"world", true}},
       posing::RotateJoint{0, LinkOf(core, 0, "neck"), turn, true}},
      {{{"op", "set_joint"},
        {"figure", "b"},
        {"joint", "left_elbow"},
        {"rotation_vector", {0, -50, 10}}},
       posing::SetJoint{1, LinkOf(core, 1, "left_elbow"), ExpSo3(kDegree * Vec3(0, -50, 10))}},
      {{{"op", "set_root"}, {"figure", "a"}, {"position", {0, 0.95, -0.3}}},
       posing::SetRoot{0, Vec3(0, 0.95, -0.3)}},
      {{{"op", "set_root"},
        {"figure", "b"},
        {"position", {0, 0.97, 0}},
        {"rotation_vector", {0, 30, 0}}},
       posing::SetRoot{1, Vec3(0, 0.97, 0), ExpSo3(kDegree * Vec3(0, 30, 0))}},
      {{{"op", "set_stature"}, {"figure", "a"}, {"stature", 1.9}}, posing::SetStature{0, 1.9}},
      {{{"op", "mirror"}, {"figure", "both"}}, posing::Mirror{posing::kBoth}},
      {{{"op", "mirror"}, {"figure", "b"}}, posing::Mirror{1}},
      {{{"op", "swap_figures"}}, posing::SwapFigures{}},
      {{{"op", "copy_side"}, {"figure", "a"}, {"from", "right"}}, posing::CopySide{0, false}},
      {{{"op", "reset_joint"}, {"figure", "a"}, {"joint", "chest"}},
       posing::ResetJoint{0, LinkOf(core, 0, "chest")}},
      {{{"op", "reset_figure"}, {"figure", "b"}}, posing::ResetFigure{1}},
      {{{"op", "add_hold"},
        {"from", left_hand},
        {"to", {{"figure", "b"}, {"node", "left_knee"}, {"offset", {0, 0.1, 0}}}},
        {"rotation", true}},
       posing::AddHold{{{0, hand, Vec3::Zero()}, 1, knee, Vec3(0, 0.1, 0), true}}},
      {{{"op", "add_hold"}, {"from", left_hand}, {"to", {{"figure", "world"}}}},
       posing::AddHold{{{0, hand, Vec3::Zero()}, kWorld, 0, std::nullopt, false}}},
      {{{"op", "edit_hold"},
        {"index", 1},
        {"from", {{"figure", "a"}, {"node", "left_hand"}, {"offset", {0.01, 0, 0}}}},
        {"to", {{"figure", "b"}, {"node", "head_top"}}}},
       posing::EditHold{1, {{0, hand, Vec3(0.01, 0, 0)}, 1, head, std::nullopt, false}}},
      {{{"op", "remove_hold"}, {"index", 0}}, posing::RemoveHold{0}},
      {{{"op", "set_supports"}, {"figure", "b"}, {"nodes", {"left_toe"}}},
       posing::SetSupports{1, {toe}}},
      {{{"op", "set_root_leader"}, {"figure", "b"}, {"leader", "partner"}},
       posing::SetRootReference{1, RootReference::kPartner}},
      {{{"op", "set_tangles"},
        {"tangles", {{{"a", {"left_hand", "root"}}, {"b", {"root", "head_top"}}}}}},
       posing::SetTangles{{{{0, hand}, {0, head}}}}},
      {{{"op", "set_name"}, {"name", "a \"name\": #1"}}, posing::SetName{"a \"name\": #1"}},
      {{{"op", "set_description"}, {"description", "two\nlines"}},
       posing::SetDescription{"two\nlines"}},
      {{{"op", "set_tags"}, {"tags", {"x", "y, z"}}}, posing::SetTags{{"x", "y, z"}}},
      {{{"op", "set_photo"}, {"photo", {{"file", "x.jpg"}, {"opacity", 0.25}}}},
       posing::SetPhoto{TemplatePhoto{"x.jpg", 0.25, 1, Eigen::Vector2d::Zero()}}},
      {{{"op", "set_camera"},
        {"camera", {{"eye", {1, 2, 3}}, {"target", {0, 1, 0}}, {"fov_deg", 40}}}},
       posing::SetCamera{camera}},
      {{{"op", "set_camera"}, {"camera", nullptr}}, posing::SetCamera{}},
  };
  std::vector<std::string> texts = {core.Text()};
  for (const auto& [json, operation] : steps) {
    const auto reply = studio.Do(session, {json});
    ASSERT_EQ(reply.status, 200) << json.dump() << reply.body;
    core.Apply(operation);
    texts.push_back(core.Text());
    EXPECT_EQ(studio.Get("/api/yaml?session=" + session).body, texts.back()) << json.dump();
    EXPECT_EQ(reply.json["state"]["undo_text"], core.undo_text());
  }
  EXPECT_EQ(std::size(steps) + 1, texts.size());
  for (size_t k = texts.size() - 1; k > 0; --k) {
    ASSERT_EQ(studio.Do(session, {{{"op", "undo"}}}).status, 200);
    EXPECT_EQ(studio.Get("/api/yaml?session=" + session).body, texts[k - 1]);
  }
  ASSERT_EQ(studio.Do(session, {{{"op", "redo"}}}).status, 200);
  EXPECT_EQ(studio.Get("/api/yaml?session=" + session).body, texts[1]);
}

TEST(StudioSession, TheStateShowsThePosture) {
  Studio studio({"--template", kHold + "/template.yaml"});
  const report::Json opened = studio.Post("/api/session", report::Json::object()).json;
  const report::Json& state = opened["state"];
  EXPECT_EQ(opened["start"]["template"], "bear hug from behind");
  EXPECT_EQ(state["saved_as"], "bear_hug");
  EXPECT_EQ(state["dirty"], false);
  const TemplatePosture posture = io::ReadTemplate(kHold + "/template.yaml");
  for (int f = 0; f < 2; ++f) {
    const report::Json& figure = state["figures"][f == 0 ? "a" : "b"];
    const report::Json& body = opened["body"][f == 0 ? "a" : "b"];
    const PosedBody posed = PoseBody(posture.body[f], posture.pose[f]);
    ASSERT_EQ(figure["nodes"].size(), posed.node.size());
    for (size_t n = 0; n < posed.node.size(); ++n) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(figure["nodes"][n][k].get<double>(), posed.node[n][k], 1e-6);
      }
      EXPECT_EQ(body["nodes"][n]["name"], posture.body[f].nodes[n].name);
    }
    for (size_t l = 0; l < posed.rotation.size(); ++l) {
      const report::Json& q = figure["frames"][l];
      const Quat shown(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(),
                       q[2].get<double>());
      EXPECT_LT((shown.toRotationMatrix() - posed.rotation[l]).norm(), 1e-5);
      const report::Json& v = figure["rotation_vectors"][l];
      const Quat local =
          ExpSo3(kDegree * Vec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>()));
      EXPECT_LT(local.angularDistance(posture.pose[f].rotation[l]), 1e-6);
      const report::Json& node = body["links"][l]["node"];
      if (node.is_null()) continue;
      const Vec3& place = posed.node[posture.body[f].FindNode(node)];
      EXPECT_LT((place - posed.centre[l]).norm(), 1e-6) << node;
    }
  }
  const report::Json queries = posing::QueriesJson(posture);
  EXPECT_EQ(state["queries"], queries);
  EXPECT_FALSE(queries["tags"].empty());
  EXPECT_LT(state["holds"][0]["error_m"].get<double>(), 0.02);
}

TEST(StudioSession, GesturesAndMessagesAreOneStep) {
  Studio studio;
  const std::string session = studio.Open();
  const auto undo_all = [&] {
    int steps = 0;
    while (studio.Do(session, {{{"op", "undo"}}}).status == 200) ++steps;
    return steps;
  };
  for (int k = 1; k <= 5; ++k) {
    const report::Json spot = {0.2 + 0.01 * k, 1.3, -0.3};
    const report::Json drag = {
        {"op", "drag"}, {"figure", "a"}, {"node", "left_hand"}, {"target", spot}, {"gesture", 4}};
    const auto reply = studio.Do(session, {drag}, true);
    EXPECT_EQ(reply.json["state"]["dirty"], true);
    EXPECT_LE(reply.json["result"]["iterations"].get<int>(), 12 + 3);
    EXPECT_FALSE(reply.json["state"]["queries"].contains("gli_table"));
    EXPECT_TRUE(reply.json["state"]["queries"].contains("tags"));
  }
  for (int k = 1; k <= 5; ++k) {
    const report::Json turn = {{"op", "set_joint"},
                               {"figure", "a"},
                               {"joint", "neck"},
                               {"rotation_vector", {0, 5 * k, 0}},
                               {"gesture", 4}};
    studio.Do(session, {turn}, true);
  }
  EXPECT_EQ(undo_all(), 2);
  const report::Json move = {
      {"op", "move_figure"}, {"figure", "a"}, {"shift", {0.1, 0, 0}}, {"gesture", 9}};
  const report::Json name = {{"op", "set_name"}, {"name", "x"}}, mirror = {{"op", "swap_figures"}};
  studio.Do(session, {name, mirror, move});
  EXPECT_EQ(undo_all(), 1);
  studio.Do(session, {move}, true);
  studio.Do(session, {move}, true);
  studio.Do(session, {move, name, mirror});
  EXPECT_EQ(undo_all(), 1);
  EXPECT_EQ(studio.Get("/api/state?session=" + session).json["state"]["dirty"], false);
}

TEST(StudioSession, AReloadFindsEverythingAndADraftIsTheSamePosture) {
  Studio studio;
  const std::string session = studio.Open();
  const report::Json drag = {
      {"op", "drag"}, {"figure", "a"}, {"node", "left_hand"}, {"target", {0.2, 1.3, 0}}};
  const report::Json last = studio.Do(session, {drag}).json["state"];
  const report::Json reloaded = studio.Get("/api/state?session=" + session).json;
  EXPECT_EQ(reloaded["state"], last);
  EXPECT_TRUE(reloaded.contains("body"));
  // The server forgot it: the page opens another session with its draft.
  const std::string draft = studio.Get("/api/yaml?session=" + session).body;
  const std::string other = studio.Open();
  ASSERT_EQ(studio.Post("/api/load", {{"session", other}, {"yaml", draft}}).status, 200);
  EXPECT_EQ(studio.Get("/api/yaml?session=" + other).body, draft);
  EXPECT_EQ(studio.Get("/api/state?session=" + other).json["state"]["dirty"], true);
}

TEST(StudioSession, TheOneUnusedLongestGoes) {
  Studio studio;
  const std::string first = studio.Open(), second = studio.Open();
  studio.Do(second, {{{"op", "set_name"}, {"name", "second"}}});
  for (int k = 0; k < 14; ++k) studio.Open();
  EXPECT_EQ(studio.Get("/api/state?session=" + first).status, 200);  // used now
  studio.Open();
  ExpectRefusal(studio.Get("/api/state?session=" + second), 404, "session");
  EXPECT_EQ(studio.Get("/api/state?session=" + first).status, 200);
}

TEST(StudioSession, StartsFromClipsRestAndPhoto) {
  Studio studio({"--clip-a", kHold + "/a.bvh", "--clip-b", kHold + "/b.bvh"});
  const report::Json opened = studio.Post("/api/session", report::Json::object()).json;
  EXPECT_EQ(opened["start"]["clips"]["a"]["frames"], 301);
  const std::string session = opened["session"];
  const io::LoadedClip a = Loaded("a.bvh"), b = Loaded("b.bvh");
  const auto load = [&](const report::Json& what) {
    return studio.Post("/api/load", {{"session", session}, {"clips", what}});
  };
  ASSERT_EQ(load({{"frame_a", 10}, {"frame_b", 20}, {"together", true}}).status, 200);
  EXPECT_EQ(studio.Get("/api/yaml?session=" + session).body,
            io::FormatTemplate(api::PostureOfFrames({&a, &b}, {10, 20}, true)));
  ExpectRefusal(load({{"frame_a", 301}, {"frame_b", 0}}), 400, "300");
  ExpectRefusal(load({{"frame_a", "x"}, {"frame_b", 0}}), 400, "frame_a");

  const report::Json rest = {{"stature", {{"a", 1.6}, {"b", 1.9}}}, {"distance", 2}};
  ASSERT_EQ(studio.Post("/api/load", {{"session", session}, {"rest", rest}}).status, 200);
  EXPECT_EQ(studio.Get("/api/yaml?session=" + session).body,
            io::FormatTemplate(posing::RestPosture(1.6, 1.9, 2)));
}

// Each turned to the other, 1 m apart, and otherwise as it was: no joint is bent, no height lost.
TEST(ClipPosture, ApartFaceEachOther) {
  const io::LoadedClip a = Loaded("a.bvh"), b = Loaded("b.bvh");
  const auto together = api::PostureOfFrames({&a, &b}, {50, 60}, true);
  const auto apart = api::PostureOfFrames({&a, &b}, {50, 60}, false);
  for (int f = 0; f < 2; ++f) {
    const Pose &p = together.pose[f], &q = apart.pose[f];
    EXPECT_NEAR(q.root_position.x(), 0, 1e-12);
    EXPECT_NEAR(q.root_position.z(), f == 0 ? -0.5 : 0.5, 1e-12);
    EXPECT_NEAR(q.root_position.y(), p.root_position.y(), 1e-12);
    EXPECT_NEAR(std::abs(YawOf(q.rotation[0])), f == 0 ? 0 : kPi, 1e-9);
    // The vertical is where it was in the body.
    EXPECT_LT(
        (q.rotation[0].conjugate() * Vec3::UnitY() - p.rotation[0].conjugate() * Vec3::UnitY())
            .norm(),
        1e-9);
    for (size_t l = 1; l < p.rotation.size(); ++l) {
      EXPECT_LT(p.rotation[l].angularDistance(q.rotation[l]), 1e-12);
    }
  }
}

// Both pages are served at once: a solve in one does not hold up the other.
TEST(StudioSession, SessionsDoNotWaitForEachOther) {
  Studio studio;
  const std::string slow = studio.Open(), quick = studio.Open();
  const report::Json far = {
      {"op", "drag"}, {"figure", "a"}, {"node", "left_hand"}, {"target", {90, 90, 90}}};
  using Clock = std::chrono::steady_clock;
  Clock::time_point slow_done;
  std::thread other([&] {
    httplib::Client client("127.0.0.1", studio.port);
    client.set_read_timeout(60);
    std::vector<report::Json> ops;
    for (int k = 0; k < 20; ++k) ops.push_back(far);
    const report::Json message = {{"session", slow}, {"ops", ops}};
    EXPECT_EQ(client.Post("/api/do", studio.Token(), message.dump(), "application/json")->status,
              200);
    slow_done = Clock::now();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto reply = studio.Do(quick, {{{"op", "set_name"}, {"name", "quick"}}});
  const auto quick_done = Clock::now();
  other.join();
  EXPECT_EQ(reply.status, 200);
  EXPECT_LT(quick_done, slow_done);
}

TEST(PoseSession, SetJointAndGesturesByHand) {
  posing::PoseSession session(io::ReadTemplate(kHold + "/template.yaml"));
  const std::string before = session.Text();
  const int elbow = LinkOf(session, 0, "left_elbow");
  const Quat bent = ExpSo3(Vec3(0, -1, 0.2));
  for (int k = 0; k < 3; ++k) session.Apply(posing::SetJoint{0, elbow, bent, 5});
  session.Apply(posing::MoveFigure{0, Vec3(0.1, 0, 0), 5});
  EXPECT_LT(session.posture().pose[0].rotation[elbow].angularDistance(bent), 1e-12);
  EXPECT_EQ(session.undo_text(), "turn of a/left_elbow");
  session.Apply(posing::MoveFigure{0, Vec3(0.1, 0, 0), 6});
  session.Apply(posing::SetPosture{posing::RestPosture(1.7, 1.7, 1), 3});
  EXPECT_EQ(session.state().document, 3);
  EXPECT_EQ(session.undo_text(), "new posture");
  EXPECT_TRUE(session.Undo());
  EXPECT_EQ(session.state().document, 0);
  EXPECT_TRUE(session.Undo());
  EXPECT_TRUE(session.Undo());
  EXPECT_EQ(session.Text(), before);
  EXPECT_FALSE(session.Undo());
  EXPECT_THROW(session.Apply(posing::SetJoint{0, 40, bent}), InputError);
}

TEST(PoseCommand, SetsAJoint) {
  Scratch scratch;
  const Outcome outcome = RunProgram(
      scratch, "pose " + kHold + "/template.yaml --set-joint b/left_elbow=0,-60,0 --out " +
                   scratch / "t.yaml");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(ReadWholeFile(scratch / "t.yaml").find("left_elbow: [0, -60, 0]"), std::string::npos);
}

// Tags that are measured again are what finding them again would say.
TEST(PoseQueries, LiveTagsAreThoseOfTheFullAnswer) {
  TemplatePosture posture = io::ReadTemplate(kHold + "/template.yaml");
  std::vector<Tag> tags;
  posing::QueriesJson(posture, &tags);
  ASSERT_EQ(tags.size(), 2u);
  posture.pose[0].root_position += Vec3(0.01, 0.01, 0);
  posture.tangles = {{tags[0].tangle.a, tags[0].tangle.b}, {tags[1].tangle.a, tags[1].tangle.b}};
  const report::Json live = posing::LiveQueriesJson(posture, tags),
                     full = posing::QueriesJson(posture);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(live["tags"][k]["gli"].get<double>(), full["tags"][k]["gli"].get<double>(), 1e-12);
    EXPECT_NEAR(live["tags"][k]["rho"].get<double>(), full["tags"][k]["rho"].get<double>(), 1e-12);
    EXPECT_EQ(full["tags"][k]["requested"], true);
  }
  EXPECT_EQ(live["overlaps"], full["overlaps"]);
  // Beside one that is listed, the other is found still.
  posture.tangles.pop_back();
  const report::Json beside = posing::QueriesJson(posture);
  ASSERT_GE(beside["tags"].size(), 2u);
  EXPECT_EQ(beside["tags"][0]["requested"], true);
  EXPECT_EQ(beside["tags"][1]["requested"], false);
}

}  // namespace
}  // namespace retarget::studio
