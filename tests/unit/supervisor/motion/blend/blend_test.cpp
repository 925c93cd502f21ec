#include "supervisor/motion/blend/blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "supervisor/motion/blend/codes.h"
#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {
namespace {

JointPath random_path(Random& random, std::size_t points, std::size_t joints) {
  JointPath path;
  for (std::size_t k = 0; k < points; ++k) {
    path.emplace_back();
    for (std::size_t j = 0; j < joints; ++j) path.back().push_back(random.between(-2.0, 2.0));
  }
  return path;
}

Configuration at(const BlendedPath& path, double s, int derivative = 0) {
  Configuration q(path.joints());
  path.at(s, q, derivative);
  return q;
}

// Of a joint from the polyline at the same s.
double off_polyline(const BlendedPath& path, double s) {
  const auto& places = path.places();
  std::size_t k = 0;
  while (k + 2 < places.size() && s > places[k + 1]) ++k;
  const double share = (s - places[k]) / (places[k + 1] - places[k]);
  const Configuration q = at(path, s);
  double most = 0.0;
  for (std::size_t j = 0; j < q.size(); ++j)
    most = std::max(
        most, std::abs(q[j] - path.points()[k][j] - share * (path.points()[k + 1][j] - path.points()[k][j])));
  return most;
}

TEST(Blend, WhenPathsAreRandom_ThenTheyStayWithinTheToleranceAndAreSmooth) {
  Random random(1);
  for (int round = 0; round < 60; ++round) {
    const double tolerance = random.between(0.001, 0.3);
    const JointPath points = random_path(random, 2 + random.below(9), 1 + random.below(14));
    const auto path = blend(points, {.tolerance = tolerance});
    ASSERT_TRUE(path) << to_string(path.error());
    EXPECT_LT(joint_distance(at(*path, 0.0), points.front()), 1e-12);
    EXPECT_LT(joint_distance(at(*path, path->length()), points.back()), 1e-12);
    double end = 0.0;
    for (const PathPiece& piece : path->pieces()) {
      EXPECT_EQ(piece.begin, end);
      EXPECT_GT(piece.length(), 0.0);
      end = piece.end;
      for (int k = 0; k < 8; ++k) {
        const double s = piece.begin + piece.length() * random.between(0.01, 0.99);
        EXPECT_LE(off_polyline(*path, s), tolerance + 1e-12);
        // Each derivative is the difference quotient of the one before, which are those of a polynomial.
        const double h = 1e-3 * piece.length();
        for (int order = 1; order <= 3; ++order) {
          const Configuration above = at(*path, std::min(s + h, piece.end - 1e-9 * h), order - 1),
                              below = at(*path, std::max(s - h, piece.begin + 1e-9 * h), order - 1);
          const double between =
              std::min(s + h, piece.end - 1e-9 * h) - std::max(s - h, piece.begin + 1e-9 * h);
          const Configuration slope = at(*path, s, order);
          for (std::size_t j = 0; j < slope.size(); ++j)
            ASSERT_NEAR((above[j] - below[j]) / between, slope[j],
                        2e-3 * (1.0 + (piece.is_blend ? std::pow(piece.half_width, 1 - order) : 0.0)));
        }
      }
    }
    EXPECT_EQ(end, path->length());
    // Position, slope and curvature go on where pieces meet, but for stops.
    for (std::size_t k = 1; k < path->pieces().size(); ++k) {
      const PathPiece &left = path->pieces()[k - 1], &right = path->pieces()[k];
      if (!left.is_blend && !right.is_blend) continue;
      for (int order = 0; order <= 2; ++order) {
        Configuration a(path->joints()), b(path->joints());
        path->at(left, left.end, a, order);
        path->at(right, right.begin, b, order);
        EXPECT_LT(joint_distance(a, b), 1e-9);
      }
    }
  }
}

TEST(Blend, WhenTheCheckRefuses_ThenTheToleranceIsHalvedAndAtLastTheArmStops) {
  const JointPath points{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}};
  const double wide = blend(points, {.tolerance = 0.08})->half_widths()[1];
  int asked = 0;
  const auto path = blend(points, {.tolerance = 0.08}, [&](const JointPath& chords) {
    ++asked;
    EXPECT_EQ(chords.size(), 17U);
    // The second corner is never free; the first one is where the way cuts it by less than 0.03.
    return chords.back()[1] < 0.9 && chords[8][0] > 0.97;
  });
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->half_widths()[1], wide / 4.0, 1e-12);
  EXPECT_EQ(path->half_widths()[2], 0.0);
  EXPECT_EQ(asked, 3 + 7);
  EXPECT_LT(joint_distance(at(*path, path->places()[2]), points[2]), 1e-12);
}

TEST(Blend, WhenThePathTurnsRound_ThenTheArmStopsThere) {
  const auto path = blend({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.001}});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->half_widths()[1], 0.0);
}

TEST(Blend, WhenInputIsWrong_ThenItIsSaidWhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  const auto refused = [](const JointPath& points, const char* code, const char* words,
                          BlendOptions options = {}) {
    const auto path = blend(points, options);
    ASSERT_FALSE(path);
    EXPECT_EQ(path.error().front().code, code);
    EXPECT_NE(path.error().front().message.find(words), std::string::npos) << path.error().front().message;
  };
  refused({}, code::kShortPath, "has 0");
  refused({{0.0}}, code::kShortPath, "has 1");
  refused(JointPath(1001, {0.0}), code::kShortPath, "1001");
  refused({{}, {}}, code::kShortPath, "0");
  refused({Configuration(15), Configuration(15)}, code::kShortPath, "15");
  refused({{0.0, 1.0}, {1.0}}, code::kJointCount, "way-point 2");
  refused({{0.0, 1.0}, {1.0, nan}}, code::kNotFinite, "way-point 2, joint 2");
  refused({{far, 1.0}, {1.0, 0.0}}, code::kNotFinite, "way-point 1, joint 1");
  refused({{0.0}, {1.0}, {1.0}}, code::kRepeated, "way-point 3");
  refused({{0.0}, {1.0}}, code::kBadLimit, "tolerance", {.tolerance = nan});
  refused({{0.0}, {1.0}}, code::kBadLimit, "tolerance", {.tolerance = -1.0});
  refused({{0.0}, {1.0}}, code::kBadLimit, "chords", {.chords = 0});
}

}  // namespace
}  // namespace stepwright::motion
