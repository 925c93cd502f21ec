#include "cell/hmi/picture_points.h"

#include <algorithm>
#include <utility>

#include "plant_models/core/names.h"

namespace stepwright::hmi {

using server::PointSourceKind;

std::string PicturePoints::add(std::string id, std::string label, std::string unit, bool trend,
                               server::PointSources from) {
  if (from.empty()) return {};
  points.push_back({id, std::move(label), std::move(unit), trend});
  sources.push_back(std::move(from));
  return id;
}

std::string PicturePoints::terminal(const std::string& id, const std::string& port) {
  const std::string* address = address_of(port);
  if (address == nullptr) return {};
  return add(id, port, "", false, {{PointSourceKind::Address, *address}});
}

std::string PicturePoints::counted(const std::string& id, const std::string& unit, const std::string& port,
                                   double factor) {
  const std::string* address = address_of(port);
  if (address == nullptr) return {};
  return add(id, port, unit, false, {{PointSourceKind::Address, *address, factor}});
}

std::string PicturePoints::truth(const std::string& id, const std::string& label, const std::string& unit,
                                 bool trend, const std::string& name) {
  if (name.empty()) return {};
  return add(id, label, unit, trend, {{PointSourceKind::PlantTruth, name}});
}

const std::string* PicturePoints::address_of(const std::string& port) const {
  const auto found = std::find_if(ports_.begin(), ports_.end(),
                                  [&](const auto& entry) { return core::same_name(entry.port, port); });
  return found == ports_.end() ? nullptr : &found->address;
}

}  // namespace stepwright::hmi
