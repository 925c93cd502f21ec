#pragma once

// Arms for the tests of kinematics.

#include <sstream>

#include "supervisor/motion/kinematics/chain.h"
#include "supervisor/motion/kinematics/srs_arm.h"
#include "supervisor/motion/spatial/random.h"
#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion::tests {

inline Chain chain_of(const Robot& robot, const std::string& base, const std::string& tip) {
  auto chain = Chain::between(robot, robot.link(base), robot.link(tip));
  EXPECT_TRUE(chain) << to_string(chain.error());
  return *chain;
}

inline Chain own_arm(const std::string& side) {
  return chain_of(two_arms(), "torso", side + "_tcp");
}

// Seven joints about x, y or z ("zyzyzyz") with a place of each after the one before, and the same limits for
// all.
inline Chain seven_joints(const std::string& axes, const std::vector<Vector3>& places, double limit_rad) {
  std::ostringstream text;
  text.precision(17);
  text << "<robot name='arm'><link name='l0'/>";
  for (std::size_t k = 0; k < axes.size(); ++k)
    text << "<link name='l" << k + 1 << "'/><joint name='j" << k << "' type='revolute'><parent link='l" << k
         << "'/><child link='l" << k + 1 << "'/><origin xyz='" << places[k].x << ' ' << places[k].y << ' '
         << places[k].z << "'/><axis xyz='" << (axes[k] == 'x') << ' ' << (axes[k] == 'y') << ' '
         << (axes[k] == 'z') << "'/><limit lower='" << -limit_rad << "' upper='" << limit_rad
         << "' velocity='1'/></joint>";
  text << "<link name='tip'/><joint name='t' type='fixed'><parent link='l7'/><child link='tip'/><origin "
          "xyz='0.02 0.01 0.1' rpy='0.1 0.2 0.3'/></joint></robot>";
  const auto robot = read_urdf(text.str(), "arm.urdf");
  EXPECT_TRUE(robot) << to_string(robot.error());
  return chain_of(*robot, "l0", "tip");
}

// The elbow stands aside of the upper arm's axis and of the forearm's, as that of Barrett's WAM does.
inline Chain arm_with_elbow_aside(double limit_rad = 2.0) {
  return seven_joints("zyzyzyz", {{0, 0, 0.3}, {}, {}, {0.045, 0, 0.55}, {-0.045, 0, 0.3}, {}, {}},
                      limit_rad);
}
// A shoulder of roll, pitch and yaw: its first and third axis are at right angles at zero.
inline Chain arm_with_cardan_shoulder() {
  return seven_joints("xyzyzyx", {{0.1, 0, 0}, {}, {}, {0, 0, 0.4}, {0, 0, 0.35}, {}, {}}, 2.5);
}

inline std::array<double, 7> draw(const Chain& chain, Random& random) {
  std::array<double, 7> q{};
  for (std::size_t k = 0; k < 7; ++k) q[k] = random.between(chain.joints()[k].lower, chain.joints()[k].upper);
  return q;
}

inline double off(const Transform& a, const Transform& b) {
  return std::max(distance(a.position_m, b.position_m), angle_between(a.rotation, b.rotation));
}

}  // namespace stepwright::motion::tests
