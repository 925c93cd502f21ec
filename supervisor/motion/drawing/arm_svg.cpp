#include "supervisor/motion/drawing/arm_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "runtime/ground/markup/xml_text.h"
#include "supervisor/geometry/convex_polygon.h"
#include "supervisor/motion/kinematics/link_frames.h"

namespace stepwright::motion {

namespace {

using geometry::Point;

constexpr double kSide_px = 480.0;  // of a view
constexpr double kMargin_m = 0.15;
constexpr std::size_t kPoses = 13;   // of the arm
constexpr std::size_t kTrace = 160;  // places of the dashed line
constexpr double kFarthest_m = 4.0;  // of what is drawn from the arm

// Side: x to the right, z upwards. Top: x to the right, y upwards.
Point seen(Vector3 p, bool from_above) {
  return {p.x, from_above ? p.y : p.z};
}

struct View {
  bool from_above = false;
  double low_x = 0.0, low_y = 0.0, scale = 1.0;
  double left_px = 0.0;

  double x(Point p) const { return left_px + scale * (p.x_m - low_x); }
  double y(Point p) const { return kSide_px - scale * (p.y_m - low_y); }
};

// Corners of boxes, rings of cylinders, points of meshes; spheres are drawn as circles.
std::vector<Vector3> outline_points(const Obstacle& obstacle) {
  const Shape& shape = obstacle.shape;
  std::vector<Vector3> points;
  if (shape.kind == ShapeKind::Box) {
    for (int k = 0; k < 8; ++k)
      points.push_back({(k & 1 ? 0.5 : -0.5) * shape.size_m.x, (k & 2 ? 0.5 : -0.5) * shape.size_m.y,
                        (k & 4 ? 0.5 : -0.5) * shape.size_m.z});
  } else if (shape.kind == ShapeKind::Cylinder) {
    constexpr int kRing = 24;
    for (int k = 0; k < 2 * kRing; ++k) {
      const double turn = 2.0 * std::numbers::pi * (k / 2) / kRing;
      points.push_back({shape.radius_m * std::cos(turn), shape.radius_m * std::sin(turn),
                        (k % 2 == 0 ? 0.5 : -0.5) * shape.length_m});
    }
  } else if (obstacle.mesh) {
    points = obstacle.mesh->points;
  }
  for (Vector3& each : points) each = shape.origin * each;
  return points;
}

class ArmDrawing {
 public:
  explicit ArmDrawing(const ArmPicture& picture) : picture_(picture), kinematics_(picture.robot) {
    find_joints();
    if (picture.path.empty()) {
      poses_.push_back(joints_at({}));
      return;
    }
    for (std::size_t k = 0; k < kPoses; ++k)
      poses_.push_back(joints_at(along(static_cast<double>(k) / (kPoses - 1))));
    for (std::size_t k = 0; k < kTrace; ++k)
      trace_.push_back(joints_at(along(static_cast<double>(k) / (kTrace - 1))).back());
  }

  std::string draw() const {
    const View side = view(false, 0.0), top = view(true, kSide_px + 20.0);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} "
        "{1:.0f}\">\n<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        2.0 * kSide_px + 20.0, kSide_px + 24.0, markup::xml_escaped(picture_.title));
    svg += drawn(side, "side", "from the side: x, z") + drawn(top, "top", "from above: x, y");
    return svg + "</svg>\n";
  }

 private:
  // The links whose frames are drawn: those below joints that the path moves, and the one above the first.
  void find_joints() {
    const Robot& robot = picture_.robot;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const auto moved =
          std::find(picture_.coordinates.begin(), picture_.coordinates.end(), robot.joints[j].coordinate);
      if (robot.joints[j].coordinate < 0 || moved == picture_.coordinates.end()) continue;
      if (links_.empty()) links_.push_back(static_cast<std::size_t>(robot.joints[j].parent));
      links_.push_back(j + 1);
    }
    if (links_.empty()) links_.push_back(0);
    // And what hangs at the end without joints: the farthest tip of the hand.
    const auto last = static_cast<int>(links_.back());
    for (int link = static_cast<int>(robot.links.size()) - 1; link > last; --link)
      if (robot.hangs_below(link, last)) {
        links_.push_back(static_cast<std::size_t>(link));
        break;
      }
  }

  Configuration along(double share) const {
    const JointPath& path = picture_.path;
    double left = share * joint_length(path);
    for (std::size_t k = 1; k < path.size(); ++k) {
      const double here = joint_distance(path[k - 1], path[k]);
      if (left <= here && here > 0.0) {
        Configuration q = path[k - 1];
        for (std::size_t j = 0; j < q.size(); ++j) q[j] += left / here * (path[k][j] - path[k - 1][j]);
        return q;
      }
      left -= here;
    }
    return path.back();
  }

  std::vector<Vector3> joints_at(const Configuration& q) const {
    std::vector<double> all(picture_.rest.begin(), picture_.rest.end());
    for (std::size_t k = 0; k < q.size(); ++k) all[static_cast<std::size_t>(picture_.coordinates[k])] = q[k];
    std::vector<Transform> frames(picture_.robot.links.size());
    kinematics_.place(all, frames);
    std::vector<Vector3> points;
    for (const std::size_t link : links_) points.push_back(frames[link].position_m);
    return points;
  }

  View view(bool from_above, double left_px) const {
    Point low = seen(poses_.front().front(), from_above), high = low;
    const Point middle = low;
    const auto hold = [&](Point p, double by_m) {
      if (std::hypot(p.x_m - middle.x_m, p.y_m - middle.y_m) > kFarthest_m) return;
      low = {std::min(low.x_m, p.x_m - by_m), std::min(low.y_m, p.y_m - by_m)};
      high = {std::max(high.x_m, p.x_m + by_m), std::max(high.y_m, p.y_m + by_m)};
    };
    for (const auto& pose : poses_)
      for (const Vector3& each : pose) hold(seen(each, from_above), 0.0);
    for (const Obstacle& each : picture_.world.obstacles) {
      if (each.shape.kind == ShapeKind::Sphere)
        hold(seen(each.shape.origin.position_m, from_above), each.shape.radius_m);
      for (const Vector3& point : outline_points(each)) hold(seen(point, from_above), 0.0);
    }
    View view;
    view.from_above = from_above;
    view.left_px = left_px;
    const double wide_m = std::max(high.x_m - low.x_m, high.y_m - low.y_m) + 2.0 * kMargin_m;
    view.scale = kSide_px / wide_m;
    view.low_x = 0.5 * (low.x_m + high.x_m) - 0.5 * wide_m;
    view.low_y = 0.5 * (low.y_m + high.y_m) - 0.5 * wide_m;
    return view;
  }

  std::string drawn(const View& view, const char* name, const char* words) const {
    std::string text = fmt::format(
        "<svg x=\"{0:.1f}\" y=\"0\" width=\"{1:.1f}\" height=\"{2:.1f}\" class=\"{3}\">\n"
        "<rect width=\"{1:.1f}\" height=\"{1:.1f}\" fill=\"none\" stroke=\"#999\"/>\n",
        view.left_px, kSide_px, kSide_px + 24.0, name);
    View inner = view;
    inner.left_px = 0.0;
    text += fmt::format("<clipPath id=\"{0}\"><rect width=\"{1:.1f}\" height=\"{1:.1f}\"/></clipPath>\n",
                        name, kSide_px);
    text += fmt::format("<g clip-path=\"url(#{})\">\n", name);
    for (const Obstacle& each : picture_.world.obstacles) text += obstacle(inner, each);
    for (std::size_t k = 0; k < poses_.size(); ++k) text += pose(inner, k);
    if (!trace_.empty())
      text += fmt::format(
          "<polyline class=\"tip\" points=\"{}\" fill=\"none\" stroke=\"#444\" stroke-dasharray=\"4 3\"/>\n",
          points_of(inner, trace_));
    return text + fmt::format(
                      "</g>\n<text x=\"6\" y=\"{:.0f}\" font-size=\"13\" "
                      "font-family=\"sans-serif\">{}</text>\n</svg>\n",
                      kSide_px + 16.0, words);
  }

  static std::string points_of(const View& view, const std::vector<Vector3>& points) {
    std::string text;
    for (const Vector3& each : points) {
      const Point p = seen(each, view.from_above);
      text += fmt::format("{:.1f},{:.1f} ", view.x(p), view.y(p));
    }
    return text;
  }

  static std::string obstacle(const View& view, const Obstacle& obstacle) {
    const std::string title = "<title>" + markup::xml_escaped(obstacle.name) + "</title>";
    constexpr const char* kStyle = "fill=\"#c9b48a\" fill-opacity=\"0.35\" stroke=\"#7a6a45\"";
    if (obstacle.shape.kind == ShapeKind::Sphere) {
      const Point at = seen(obstacle.shape.origin.position_m, view.from_above);
      return fmt::format(
          "<circle class=\"obstacle\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}>{}</circle>\n", view.x(at),
          view.y(at), view.scale * obstacle.shape.radius_m, kStyle, title);
    }
    std::vector<Point> points;
    for (const Vector3& each : outline_points(obstacle)) points.push_back(seen(each, view.from_above));
    const auto hull = geometry::ConvexPolygon::hull(points);
    if (!hull) return {};
    std::string corners;
    for (const Point& each : hull->corners())
      corners += fmt::format("{:.1f},{:.1f} ", view.x(each), view.y(each));
    return fmt::format("<polygon class=\"obstacle\" points=\"{}\" {}>{}</polygon>\n", corners, kStyle, title);
  }

  // From green over grey to red.
  std::string pose(const View& view, std::size_t k) const {
    const bool first = k == 0, last = k + 1 == poses_.size();
    return fmt::format(
        "<polyline class=\"arm\" points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-opacity=\"{}\" "
        "stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n",
        points_of(view, poses_[k]),
        first  ? "#2a8f3c"
        : last ? "#c0392b"
               : "#4a6fa5",
        first || last ? 1 : 0.4, first || last ? 4 : 2);
  }

  const ArmPicture& picture_;
  LinkFrames kinematics_;
  std::vector<std::size_t> links_;
  std::vector<std::vector<Vector3>> poses_;
  std::vector<Vector3> trace_;
};

}  // namespace

std::string arm_svg(const ArmPicture& picture) {
  return ArmDrawing(picture).draw();
}

}  // namespace stepwright::motion
