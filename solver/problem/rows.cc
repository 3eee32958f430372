#include "solver/problem/rows.h"

#include <algorithm>

namespace retarget::solver {

void Rows::Reset(const Frame& frame, bool derivatives) {
  frame_ = &frame;
  derivatives_ = derivatives;
  residual_.clear();
  coordinates_.clear();
  anchors_.clear();
  const int n = frame.scene->num_coordinates();
  if (derivatives && jacobian_.cols() != n) jacobian_.resize(64, n);
}

int Rows::Add(double r) {
  residual_.push_back(r);
  const int row = num_rows() - 1;
  if (derivatives_) {
    if (row >= jacobian_.rows())
      jacobian_.conservativeResize(2 * jacobian_.rows(), jacobian_.cols());
    jacobian_.row(row).setZero();
  }
  return row;
}

void Rows::AddPoint(int row, int figure, int link, const Vec3& point, const Vec3& gradient) {
  if (!derivatives_) return;
  const Body& body = frame_->body(figure);
  const PosedBody& posed = frame_->posed[figure];
  double* at = jacobian_.row(row).data() + frame_->scene->FirstCoordinate(figure);
  Eigen::Map<Vec3> translation(at);
  translation += gradient;
  for (int l = link; l >= 0; l = body.links[l].parent) {
    if (body.links[l].locked) continue;
    Eigen::Map<Vec3> turn(at + 3 + 3 * l);
    turn.noalias() +=
        frame_->dexp[figure][l].transpose() * (point - posed.centre[l]).cross(gradient);
  }
}

void Rows::AddNode(int row, int figure, int node, const Vec3& gradient) {
  AddPoint(row, figure, frame_->body(figure).nodes[node].link, frame_->posed[figure].node[node],
           gradient);
}

void Rows::AddSegmentPoint(int row, int figure, int node, double share, const Vec3& gradient) {
  const int inner = frame_->body(figure).nodes[node].parent;
  if (share < 1) AddNode(row, figure, inner, (1 - share) * gradient);
  if (share > 0) AddNode(row, figure, node, share * gradient);
}

void Rows::AddTurn(int row, int figure, int link, const Vec3& gradient) {
  if (!derivatives_) return;
  const Body& body = frame_->body(figure);
  double* at = jacobian_.row(row).data() + frame_->scene->FirstCoordinate(figure);
  for (int l = link; l >= 0; l = body.links[l].parent) {
    if (body.links[l].locked) continue;
    Eigen::Map<Vec3> turn(at + 3 + 3 * l);
    turn.noalias() += frame_->dexp[figure][l].transpose() * gradient;
  }
}

void Rows::AddJointTurn(int row, int figure, int link, const Vec3& gradient) {
  if (!derivatives_ || frame_->body(figure).links[link].locked) return;
  double* at = jacobian_.row(row).data() + frame_->scene->FirstCoordinate(figure);
  Eigen::Map<Vec3> turn(at + 3 + 3 * link);
  // dexp = R_link J_r, so J_r^T g = dexp^T (R_link g).
  turn.noalias() +=
      frame_->dexp[figure][link].transpose() * (frame_->posed[figure].rotation[link] * gradient);
}

void Rows::AddAnchor(int row, int anchor, int component, double value) {
  if (derivatives_) anchors_.push_back({row, anchor, component, value});
}

void Rows::AddCoordinate(int coordinate, double r, double derivative) {
  coordinates_.push_back({coordinate, r, derivative});
}

void Rows::Scale(int rows_before, int coordinates_before, double weight) {
  for (int r = rows_before; r < num_rows(); ++r) {
    residual_[r] *= weight;
    if (derivatives_) jacobian_.row(r) *= weight;
  }
  for (size_t c = coordinates_before; c < coordinates_.size(); ++c) {
    coordinates_[c].residual *= weight;
    coordinates_[c].derivative *= weight;
  }
  for (auto entry = anchors_.rbegin(); entry != anchors_.rend() && entry->row >= rows_before;
       ++entry) {
    entry->value *= weight;
  }
}

double Rows::HalfSquares() const {
  double sum = 0;
  for (const double r : residual_) sum += r * r;
  for (const CoordinateRow& c : coordinates_) sum += c.residual * c.residual;
  return 0.5 * sum;
}

}  // namespace retarget::solver
