#pragma once

// Which positions of a spot, which angles of what stands there and which angles of the hands are left, if
// all hands that ever come to the spot are to reach it: exact for the cells of their reaches, all visits
// judged together cell by cell. Where there are many cells, large ones are looked at first.
//
// A spot is a position that one object, or a stack of them, has for a while; a visit is a hand that grasps or
// releases there. Tool angle = angle of the object + angle of the hand as seen from the object.
//
// Thread rule: one owner. It keeps its memory from call to call.
//
//   SpotFilter filter;
//   filter.begin(box);
//   const auto cup = filter.add_object(ArcSet::full());
//   filter.add_visit({&right_reach, cup, rise_nm, 0}, hand);
//   if (filter.run()) ... filter.box(), filter.object(cup), filter.hand(0)

#include <cstddef>
#include <memory>
#include <vector>

#include "supervisor/tamp/intervals/reach/reach_bounds.h"

namespace stepwright::tamp {

struct SpotVisit {
  const ReachBounds* reach = nullptr;
  std::size_t object = 0;      // as add_object() numbers them
  std::int64_t rise_nm = 0;    // of the tool above the spot
  std::int64_t radius_nm = 0;  // the tool may be beside the spot by that much in x and in y
};

class SpotFilter {
 public:
  void begin(const Box& box);
  std::size_t add_object(const ArcSet& angles);
  // Two visits may have the same hand only if both say so by what they are given: each is narrowed by itself.
  std::size_t add_visit(const SpotVisit& visit, const ArcSet& hand);

  // False if nothing is left.
  bool run();

  const Box& box() const { return left_; }
  const ArcSet& object(std::size_t k) const { return objects_[k].left; }
  const ArcSet& hand(std::size_t k) const { return visits_[k].left; }

 private:
  struct Rows {
    std::int32_t first = 0, last = 0;  // of a visit's grid; first > last: none
  };
  struct Object {
    ArcSet angles, left, here;
  };
  struct Visit {
    SpotVisit what;
    ArcSet hand, left, reached;
  };

  Box within_reach() const;
  bool run_coarse();
  void cut(std::size_t axis, Span span);
  bool reaches(std::size_t x, std::size_t y, std::size_t z);
  void keep(std::size_t x, std::size_t y, std::size_t z);
  bool nothing_new(std::size_t x, std::size_t y, std::size_t z) const;
  const Rows& rows(std::size_t axis, std::size_t slice, std::size_t visit) const {
    return rows_[axis][slice * visits_.size() + visit];
  }

  Box box_{}, left_{};
  bool found_ = false;
  std::size_t unsettled_ = 0;  // sets of angles that have not got back all that they had
  std::vector<Object> objects_;
  std::vector<Visit> visits_;
  std::vector<Span> slices_[3];
  std::vector<Rows> rows_[3];
  std::unique_ptr<SpotFilter> coarse_;
};

}  // namespace stepwright::tamp
