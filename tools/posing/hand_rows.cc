// Rows of tools/posing/operation_table.h: posing by hand.
#include "tools/posing/fields.h"

namespace retarget::posing {
namespace {

using Parser = ArgumentParser;

// A rotation vector in degrees.
Field<SetJoint> JointVector() {
  return FieldOf<SetJoint>(
      "rotation_vector", "Vec",
      [](const io::Value& v, const TemplatePosture&, SetJoint* out) {
        out->rotation = DegreesOf(v);
      },
      [](const SetJoint& op, const TemplatePosture&) { return DegreesJson(op.rotation); });
}
Field<SetRoot> RootVector() {
  return OptionalWhere<SetRoot>(
      [](const SetRoot& op) { return op.rotation.has_value(); },
      FieldOf<SetRoot>(
          "rotation_vector", "Vec",
          [](const io::Value& v, const TemplatePosture&, SetRoot* out) {
            out->rotation = DegreesOf(v);
          },
          [](const SetRoot& op, const TemplatePosture&) { return DegreesJson(*op.rotation); }));
}

Field<SetStature> Stature() {
  return FieldOf<SetStature>(
      "stature", "number",
      [](const io::Value& v, const TemplatePosture&, SetStature* out) {
        out->stature = v.Number(0.5, 3);
      },
      [](const SetStature& op, const TemplatePosture&) { return report::Json(op.stature); });
}

Operation Turned(const Parser& p) {
  const auto [figure, numbers] = p.Pair();
  const std::vector<double> x = Parser::Numbers(numbers, {1, 3});
  return TurnFigure{p.Figure(figure),
                    Parser::Rotation(x.size() == 1 ? Vec3(0, x[0], 0) : Parser::VectorAt(x, 0))};
}

Operation Rotated(const Parser& p) {
  auto [joint, numbers] = p.Pair();
  const auto at = p.LinkAt(joint);
  const bool world = numbers.ends_with(",world");
  if (world) numbers.resize(numbers.size() - 6);
  return RotateJoint{at.figure, at.index, Parser::Rotation(Parser::Vector(numbers)), world};
}

Operation RootAt(const Parser& p) {
  const auto [figure, numbers] = p.Pair();
  const std::vector<double> x = Parser::Numbers(numbers, {3, 6});
  SetRoot root{p.Figure(figure), Parser::VectorAt(x, 0)};
  if (x.size() == 6) root.rotation = Parser::Rotation(Parser::VectorAt(x, 3));
  return root;
}

// Of a figure or of one joint.
Operation Reset(const Parser& p) {
  if (p.value().find('/') == std::string::npos) return ResetFigure{p.Figure(p.value())};
  const auto at = p.LinkAt(p.value());
  return ResetJoint{at.figure, at.index};
}

}  // namespace

std::array<OperationRow, 11> HandRows() {
  return {
      Row<MoveFigure>(
          "move_figure", "move",
          {Figure<MoveFigure>(), Vector("shift", &MoveFigure::shift), Gesture<MoveFigure>()},
          {{"move", "F=x,y,z", "shift a figure (m)",
            [](const Parser& p) -> Operation {
              const auto [figure, shift] = p.Pair();
              return MoveFigure{p.Figure(figure), Parser::Vector(shift)};
            }}}),
      Row<TurnFigure>(
          "turn_figure", "turn",
          {Figure<TurnFigure>(), Quaternion(&TurnFigure::rotation), Gesture<TurnFigure>()},
          {{"turn", "F=yaw|x,y,z", "turn a figure about its root: yaw or rotation vector (degrees)",
            Turned}}),
      Row<RotateJoint>(
          "rotate_joint", "turn",
          {Figure<RotateJoint>(), Joint<RotateJoint>(), Quaternion(&RotateJoint::rotation),
           Optional(Bool("world", &RotateJoint::world)), Gesture<RotateJoint>()},
          {{"rotate", "F/JOINT=x,y,z[,world]",
            "turn a joint in its own axes or the world's: rotation vector (degrees)", Rotated}}),
      Row<SetJoint>(
          "set_joint", "turn",
          {Figure<SetJoint>(), Joint<SetJoint>(), JointVector(), Gesture<SetJoint>()},
          {{"set-joint", "F/JOINT=x,y,z", "turn a joint to this rotation vector (degrees)",
            [](const Parser& p) -> Operation {
              const auto [joint, degrees] = p.Pair();
              const auto at = p.LinkAt(joint);
              return SetJoint{at.figure, at.index, Parser::Rotation(Parser::Vector(degrees))};
            }}}),
      Row<SetRoot>("set_root", "move",
                   {Figure<SetRoot>(), Vector("position", &SetRoot::position), RootVector(),
                    Gesture<SetRoot>()},
                   {{"root", "F=x,y,z[,rx,ry,rz]", "place a root (m, degrees)", RootAt}}),
      Row<SetStature>("set_stature", "stature", {Figure<SetStature>(), Stature()},
                      {{"stature", "F=m", "scale a figure to this height",
                        [](const Parser& p) -> Operation {
                          const auto [figure, stature] = p.Pair();
                          return SetStature{p.Figure(figure), Parser::Numbers(stature, {1})[0]};
                        }}}),
      Row<Mirror>(
          "mirror", "mirror",
          {Choice<Mirror, int>("figure", &Mirror::figure, {{"a", 0}, {"b", 1}, {"both", kBoth}},
                               "FigureName | \"both\"")},
          {{"mirror", "a|b|both", "exchange left and right of a figure, or mirror the scene",
            [](const Parser& p) -> Operation {
              const int figure = Parser::Named(p.value(), "figure", {"a", "b", "both"});
              return Mirror{figure == 2 ? kBoth : figure};
            }}}),
      Row<SwapFigures>("swap_figures", "exchange of a and b", {},
                       {{"swap", "", "a becomes b and b becomes a",
                         [](const Parser&) -> Operation { return SwapFigures{}; }}}),
      Row<CopySide>(
          "copy_side", "copy of a side",
          {Figure<CopySide>(), Choice<CopySide, bool>("from", &CopySide::from_left,
                                                      {{"left", true}, {"right", false}})},
          {{"copy-side", "F=left|right", "mirror this side's joints onto the other",
            [](const Parser& p) -> Operation {
              const auto [figure, side] = p.Pair();
              return CopySide{p.Figure(figure),
                              Parser::Named(side, "side", {"left", "right"}) == 0};
            }}}),
      // Its option is that of the figure.
      Row<ResetJoint>("reset_joint", "reset", {Figure<ResetJoint>(), Joint<ResetJoint>()}, {}),
      Row<ResetFigure>("reset_figure", "reset", {Figure<ResetFigure>()},
                       {{"reset", "F|F/JOINT",
                         "T-pose of a figure, upright on the floor; or of one joint", Reset}}),
  };
}

}  // namespace retarget::posing
