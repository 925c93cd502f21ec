#include "plant_models/assemblies/robot_cell_shapes.h"

#include <algorithm>

namespace stepwright::assemblies {
namespace {

constexpr double kPlate_m = 0.015;  // thickness of a tray's plate
constexpr double kHandle_m = 0.02;  // of its handles, along its length

struct KindFigures {
  Vec3 size_m;
  double mass_kg;
};

KindFigures figures_of(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::Cup:
      return {{0.07, 0.07, 0.10}, 0.20};
    case ObjectKind::Can:
      return {{0.066, 0.066, 0.115}, 0.35};
    case ObjectKind::Tray:
      return {{0.32, 0.20, 0.06}, 0.60};
    case ObjectKind::Box:
    case ObjectKind::Obstacle:
      break;
  }
  return {{0.07, 0.12, 0.08}, 0.40};
}

double otherwise(double value, double fallback) {
  return value > 0.0 ? value : fallback;
}

ObjectPart block_part(Vec3 middle, Vec3 size_m, bool grip, bool surface) {
  return {box_solid(size_m), middle, size_m, grip, surface};
}

}  // namespace

ObjectShape shape_of(const ObjectFigures& figures) {
  const KindFigures usual = figures_of(figures.kind);
  const Vec3 size{otherwise(figures.size_m.x, usual.size_m.x), otherwise(figures.size_m.y, usual.size_m.y),
                  otherwise(figures.size_m.z, usual.size_m.z)};
  ObjectShape shape;
  shape.mass_kg = otherwise(figures.mass_kg, usual.mass_kg);
  shape.height_m = size.z;
  const Vec3 middle{0.0, 0.0, 0.5 * size.z};
  if (figures.kind == ObjectKind::Tray) {
    const double plate = std::min(kPlate_m, 0.5 * size.z);
    const double handle = std::min(kHandle_m, 0.25 * size.x);
    const double end = 0.5 * (size.x - handle);
    const Vec3 handle_size{handle, 0.5 * size.y, size.z - plate};
    const double handle_z = plate + 0.5 * handle_size.z;
    shape.add(block_part({0.0, 0.0, 0.5 * plate}, {size.x, size.y, plate}, false, true));
    shape.add(block_part({end, 0.0, handle_z}, handle_size, true, false));
    shape.add(block_part({-end, 0.0, handle_z}, handle_size, true, false));
  } else if (figures.kind == ObjectKind::Box) {
    shape.add(block_part(middle, size, true, true));
  } else {
    const Vec3 round{size.x, size.x, size.z};
    shape.add({cylinder_solid(0.5 * size.x, size.z), middle, round, true, figures.kind == ObjectKind::Can});
  }
  return shape;
}

}  // namespace stepwright::assemblies
