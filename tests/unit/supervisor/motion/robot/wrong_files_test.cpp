// Files of robots with bytes changed, cut and doubled: each is read or refused with a place, none is a crash.

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion {
namespace {

std::string damaged(const std::string& text, std::mt19937& random) {
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  std::string out = text;
  for (std::size_t times = 1 + below(4); times > 0; --times) {
    const std::size_t at = below(out.size()), most = std::min<std::size_t>(60, out.size() - at);
    switch (below(4)) {
      case 0:
        out[at] = static_cast<char>(below(256));
        break;
      case 1:
        out.erase(at, 1 + below(most));
        break;
      case 2:
        out.insert(at, out.substr(below(out.size()), 1 + below(60)));
        break;
      default:
        out.insert(at, std::array{"<", "\"", "1e999", "nan", "</robot>", "-", "left"}[below(7)]);
    }
    if (out.empty()) out = "<";
  }
  return out;
}

TEST(RobotFiles, WhenTheyAreDamaged_ThenTheyAreReadOrRefusedWithAPlace) {
  std::mt19937 random(7);
  const Robot robot = tests::two_arms();
  const std::string urdf = tests::file_text(tests::own_folder() / "two_arms.urdf");
  const std::string srdf = tests::file_text(tests::own_folder() / "two_arms.srdf");
  int refused = 0;
  for (int k = 0; k < 600; ++k) {
    if (const auto read = read_urdf(damaged(urdf, random), "r.urdf"); !read) {
      ++refused;
      for (const auto& each : read.error()) ASSERT_GT(each.where.line, 0u) << each.message;
    } else {
      for (std::size_t j = 0; j < read->joints.size(); ++j) {
        ASSERT_LE(read->joints[j].parent, static_cast<int>(j));
        ASSERT_NEAR(length(read->joints[j].axis), 1.0, 1e-12);
      }
    }
    if (const auto read = read_srdf(damaged(srdf, random), "r.srdf", robot); !read) {
      for (const auto& each : read.error()) ASSERT_GT(each.where.line, 0u) << each.message;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace stepwright::motion
