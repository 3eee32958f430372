// Rows of tools/posing/operation_table.h: posing by the solver.
#include "tools/posing/fields.h"

namespace retarget::posing {
namespace {

using Parser = ArgumentParser;

// F/NODE=ox,oy,oz,dx,dy,dz.
template <typename Make>
Operation OnRay(const Parser& p, Make make) {
  const auto [node, numbers] = p.Pair();
  const auto at = p.NodeAt(node);
  const std::vector<double> x = Parser::Numbers(numbers, {6});
  return make(at, PinRay{Parser::VectorAt(x, 0), Parser::VectorAt(x, 3)});
}

Field<Pin> Ray() {
  return OptionalWhere<Pin>(
      [](const Pin& op) { return op.ray.has_value(); },
      FieldOf<Pin>(
          "ray", "Ray",
          [](const io::Value& v, const TemplatePosture&, Pin* out) {
            v.CheckKeys({"origin", "direction"});
            out->ray = PinRay{v.Require("origin").Vector(io::kMaxPosition),
                              v.Require("direction").Vector(io::kMaxPosition)};
          },
          [](const Pin& op, const TemplatePosture&) { return RayJson(*op.ray); }));
}

std::vector<std::pair<std::string, bool PoseOptions::*>> OptionChoices() {
  std::vector<std::pair<std::string, bool PoseOptions::*>> choices;
  for (const SolveOption& option : kSolveOptions) choices.emplace_back(option.name, option.on);
  return choices;
}

std::vector<std::string> OptionNames() {
  std::vector<std::string> names;
  for (const SolveOption& option : kSolveOptions) names.push_back(option.name);
  return names;
}

std::string OptionList() {
  std::string list;
  for (const SolveOption& option : kSolveOptions) {
    list += (list.empty() ? "" : ", ") + std::string(option.name);
  }
  return list;
}

}  // namespace

std::array<OperationRow, 6> SolverRows() {
  return {
      Row<Drag>("drag", "drag",
                {Figure<Drag>(), Node<Drag>(), Vector("target", &Drag::target), Gesture<Drag>()},
                {{"drag", "F/NODE=x,y,z", "pull a node to a place (m)",
                  [](const Parser& p) -> Operation {
                    const auto [node, place] = p.Pair();
                    const auto at = p.NodeAt(node);
                    return Drag{at.figure, at.index, Parser::Vector(place)};
                  }}}),
      Row<DragRay>(
          "drag_ray", "drag",
          {Figure<DragRay>(), Node<DragRay>(), Vector("origin", &DragRay::origin),
           Vector("direction", &DragRay::direction), Gesture<DragRay>()},
          {{"drag-ray", "F/NODE=ox,oy,oz,dx,dy,dz", "pull a node onto a line: origin, direction",
            [](const Parser& p) {
              return OnRay(p, [](const auto& at, const PinRay& ray) -> Operation {
                return DragRay{at.figure, at.index, ray.origin, ray.direction};
              });
            }}}),
      Row<Settle>("settle", "settle", {},
                  {{"settle", "", "restore holds, limits and distances",
                    [](const Parser&) -> Operation { return Settle{}; }}}),
      Row<Pin>("pin", "pin", {Figure<Pin>(), Node<Pin>(), Ray()},
               {{"pin", "F/NODE", "drags leave the node where it is",
                 [](const Parser& p) -> Operation {
                   const auto at = p.NodeAt(p.value());
                   return Pin{at.figure, at.index, std::nullopt};
                 }},
                {"pin-ray", "F/NODE=ox,oy,oz,dx,dy,dz", "drags keep the node on a line",
                 [](const Parser& p) {
                   return OnRay(p, [](const auto& at, const PinRay& ray) -> Operation {
                     return Pin{at.figure, at.index, ray};
                   });
                 }}}),
      Row<Unpin>("unpin", "unpin", {Figure<Unpin>(), Node<Unpin>()},
                 {{"unpin", "F/NODE", "let go of a pinned node",
                   [](const Parser& p) -> Operation {
                     const auto at = p.NodeAt(p.value());
                     return Unpin{at.figure, at.index};
                   }}}),
      Row<SetOption>("set_option", "option",
                     {Choice("option", &SetOption::option, OptionChoices(), "OptionName"),
                      Bool("on", &SetOption::on)},
                     {{"option", "NAME=on|off", "part of the solve: " + OptionList(),
                       [](const Parser& p) -> Operation {
                         const auto [name, on] = p.Pair();
                         const int k = Parser::Named(name, "option", OptionNames());
                         return SetOption{kSolveOptions[k].on,
                                          Parser::Named(on, "setting", {"off", "on"}) == 1};
                       }}}),
  };
}

}  // namespace retarget::posing
