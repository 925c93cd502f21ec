#include "hmi_web/server/point_reader.h"

#include <algorithm>

#include "hmi_web/server/image_value.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::server {
namespace {

std::optional<reader::Variable> resolve(const PointSource& source, const ProgramLayout* layout) {
  if (layout == nullptr) return std::nullopt;
  return source.kind == PointSourceKind::Tag ? find_tag(*layout, source.name)
                                             : variable_at(source.name, layout->output_offset);
}

std::optional<double> truth(const ImageSnapshot& snapshot, const std::string& name) {
  const auto found = std::find_if(snapshot.plant.begin(), snapshot.plant.end(),
                                  [&](const auto& value) { return value.first == name; });
  if (found == snapshot.plant.end()) return std::nullopt;
  return found->second;
}

// In the image.
std::vector<reader::Variable> places_of(const PointSources& sources, const ProgramLayout& layout) {
  std::vector<reader::Variable> places;
  for (const PointSource& source : sources) {
    if (source.kind == PointSourceKind::PlantTruth) continue;
    if (const auto variable = resolve(source, &layout)) places.push_back(*variable);
  }
  return places;
}

// Names are those of the plant here and those of the binding there: upper and lower case alike.
double bias(const Tare& tare, const std::string& sensor) {
  const auto found = std::find_if(tare.begin(), tare.end(), [&](const auto& entry) {
    return !sensor.empty() && naming::same_name(entry.first, sensor);
  });
  return found == tare.end() ? 0 : found->second;
}

}  // namespace

PointReader::PointReader(const std::vector<PointSources>& points, const ProgramLayout* layout) {
  for (const PointSources& sources : points) {
    std::vector<Resolved> resolved;
    for (const PointSource& source : sources) {
      if (source.kind == PointSourceKind::PlantTruth) {
        resolved.push_back({source.name, source.factor, source.offset, source.sensor});
      } else if (const auto variable = resolve(source, layout)) {
        resolved.push_back({*variable, source.factor, source.offset, source.sensor});
      }
    }
    points_.push_back(std::move(resolved));
  }
}

protocol::PointTags tags_of_points(const std::vector<PointSources>& points, const ProgramLayout& layout) {
  protocol::PointTags result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<reader::Variable> places = places_of(points[i], layout);
    for (std::uint32_t tag = 0; tag < layout.tags.size(); ++tag)
      if (overlap_any(places, layout.tags[tag])) result[i].push_back(tag);
  }
  return result;
}

std::vector<std::size_t> points_from(const std::vector<PointSources>& points,
                                     const std::vector<UnreadInputs>& unread, const ProgramLayout& layout) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<reader::Variable> places = places_of(points[i], layout);
    const bool reads_one = std::ranges::any_of(unread, [&](const UnreadInputs& device) {
      return std::ranges::any_of(device.inputs,
                                 [&](const reader::Variable& input) { return overlap_any(places, input); });
    });
    if (reads_one) found.push_back(i);
  }
  return found;
}

std::vector<std::optional<double>> PointReader::read(const ImageSnapshot& snapshot, const Tare& tare) const {
  std::vector<std::optional<double>> values(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (const Resolved& source : points_[i]) {
      const auto* variable = std::get_if<reader::Variable>(&source.where);
      const auto value = variable != nullptr ? server::read(*variable, snapshot.image)
                                             : truth(snapshot, std::get<std::string>(source.where));
      if (!value) continue;
      values[i] = source.factor * (*value - bias(tare, source.sensor)) + source.offset;
      break;
    }
  }
  return values;
}

}  // namespace stepwright::server
