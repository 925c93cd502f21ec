#include "supervisor/motion/blend/blended_path.h"

#include <algorithm>
#include <utility>

#include "supervisor/motion/blend/rounding.h"

namespace stepwright::motion {

BlendedPath::BlendedPath(JointPath points, std::vector<double> half_widths)
    : points_(std::move(points)), half_widths_(std::move(half_widths)) {
  places_.push_back(0.0);
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const double far = joint_distance(points_[k - 1], points_[k]);
    Configuration direction(points_[k].size());
    for (std::size_t j = 0; j < direction.size(); ++j)
      direction[j] = (points_[k][j] - points_[k - 1][j]) / far;
    directions_.push_back(std::move(direction));
    places_.push_back(places_.back() + far);
  }
  // A straight part between blends that touch is shorter than rounding errors, and left out.
  const double least = 1e-13 * places_.back();
  double begin = 0.0;
  const auto add = [&](std::size_t point, bool is_blend, double end) {
    if (end - begin <= least) return;
    pieces_.push_back({point, is_blend, begin, end, places_[point], is_blend ? half_widths_[point] : 0.0});
    begin = end;
  };
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    if (half_widths_[k] > 0.0) add(k, true, places_[k] + half_widths_[k]);
    add(k, false, places_[k + 1] - half_widths_[k + 1]);
  }
  pieces_.back().end = places_.back();
}

void BlendedPath::at(double s, std::span<double> out, int derivative) const {
  s = std::clamp(s, 0.0, length());
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), s,
                                      [](double value, const PathPiece& piece) { return value < piece.end; });
  at(after == pieces_.end() ? pieces_.back() : *after, s, out, derivative);
}

void BlendedPath::at(const PathPiece& piece, double s, std::span<double> out, int derivative) const {
  const double along = s - piece.place;
  const Rounding round = piece.is_blend ? rounding(along, piece.half_width) : Rounding{};
  const Configuration& origin = points_[piece.point];
  for (std::size_t j = 0; j < out.size(); ++j) {
    const double slope = before(piece, j), bend = turn(piece, j);
    out[j] = derivative == 0   ? origin[j] + slope * along + bend * round.value
             : derivative == 1 ? slope + bend * round.first
             : derivative == 2 ? bend * round.second
                               : bend * round.third;
  }
}

}  // namespace stepwright::motion
