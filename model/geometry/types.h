// The vocabulary of geometry that everything shares. World: metres, seconds, radians, Y up,
// right-handed (as glTF).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

namespace retarget {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegree = kPi / 180.0;

// What a user can mend: a bad file, key, value or option. The message is one line and names the
// file, the line or key, what was expected and, where there is one, the nearest valid name.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace retarget
