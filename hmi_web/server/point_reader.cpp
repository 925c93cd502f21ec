#include "hmi_web/server/point_reader.h"

#include <algorithm>

namespace stepwright::server {
namespace {

std::optional<ImageLocation> resolve(const PointSource& source, const ProgramLayout* layout) {
  if (layout == nullptr) return std::nullopt;
  return source.kind == PointSourceKind::Tag ? find_tag(*layout, source.name)
                                             : location_of_address(source.name, layout->output_offset);
}

std::optional<double> truth(const ImageSnapshot& snapshot, const std::string& name) {
  const auto found = std::find_if(snapshot.plant.begin(), snapshot.plant.end(),
                                  [&](const auto& value) { return value.first == name; });
  if (found == snapshot.plant.end()) return std::nullopt;
  return found->second;
}

}  // namespace

PointReader::PointReader(const std::vector<PointSources>& points, const ProgramLayout* layout) {
  for (const PointSources& sources : points) {
    std::vector<Resolved> resolved;
    for (const PointSource& source : sources) {
      if (source.kind == PointSourceKind::PlantTruth) {
        resolved.push_back({source.name, source.factor, source.offset});
      } else if (const auto location = resolve(source, layout)) {
        resolved.push_back({*location, source.factor, source.offset});
      }
    }
    points_.push_back(std::move(resolved));
  }
}

std::vector<std::optional<double>> PointReader::read(const ImageSnapshot& snapshot) const {
  std::vector<std::optional<double>> values(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (const Resolved& source : points_[i]) {
      const auto* location = std::get_if<ImageLocation>(&source.where);
      const auto value = location != nullptr ? server::read(*location, snapshot.image)
                                             : truth(snapshot, std::get<std::string>(source.where));
      if (!value) continue;
      values[i] = source.factor * *value + source.offset;
      break;
    }
  }
  return values;
}

}  // namespace stepwright::server
