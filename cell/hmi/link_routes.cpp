#include "cell/hmi/link_routes.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

namespace stepwright::hmi {
namespace {

constexpr double kStubPitch = 11.0;  // between two lines that end at the same side of a box
constexpr double kTrackPitch = 9.0;
constexpr double kTrackMargin = 20.0;  // beside the tracks between two columns
constexpr double kLaneMargin = 14.0;   // likewise between two rows

// A line from one place between columns to another: with one vertical part, or with two and a lane.
struct RoutedLink {
  std::uint32_t from_column = 0, from_row = 0, to_column = 0, to_row = 0;
  std::uint32_t lane = 0;  // below this row, if it leads past others

  bool adjacent() const { return to_column == from_column + 1; }
  bool straight() const { return adjacent() && from_row == to_row; }
  std::uint32_t exit() const { return from_column + 1; }  // channel k is left of column k
  std::uint32_t entry() const { return to_column; }
};

// The end of a line at a box: of several in one row of one channel, those that lead up come first.
struct Stub {
  double towards = 0.0;  // the row that it comes from or goes to
  std::size_t link = 0;
  bool out = false;
};

// A vertical part: from the y at its left to that at its right.
struct Riser {
  std::size_t link = 0;
  bool out = false;
  double left_y = 0.0, right_y = 0.0;
};

class Router {
 public:
  Router(const components::Layout& layout, const std::vector<components::ModelLink>& links,
         const BoxSizes& sizes)
      : sizes_(sizes), columns_(layout.columns), rows_(layout.rows) {
    for (const components::ModelLink& link : links)
      links_.push_back(link_of(layout.placed[link.from], layout.placed[link.to]));
  }

  LinkRoutes run() {
    gather_stubs();
    place_rows();
    place_stubs();
    place_columns();
    for (std::size_t i = 0; i < links_.size(); ++i) routes_.ways.push_back(way_of(i));
    return std::move(routes_);
  }

 private:
  static RoutedLink link_of(const components::Placed& from, const components::Placed& to) {
    RoutedLink link{from.column, from.row, to.column, to.row, std::max(from.row, to.row)};
    if (to.column > from.column) link.lane = to.row < from.row ? from.row - 1 : from.row;
    return link;
  }

  std::vector<Stub>& stubs_at(std::uint32_t channel, std::uint32_t row) {
    return stubs_[channel * rows_ + row];
  }

  void gather_stubs() {
    stubs_.resize((columns_ + 1) * rows_);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const RoutedLink& link = links_[i];
      const double past = link.lane + 0.5;
      stubs_at(link.exit(), link.from_row).push_back({link.adjacent() ? link.to_row : past, i, true});
      if (!link.straight())
        stubs_at(link.entry(), link.to_row).push_back({link.adjacent() ? link.from_row : past, i, false});
    }
    for (auto& stubs : stubs_)
      std::ranges::stable_sort(stubs, {}, [](const Stub& stub) { return stub.towards; });
  }

  void place_rows() {
    std::vector<std::size_t> in_lane(rows_, 0);
    lane_track_.resize(links_.size());
    for (std::size_t i = 0; i < links_.size(); ++i)
      if (!links_[i].adjacent()) lane_track_[i] = in_lane[links_[i].lane]++;
    double y = sizes_.edge;
    for (std::uint32_t row = 0; row < rows_; ++row) {
      double height = sizes_.row_height[row];
      for (std::uint32_t channel = 0; channel <= columns_; ++channel)
        height = std::max(height, kStubPitch * static_cast<double>(stubs_at(channel, row).size() + 1));
      routes_.top.push_back(y);
      routes_.height.push_back(height);
      y += height + 2.0 * kLaneMargin + kTrackPitch * static_cast<double>(in_lane[row]);
    }
    routes_.whole = y + sizes_.edge - kLaneMargin;
  }

  void place_stubs() {
    out_y_.resize(links_.size());
    in_y_.resize(links_.size());
    for (std::uint32_t channel = 0; channel <= columns_; ++channel)
      for (std::uint32_t row = 0; row < rows_; ++row) {
        const auto& stubs = stubs_at(channel, row);
        for (std::size_t k = 0; k < stubs.size(); ++k) {
          const double y = routes_.top[row] + routes_.height[row] * static_cast<double>(k + 1) /
                                                  static_cast<double>(stubs.size() + 1);
          (stubs[k].out ? out_y_ : in_y_)[stubs[k].link] = y;
          if (links_[stubs[k].link].straight()) in_y_[stubs[k].link] = y;
        }
      }
  }

  double lane_y(std::size_t i) const {
    const std::uint32_t row = links_[i].lane;
    return routes_.top[row] + routes_.height[row] + kLaneMargin +
           kTrackPitch * (0.5 + static_cast<double>(lane_track_[i]));
  }

  std::vector<Riser> risers_of(std::uint32_t channel) const {
    std::vector<Riser> risers;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const RoutedLink& link = links_[i];
      if (link.straight()) continue;
      if (link.adjacent() && link.exit() == channel) risers.push_back({i, true, out_y_[i], in_y_[i]});
      if (link.adjacent()) continue;
      if (link.exit() == channel) risers.push_back({i, true, out_y_[i], lane_y(i)});
      if (link.entry() == channel) risers.push_back({i, false, lane_y(i), in_y_[i]});
    }
    // So that fewer lines cross: what rises from below turns last, what falls from above, too.
    std::ranges::sort(risers, {}, [](const Riser& riser) {
      const bool up = riser.right_y < riser.left_y;
      return std::tuple(!up, up ? riser.left_y : -riser.left_y, riser.link);
    });
    return risers;
  }

  void place_columns() {
    out_x_.resize(links_.size());
    in_x_.resize(links_.size());
    double x = sizes_.edge;
    for (std::uint32_t channel = 0; channel <= columns_; ++channel) {
      const std::vector<Riser> risers = risers_of(channel);
      for (std::size_t k = 0; k < risers.size(); ++k)
        (risers[k].out ? out_x_ : in_x_)[risers[k].link] =
            x + kTrackMargin + kTrackPitch * static_cast<double>(k);
      const bool outside = channel == 0 || channel == columns_;
      if (!outside || !risers.empty())
        x += 2.0 * kTrackMargin +
             kTrackPitch * static_cast<double>(std::max<std::size_t>(risers.size(), 1) - 1);
      if (channel == columns_) break;
      routes_.left.push_back(x);
      x += sizes_.box_width;
    }
    routes_.width = x + sizes_.edge;
  }

  std::vector<Corner> way_of(std::size_t i) const {
    const RoutedLink& link = links_[i];
    const double begin = routes_.left[link.from_column] + sizes_.box_width;
    const double end = routes_.left[link.to_column];
    if (link.straight()) return {{begin, out_y_[i]}, {end, in_y_[i]}};
    std::vector<Corner> way = {{begin, out_y_[i]}, {out_x_[i], out_y_[i]}};
    if (!link.adjacent()) {
      way.push_back({out_x_[i], lane_y(i)});
      way.push_back({in_x_[i], lane_y(i)});
    }
    way.push_back({way.back().x, in_y_[i]});
    way.push_back({end, in_y_[i]});
    return way;
  }

  const BoxSizes& sizes_;
  std::uint32_t columns_, rows_;
  std::vector<RoutedLink> links_;
  std::vector<std::vector<Stub>> stubs_;  // by channel and row
  std::vector<std::size_t> lane_track_;   // by link, of those that lead past others
  std::vector<double> out_y_, in_y_;      // by link, at the boxes
  std::vector<double> out_x_, in_x_;      // by link, of the vertical parts
  LinkRoutes routes_;
};

}  // namespace

LinkRoutes route_links(const components::Layout& layout, const std::vector<components::ModelLink>& links,
                       const BoxSizes& sizes) {
  return Router(layout, links, sizes).run();
}

}  // namespace stepwright::hmi
