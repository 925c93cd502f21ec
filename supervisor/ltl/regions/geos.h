#pragma once

// GEOS (LGPL-2.1, linked as a shared library) behind one header: a context that is freed by itself,
// geometries that own what they hold, and errors as an exception that stays inside this folder.
//
//   Geos geos;
//   Shape square = geos.polygon(ring);
//   Shape face = geos.own(GEOSPolygonize_r(geos, lines, 1));
//
// Threads: one per context. Every function throws GeosError with GEOS's own words.

#include <geos_c.h>

#include <array>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "supervisor/geometry/point.h"

namespace stepwright::ltl {

struct GeosError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Geos {
 public:
  struct Destroy {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Shape = std::unique_ptr<GEOSGeometry, Destroy>;

  Geos();
  ~Geos();
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  operator GEOSContextHandle_t() const { return context_; }

  // Takes what a function of GEOS returned; a null pointer is its error.
  Shape own(GEOSGeometry* geometry) const;
  // What such a function answers: 0 or 1, 2 for an exception.
  bool answer(char said) const;

  // The ring need not repeat its first point. Requires three points or more.
  Shape polygon(std::span<const geometry::Point> ring) const;
  Shape point(geometry::Point at) const;
  Shape collection(int type, std::vector<Shape> parts) const;

  // The points of a line or ring.
  std::vector<geometry::Point> points_of(const GEOSGeometry* line) const;

 private:
  [[noreturn]] void raise() const;

  GEOSContextHandle_t context_;
  std::string last_error_;
};

using Shape = Geos::Shape;

}  // namespace stepwright::ltl
