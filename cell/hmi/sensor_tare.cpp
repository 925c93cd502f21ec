#include "cell/hmi/sensor_tare.h"

#include <nlohmann/json.hpp>

namespace stepwright::hmi {

server::Tare tare_of(const std::string& plan_document) {
  server::Tare tare;
  const auto document = nlohmann::json::parse(plan_document, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object()) return tare;
  const auto entries = document.find("tare");
  if (entries == document.end() || !entries->is_object()) return tare;
  for (const auto& [sensor, counts] : entries->items()) {
    if (counts.is_number()) tare.emplace(sensor, counts.get<double>());
  }
  return tare;
}

}  // namespace stepwright::hmi
