// Rows of the residual vector of one frame, with their derivatives. A term says only how a residual
// changes with a point, a turn or a coordinate; the chain rule through the skeleton is written
// here, once.
#pragma once

#include <vector>

#include "model/geometry/types.h"
#include "solver/problem/frame.h"

namespace retarget::solver {

class Rows {
 public:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // A row that reads one coordinate only: the bulk of the rows (tracking), kept apart because their
  // normal equations are diagonal.
  struct CoordinateRow {
    int coordinate;
    double residual;
    double derivative;
  };
  struct AnchorEntry {
    int row;
    int anchor;     // column of Unknowns::anchor
    int component;  // 0: x, 1: z
    double value;
  };

  // Empties the rows for a frame. Without `derivatives` only residuals are kept.
  void Reset(const Frame& frame, bool derivatives);

  // Adds a row of residual r (natural unit) and returns its index.
  int Add(double r);
  // d r += gradient . d point, for a world point carried by `link` of `figure`.
  void AddPoint(int row, int figure, int link, const Vec3& point, const Vec3& gradient);
  // The same for a node.
  void AddNode(int row, int figure, int node, const Vec3& gradient);
  // The same for the point at a share of the segment that ends at a node: it moves with both ends.
  void AddSegmentPoint(int row, int figure, int node, double share, const Vec3& gradient);
  // d r += gradient . d omega, for a turn d omega (rad, world axes) of `link` with all it hangs on.
  void AddTurn(int row, int figure, int link, const Vec3& gradient);
  // d r += gradient . d omega, for a turn of the joint alone, in the link's own axes
  // (R -> R exp d omega).
  void AddJointTurn(int row, int figure, int link, const Vec3& gradient);
  // The entries of a row are added together, before the next row's.
  void AddAnchor(int row, int anchor, int component, double value);
  void AddCoordinate(int coordinate, double r, double derivative);

  // Multiplies what has been added since `rows_before` and `coordinates_before` by a weight.
  void Scale(int rows_before, int coordinates_before, double weight);

  int num_rows() const { return static_cast<int>(residual_.size()); }
  const std::vector<double>& residual() const { return residual_; }
  // [num_rows x coordinates of the frame]
  auto jacobian() const { return jacobian_.topRows(num_rows()); }
  const std::vector<CoordinateRow>& coordinates() const { return coordinates_; }
  const std::vector<AnchorEntry>& anchors() const { return anchors_; }
  bool derivatives() const { return derivatives_; }
  // Half the sum of squares of all residuals.
  double HalfSquares() const;

 private:
  const Frame* frame_ = nullptr;
  bool derivatives_ = false;
  std::vector<double> residual_;
  RowMatrix jacobian_;  // grows by doubling
  std::vector<CoordinateRow> coordinates_;
  std::vector<AnchorEntry> anchors_;
};

}  // namespace retarget::solver
