#include "supervisor/tamp/intervals/network/spot_filter.h"

#include <algorithm>

namespace stepwright::tamp {
namespace {

constexpr std::size_t kManyCells = 1'000;

}  // namespace

void SpotFilter::begin(const Box& box) {
  box_ = box;
  objects_.clear();
  visits_.clear();
}

std::size_t SpotFilter::add_object(const ArcSet& angles) {
  objects_.push_back({angles, {}, {}});
  return objects_.size() - 1;
}

std::size_t SpotFilter::add_visit(const SpotVisit& visit, const ArcSet& hand) {
  visits_.push_back({visit, hand, {}, {}});
  return visits_.size() - 1;
}

// No grid says anything of what lies outside of all reach.
Box SpotFilter::within_reach() const {
  Box box = box_;
  for (const Visit& visit : visits_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Span extent = visit.what.reach->grid().extent(axis);
      const std::int64_t rise = axis == 2 ? visit.what.rise_nm : 0;
      const std::int64_t radius = axis == 2 ? 0 : visit.what.radius_nm;
      box[axis] = intersection_of(box[axis], {extent.low_nm - rise - radius, extent.high_nm - rise + radius});
    }
  }
  return box;
}

// Slices within each of which every visit has the same row of cells.
void SpotFilter::cut(std::size_t axis, Span span) {
  slices_[axis].clear();
  rows_[axis].clear();
  for (std::int64_t low = span.low_nm; low <= span.high_nm;) {
    std::int64_t high = span.high_nm;
    for (const Visit& visit : visits_) {
      const ReachGrid& grid = visit.what.reach->grid();
      const std::int64_t rise = axis == 2 ? visit.what.rise_nm : 0;
      high = std::min(high, grid.span(axis, grid.row(axis, low + rise)).high_nm - rise);
    }
    for (const Visit& visit : visits_) {
      const ReachGrid& grid = visit.what.reach->grid();
      const std::int64_t rise = axis == 2 ? visit.what.rise_nm : 0;
      const std::int64_t radius = axis == 2 ? 0 : visit.what.radius_nm;
      const std::int64_t first = std::max<std::int64_t>(grid.row(axis, low + rise - radius), 0);
      const std::int64_t last =
          std::min<std::int64_t>(grid.row(axis, high + rise + radius), grid.cells[axis] - 1);
      rows_[axis].push_back({static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)});
    }
    slices_[axis].push_back({low, high});
    low = high + 1;
  }
}

bool SpotFilter::reaches(std::size_t x, std::size_t y, std::size_t z) {
  for (Object& object : objects_) object.here = object.angles;
  for (std::size_t v = 0; v < visits_.size(); ++v) {
    Visit& visit = visits_[v];
    const ReachBounds& reach = *visit.what.reach;
    const Rows xs = rows(0, x, v), ys = rows(1, y, v), zs = rows(2, z, v);
    visit.reached = ArcSet{};
    for (std::int64_t c = zs.first; c <= zs.last; ++c)
      for (std::int64_t b = ys.first; b <= ys.last; ++b)
        for (std::int64_t a = xs.first; a <= xs.last; ++a)
          visit.reached.add(reach.arcs(reach.grid().index(a, b, c)));
    if (visit.reached.empty()) return false;
    if (visit.hand.is_full()) continue;  // whatever the object's angle is
    ArcSet& here = objects_[visit.what.object].here;
    here = intersection_of(here.arcs(), difference_of(visit.reached.arcs(), visit.hand.arcs()).arcs());
    if (here.empty()) return false;
  }
  return true;
}

void SpotFilter::keep(std::size_t x, std::size_t y, std::size_t z) {
  const Span slices[3] = {slices_[0][x], slices_[1][y], slices_[2][z]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    left_[axis] = found_ ? Span{std::min(left_[axis].low_nm, slices[axis].low_nm),
                                std::max(left_[axis].high_nm, slices[axis].high_nm)}
                         : slices[axis];
  }
  found_ = true;
  if (unsettled_ == 0) return;
  unsettled_ = 0;
  for (Object& object : objects_) {
    object.left.add(object.here.arcs());
    if (object.left != object.angles) ++unsettled_;
  }
  for (Visit& visit : visits_) {
    if (visit.left != visit.hand) {
      const ArcSet turned = difference_of(visit.reached.arcs(), objects_[visit.what.object].here.arcs());
      visit.left.add(intersection_of(visit.hand.arcs(), turned.arcs()).arcs());
    }
    if (visit.left != visit.hand) ++unsettled_;
  }
}

bool SpotFilter::nothing_new(std::size_t x, std::size_t y, std::size_t z) const {
  if (unsettled_ != 0 || !found_) return false;
  const auto within = [&](Span slice, Span left) {
    return left.low_nm <= slice.low_nm && slice.high_nm <= left.high_nm;
  };
  return within(slices_[0][x], left_[0]) && within(slices_[1][y], left_[1]) &&
         within(slices_[2][z], left_[2]);
}

// Narrows what is asked to what is left in coarse cells.
bool SpotFilter::run_coarse() {
  for (const Visit& visit : visits_)
    if (visit.what.reach->coarse() == nullptr) return true;
  if (!coarse_) coarse_ = std::make_unique<SpotFilter>();
  SpotFilter& coarse = *coarse_;
  coarse.begin(box_);
  for (const Object& object : objects_) coarse.add_object(object.angles);
  for (const Visit& visit : visits_) {
    SpotVisit what = visit.what;
    what.reach = what.reach->coarse();
    coarse.add_visit(what, visit.hand);
  }
  if (!coarse.run()) return false;
  box_ = coarse.box();
  for (std::size_t k = 0; k < objects_.size(); ++k) objects_[k].angles = coarse.object(k);
  for (std::size_t k = 0; k < visits_.size(); ++k) visits_[k].hand = coarse.hand(k);
  return true;
}

bool SpotFilter::run() {
  found_ = false;
  for (Object& object : objects_) object.left = ArcSet{};
  for (Visit& visit : visits_) visit.left = ArcSet{};
  unsettled_ = 1;
  const Box box = within_reach();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box[axis].empty()) return false;
    cut(axis, box[axis]);
  }
  if (slices_[0].size() * slices_[1].size() * slices_[2].size() > kManyCells) {
    if (!run_coarse()) return false;
    const Box narrower = within_reach();
    for (std::size_t axis = 0; axis < 3; ++axis) cut(axis, narrower[axis]);
  }
  for (std::size_t z = 0; z < slices_[2].size(); ++z)
    for (std::size_t y = 0; y < slices_[1].size(); ++y)
      for (std::size_t x = 0; x < slices_[0].size(); ++x)
        if (!nothing_new(x, y, z) && reaches(x, y, z)) keep(x, y, z);
  return found_;
}

}  // namespace stepwright::tamp
