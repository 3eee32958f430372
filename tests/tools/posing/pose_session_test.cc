// The posing session: exactness of its history and mirrors, its queries against the file that it
// saves, its limits; and `retarget pose` as a user calls it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "io/template_file.h"
#include "model/body/path.h"
#include "model/geometry/polyline.h"
#include "model/geometry/so3.h"
#include "solver/start/fit_template.h"
#include "tests/tools/run_program.h"
#include "tools/posing/command_line.h"
#include "tools/posing/queries.h"
#include "tools/posing/session.h"

namespace retarget::posing {
namespace {

TemplatePosture Hug() { return io::ReadTemplate(kHold + "/template.yaml"); }

// Every number of a state, and the file that it would be: equal only for the very same state.
std::string Exactly(const PoseState& state) {
  std::string bytes = io::FormatTemplate(state.posture);
  const auto add = [&](const auto& v) {
    for (long k = 0; k < v.size(); ++k) {
      const double x = v[k] + 0.0;  // -0 is 0
      bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
    }
  };
  for (int f = 0; f < 2; ++f) {
    add(state.posture.pose[f].root_position);
    for (const Quat& q : state.posture.pose[f].rotation) add(q.coeffs());
    for (const Link& link : state.posture.body[f].links) add(link.centre);
    for (const Node& node : state.posture.body[f].nodes) add(node.offset);
  }
  for (const Hold& hold : state.posture.holds) {
    bytes += std::to_string(hold.from.figure) + " " + std::to_string(hold.to.node);
    add(hold.from.offset);
    add(hold.to.offset);
    add(hold.relative_rotation.coeffs());
  }
  for (const PinnedNode& pin : state.pins) {
    bytes += std::to_string(pin.figure) + "/" + std::to_string(pin.node);
    add(pin.position);
  }
  const PoseOptions& o = state.options;
  for (const bool on : {o.holds, o.limits, o.penetration, o.floor, o.tangles, o.feet, o.root}) {
    bytes += on ? '1' : '0';
  }
  return bytes;
}

Vec3 PlaceOf(const PoseSession& session, int figure, const std::string& node) {
  const Body& body = session.posture().body[figure];
  return PoseBody(body, session.posture().pose[figure]).node[body.FindNode(node)];
}

double GliOf(const TemplatePosture& posture, const Path& a, const Path& b) {
  return PolylineGli(
      PointsOn(PoseBody(posture.body[0], posture.pose[0]).node, NodesOn(posture.body[0], a)),
      PointsOn(PoseBody(posture.body[1], posture.pose[1]).node, NodesOn(posture.body[1], b)));
}

Operation RandomOperation(const PoseState& state, std::mt19937* random) {
  std::uniform_int_distribution<int> any(0, 1 << 20);
  std::normal_distribution<double> normal;
  const int f = any(*random) % 2, node = any(*random) % 21, link = any(*random) % 19;
  const Vec3 v = 0.05 * Vec3(normal(*random), normal(*random), normal(*random));
  const Vec3 at = PoseBody(state.posture.body[f], state.posture.pose[f]).node[node] + v;
  const int holds = static_cast<int>(state.posture.holds.size());
  switch (any(*random) % 20) {
    case 0:
    case 1:
      return Drag{f, node, at, any(*random) % 3};
    case 2:
      return DragRay{f, node, at, Vec3(v.x(), 1, v.z()), 0};
    case 3:
      return Settle{};
    case 4:
      return Pin{f, node, std::nullopt};
    case 5:
      if (state.pins.empty()) return SwapFigures{};
      return Unpin{state.pins[0].figure, state.pins[0].node};
    case 6:
      return SetOption{kSolveOptions[any(*random) % 7].on, any(*random) % 2 == 0};
    case 7:
      return MoveFigure{f, v};
    case 8:
      return TurnFigure{f, ExpSo3(v)};
    case 9:
      return RotateJoint{f, link, ExpSo3(4 * v), any(*random) % 2 == 0};
    case 10:
      return SetRoot{f, Vec3(v.x(), 1, v.z()), ExpSo3(v)};
    case 11:
      return SetStature{f, 1.7 + v.x()};
    case 12:
      return Mirror{any(*random) % 3 - 1};
    case 13:
      return CopySide{f, any(*random) % 2 == 0};
    case 14:
      return ResetJoint{f, link};
    case 15:
      return AddHold{{{f, node, Vec3::Zero()}, 1 - f, node, std::nullopt, node % 2 == 0}};
    case 16:
      if (holds == 0) return ResetFigure{f};
      return RemoveHold{any(*random) % holds};
    case 17:
      return SetSupports{f, {node}};
    case 18:
      return SetName{"name " + std::to_string(node)};
    default:
      return SetCamera{TemplateCamera{}};
  }
}

TEST(PoseSession, HistoryGoesBackAndForthExactly) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    PoseSession session(Hug());
    std::vector<std::string> states = {Exactly(session.state())};
    for (int k = 0; k < 60; ++k) {
      const Operation operation = RandomOperation(session.state(), &random);
      session.Apply(operation, 6);
      states.push_back(Exactly(session.state()));
      if (k % 7 == 6) {  // wander in the history on the way
        for (int back = 0; back < 3; ++back) session.Undo();
        for (int forth = 0; forth < 3; ++forth) session.Redo();
        ASSERT_EQ(Exactly(session.state()), states.back()) << k;
      }
    }
    std::vector<std::string> undone = {Exactly(session.state())};
    while (session.Undo()) undone.push_back(Exactly(session.state()));
    EXPECT_EQ(undone.back(), states.front());
    EXPECT_GT(undone.size(), 45u);
    // Every step back is a state that was (merged steps of a drag are skipped).
    size_t at = states.size();
    for (const std::string& state : undone) {
      while (at > 0 && states[at - 1] != state) --at;
      ASSERT_GT(at, 0u);
    }
    for (size_t k = undone.size() - 1; k-- > 0;) {
      ASSERT_TRUE(session.Redo());
      ASSERT_EQ(Exactly(session.state()), undone[k]);
    }
    EXPECT_FALSE(session.can_redo());
  }
}

TEST(PoseSession, OneGestureIsOneStepOfTheHistory) {
  PoseSession session(Hug());
  const std::string before = Exactly(session.state());
  const int head = session.posture().body[1].FindNode("head_top");
  const Vec3 first = PlaceOf(session, 1, "head_top");
  for (int k = 1; k <= 10; ++k) session.Apply(Drag{1, head, first + Vec3(0.01 * k, 0, 0), 5}, 12);
  EXPECT_LT((PlaceOf(session, 1, "head_top") - first - Vec3(0.1, 0, 0)).norm(), 0.01);
  session.Apply(Drag{1, head, first, 6}, 12);
  EXPECT_TRUE(session.Undo());
  EXPECT_LT((PlaceOf(session, 1, "head_top") - first - Vec3(0.1, 0, 0)).norm(), 0.01);
  EXPECT_TRUE(session.Undo());
  EXPECT_EQ(Exactly(session.state()), before);
  EXPECT_FALSE(session.Undo());
}

TEST(PoseSession, MirrorTwiceIsTheIdentityAndOnceFlipsEverySign) {
  PoseSession session(Hug());
  session.Apply(AddHold{{{0, 8, Vec3(0.01, 0.02, 0.03)}, 1, 6, std::nullopt, true}});
  session.Apply(AddHold{{{1, 16, Vec3::Zero()}, kWorld, 0, std::nullopt, false}});
  session.Apply(Pin{1, 16, PinRay{Vec3(1, 2, 3), Vec3(0.1, 0.2, 1)}});
  session.Apply(SetTangles{{{{8, 12}, {3, 15}}}});
  const PoseState before = session.state();
  for (const int figure : {kBoth, 0, 1}) {
    session.Apply(Mirror{figure});
    EXPECT_NE(Exactly(session.state()), Exactly(before));
    session.Apply(Mirror{figure});
    EXPECT_EQ(Exactly(session.state()), Exactly(before)) << figure;
  }
  session.Apply(SetTangles{});
  const TemplatePosture posture = session.posture();
  session.Apply(Mirror{kBoth});
  const TemplatePosture& mirrored = session.posture();
  const auto tags = solver::FindTemplateTangles(posture, {}).tags;
  const auto mirrored_tags = solver::FindTemplateTangles(mirrored, {}).tags;
  ASSERT_FALSE(tags.empty());
  ASSERT_EQ(tags.size(), mirrored_tags.size());
  const auto other = [](int n) {
    return n >= 5 && n < 9     ? n + 4
           : n >= 9 && n < 13  ? n - 4
           : n >= 13 && n < 17 ? n + 4
           : n >= 17           ? n - 4
                               : n;
  };
  for (const Tag& tag : tags) {
    const Path a{other(tag.tangle.a.from), other(tag.tangle.a.to)};
    const Path b{other(tag.tangle.b.from), other(tag.tangle.b.to)};
    // A path walked the other way has the other sign: names are exchanged, the walk is not.
    EXPECT_NEAR(GliOf(mirrored, a, b), -tag.tangle.gli, 1e-12);
  }
  // Distances within and between the figures stay.
  const auto p = PosedFigures(posture), q = PosedFigures(mirrored);
  for (int i = 0; i < 21; ++i) {
    for (int j = 0; j < 21; ++j) {
      EXPECT_NEAR((p[0].node[i] - p[1].node[j]).norm(),
                  (q[0].node[other(i)] - q[1].node[other(j)]).norm(), 1e-12);
    }
  }
}

TEST(PoseSession, SwapTwiceIsTheIdentityAndKeepsTheTangles) {
  PoseSession session(Hug());
  const std::string before = Exactly(session.state());
  const auto tags = solver::FindTemplateTangles(session.posture(), {}).tags;
  session.Apply(SwapFigures{});
  for (const Tag& tag : tags) {
    EXPECT_NEAR(GliOf(session.posture(), tag.tangle.b, tag.tangle.a), tag.tangle.gli, 1e-12);
  }
  session.Apply(SwapFigures{});
  EXPECT_EQ(Exactly(session.state()), before);
}

TEST(PoseSession, ACopiedSideIsTheMirrorImage) {
  PoseSession session(Hug());
  session.Apply(RotateJoint{0, 6, ExpSo3(Vec3(0.3, 0.2, -0.4)), false});
  session.Apply(SetRoot{0, Vec3(0, 1, 0), Quat::Identity()});
  for (const char* link : {"waist", "chest", "neck", "head"}) {
    session.Apply(ResetJoint{0, session.posture().body[0].FindLink(link)});
  }
  session.Apply(CopySide{0, true});
  for (const char* node : {"elbow", "hand", "knee", "toe"}) {
    const Vec3 left = PlaceOf(session, 0, std::string("left_") + node);
    const Vec3 right = PlaceOf(session, 0, std::string("right_") + node);
    EXPECT_LT((right - Vec3(-left.x(), left.y(), left.z())).norm(), 1e-12) << node;
  }
}

TEST(PoseSession, ATurnAboutTheWorldsAxesTurnsEverythingBeyondTheJoint) {
  PoseSession session(Hug());
  const Body& body = session.posture().body[0];
  const Vec3 shoulder = PlaceOf(session, 0, "left_shoulder");
  const Vec3 hand = PlaceOf(session, 0, "left_hand");
  const Quat turn = ExpSo3(Vec3(0.2, -0.5, 0.3));
  session.Apply(RotateJoint{0, body.FindLink("left_shoulder"), turn, true});
  EXPECT_LT((PlaceOf(session, 0, "left_hand") - shoulder - turn * (hand - shoulder)).norm(), 1e-12);
}

TEST(PoseSession, PinsStayAndPinnedNodesGoWhereTheyAreDragged) {
  PoseSession session(Hug());
  const Body& b = session.posture().body[1];
  const int wrist = b.FindNode("right_wrist"), head = b.FindNode("head_top");
  session.Apply(Pin{1, wrist, std::nullopt});
  const Vec3 at = PlaceOf(session, 1, "right_wrist");
  const Vec3 toe = PlaceOf(session, 1, "left_toe");
  for (int k = 0; k < 5; ++k) {
    const Vec3 target = PlaceOf(session, 1, "head_top") + Vec3(0.02, -0.02, 0.02);
    const auto result = session.Apply(Drag{1, head, target, 0});
    EXPECT_LT(result->drag_error_m, 0.01);
  }
  EXPECT_LT((PlaceOf(session, 1, "right_wrist") - at).norm(), 0.005);
  EXPECT_LT((PlaceOf(session, 1, "left_toe") - toe).norm(), 0.005);
  session.Apply(Drag{1, wrist, at + Vec3(0, 0.05, 0.05), 0});
  EXPECT_LT((session.state().pins[0].position - at - Vec3(0, 0.05, 0.05)).norm(), 0.01);
}

TEST(PoseSession, InvalidOperationsChangeNothing) {
  PoseSession session(Hug());
  const std::string before = Exactly(session.state());
  const double nan = std::nan("");
  const Operation bad[] = {Drag{2, 0, Vec3::Zero(), 0},
                           Drag{0, 21, Vec3::Zero(), 0},
                           Drag{0, 3, Vec3(nan, 0, 0), 0},
                           Drag{0, 3, Vec3(1e9, 0, 0), 0},
                           DragRay{0, 3, Vec3::Zero(), Vec3::Zero(), 0},
                           Pin{0, -1, std::nullopt},
                           Unpin{0, 3},
                           MoveFigure{0, Vec3(0, nan, 0)},
                           MoveFigure{-1, Vec3::Zero()},
                           RotateJoint{0, 19, Quat::Identity(), false},
                           RotateJoint{0, 1, Quat(0, 0, 0, 0), false},
                           SetStature{0, 9},
                           SetStature{0, nan},
                           RemoveHold{1},
                           EditHold{-1, {}},
                           AddHold{{{0, 4, Vec3::Zero()}, 0, 4, std::nullopt, false}},
                           SetSupports{0, {3, 3}},
                           SetTangles{{{{4, 4}, {0, 1}}}},
                           SetCamera{TemplateCamera{Vec3::Zero(), Vec3::Zero(), 40}},
                           SetPhoto{TemplatePhoto{"x.jpg", 2, 1, Eigen::Vector2d::Zero()}}};
  for (const Operation& operation : bad) {
    EXPECT_THROW(session.Apply(operation), InputError) << operation.index();
    EXPECT_EQ(Exactly(session.state()), before) << operation.index();
    EXPECT_FALSE(session.can_undo());
  }
  session.Apply(SetRootReference{0, RootReference::kPartner});
  EXPECT_THROW(session.Apply(SetRootReference{1, RootReference::kPartner}), InputError);
}

TEST(PoseSession, OverlapsHaveTheirDepthAndPlace) {
  PoseSession session(RestPosture(1.75, 1.75, 1));
  EXPECT_TRUE(OverlapsOf(session.posture()).empty());
  // Face to face, each with the left arm stretched towards the other's side: the arms in one line,
  // the caps of the hands 1 cm deep.
  const Vec3 a = PlaceOf(session, 0, "left_hand"), b = PlaceOf(session, 1, "left_hand");
  const double radius = session.posture().body[0].nodes[8].radius;
  session.Apply(MoveFigure{1, a + Vec3(2 * radius - 0.01, 0, 0) - b});
  const auto overlaps = OverlapsOf(session.posture());
  ASSERT_FALSE(overlaps.empty());
  const auto hands = std::find_if(overlaps.begin(), overlaps.end(), [](const LimbOverlap& o) {
    return o.limbs.node == std::array<int, 2>{8, 8};
  });
  ASSERT_NE(hands, overlaps.end());
  EXPECT_NEAR(hands->depth, 0.01, 1e-9);
  EXPECT_LT((hands->place - a - Vec3(radius - 0.005, 0, 0)).norm(), 1e-9);
  const auto warnings = WarningsOf(session.posture());
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) {
    return w.find("nothing is tangled") != std::string::npos;
  }));
}

TEST(PoseWords, UnknownNamesAreCorrected) {
  const PoseState state{RestPosture(1.7, 1.8, 1), {}, {}};
  const struct {
    const char *name, *value, *expected;
  } cases[] = {{"drag", "a/left_hnad=0,1,0", "left_hand"},
               {"drag", "c/left_hand=0,1,0", "figure"},
               {"drag", "a/left_hand=0,1", "expected 3 numbers"},
               {"drag", "a/left_hand=0,x,0", "\"x\""},
               {"drag", "a/left_hand", "="},
               {"rotate", "a/left_elbw=1,2,3", "left_elbow"},
               {"pin", "left_hand", "a/left_hand"},
               {"option", "hold=on", "holds"},
               {"hold", "a/left_hand=wrld", "found \"wrld\""}};
  for (const auto& c : cases) {
    try {
      ParsePoseStep(c.name, c.value, state);
      ADD_FAILURE() << c.value;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(c.expected), std::string::npos) << error.what();
    }
  }
  const auto pin = std::get<Operation>(ParsePoseStep("pin", "b/right_foot", state));
  EXPECT_EQ(std::get<Pin>(pin).node, state.posture.body[1].FindNode("right_ankle"));
}

TEST(PoseCommand, DoesWhatIsAskedInTheOrderGivenAndAgreesWithTheSavedFile) {
  const Scratch scratch;
  const std::string out = scratch / "t.yaml";
  const std::string arguments = "pose " + kHold +
                                "/template.yaml --json --pin a/right_foot --move b=0.01,0,0 "
                                "--drag b/head=0.05,1.55,0.05 --move b=-0.02,0,0 --undo "
                                "--hold b/left_hand=b/left_hip --name made --tags one,two --out " +
                                out;
  const Outcome run = RunProgram(scratch, arguments);
  ASSERT_EQ(run.code, 0) << run.err;
  const auto queries = nlohmann::json::parse(run.out);
  EXPECT_LT(queries["solves"][0]["drag_error_m"], 0.01);
  const TemplatePosture posture = io::ReadTemplate(out);
  EXPECT_EQ(posture.name, "made");
  EXPECT_EQ(posture.keywords, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(posture.holds.size(), 2u);
  const Vec3 head =
      PoseBody(posture.body[1], posture.pose[1]).node[posture.body[1].FindNode("head")];
  EXPECT_LT((head - Vec3(0.05, 1.55, 0.05)).norm(), 0.01);  // the later move was undone

  const auto tangles = nlohmann::json::parse(RunProgram(scratch, "tangles --json " + out).out);
  ASSERT_EQ(tangles["tags"].size(), queries["tags"].size());
  EXPECT_EQ(tangles["literal"].size(), queries["literal_tangles"]);
  for (size_t k = 0; k < tangles["tags"].size(); ++k) {
    EXPECT_EQ(tangles["tags"][k]["a"], queries["tags"][k]["a"]);
    EXPECT_EQ(tangles["tags"][k]["b"], queries["tags"][k]["b"]);
    EXPECT_NEAR(tangles["tags"][k]["gli"], queries["tags"][k]["gli"].get<double>(), 1e-6);
    EXPECT_NEAR(tangles["tags"][k]["rho"], queries["tags"][k]["rho"].get<double>(), 1e-6);
  }
  const Outcome again = RunProgram(scratch, arguments);  // is there already
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(RunProgram(scratch, arguments + " --force").code, 0);

  EXPECT_EQ(RunProgram(scratch, "pose").code, 2);
  EXPECT_EQ(RunProgram(scratch, "pose --rest --undo").code, 2);
  const Outcome bad = RunProgram(scratch, "pose --rest --drag a/left_hnad=0,1,0");
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("did you mean \"left_hand\""), std::string::npos) << bad.err;
  // Out of reach: as near as may be, and said so.
  const Outcome far = RunProgram(scratch, "pose --rest --option root=off --drag a/left_hand=9,1,9");
  EXPECT_EQ(far.code, 3);
  EXPECT_NE(far.err.find("from the target"), std::string::npos) << far.err;
  const Outcome clips =
      RunProgram(scratch, "pose --from-clips " + kHold + "/a.bvh " + kHold +
                              "/b.bvh --frame 3 --swap --out " + (scratch / "c.yaml"));
  EXPECT_EQ(clips.code, 0) << clips.err;
  EXPECT_EQ(io::ReadTemplate(scratch / "c.yaml").body.size(), 2u);
}

}  // namespace
}  // namespace retarget::posing
