#include "supervisor/ltl/regions/geos.h"

#include <utility>

namespace stepwright::ltl {
namespace {

void keep_message(const char* message, void* to) {
  *static_cast<std::string*>(to) = message;
}

}  // namespace

Geos::Geos() : context_(GEOS_init_r()) {
  GEOSContext_setErrorMessageHandler_r(context_, keep_message, &last_error_);
}

Geos::~Geos() {
  GEOS_finish_r(context_);
}

void Geos::raise() const {
  throw GeosError(last_error_.empty() ? "GEOS fails without a message" : last_error_);
}

Shape Geos::own(GEOSGeometry* geometry) const {
  if (geometry == nullptr) raise();
  return {geometry, Destroy{context_}};
}

bool Geos::answer(char said) const {
  if (said != 0 && said != 1) raise();
  return said == 1;
}

Shape Geos::polygon(std::span<const geometry::Point> ring) const {
  std::vector<double> numbers;
  numbers.reserve(2 * ring.size() + 2);
  for (const geometry::Point p : ring) numbers.insert(numbers.end(), {p.x_m, p.y_m});
  if (ring.front() != ring.back()) numbers.insert(numbers.end(), {ring.front().x_m, ring.front().y_m});
  const auto count = static_cast<unsigned>(numbers.size() / 2);
  GEOSCoordSequence* points = GEOSCoordSeq_copyFromBuffer_r(context_, numbers.data(), count, 0, 0);
  if (points == nullptr) raise();
  Shape line = own(GEOSGeom_createLinearRing_r(context_, points));
  return own(GEOSGeom_createPolygon_r(context_, line.release(), nullptr, 0));
}

Shape Geos::point(geometry::Point at) const {
  return own(GEOSGeom_createPointFromXY_r(context_, at.x_m, at.y_m));
}

Shape Geos::collection(int type, std::vector<Shape> parts) const {
  std::vector<GEOSGeometry*> raw;
  raw.reserve(parts.size());
  for (Shape& part : parts) raw.push_back(part.release());
  return own(GEOSGeom_createCollection_r(context_, type, raw.data(), static_cast<unsigned>(raw.size())));
}

std::vector<geometry::Point> Geos::points_of(const GEOSGeometry* line) const {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_, line);
  unsigned count = 0;
  if (sequence == nullptr || GEOSCoordSeq_getSize_r(context_, sequence, &count) == 0) raise();
  std::vector<double> numbers(2 * static_cast<std::size_t>(count));
  if (GEOSCoordSeq_copyToBuffer_r(context_, sequence, numbers.data(), 0, 0) == 0) raise();
  std::vector<geometry::Point> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return points;
}

}  // namespace stepwright::ltl
