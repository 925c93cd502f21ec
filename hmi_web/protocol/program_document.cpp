#include "hmi_web/protocol/program_document.h"

#include <algorithm>
#include <span>

#include "hmi_web/protocol/json_text.h"

namespace stepwright::protocol {

using nlohmann::json;

json parsed_document(std::string_view document) {
  // Writing a value out again recurses.
  const auto shallow = [](int depth, json::parse_event_t, json&) { return depth < kMostLevels; };
  json value = json::parse(document, shallow, /*allow_exceptions=*/false);
  const bool known = value.is_object() && value.contains("version") && value["version"] == 1 &&
                     value.contains("sheets") && value["sheets"].is_array();
  return known ? value : json(nullptr);
}

std::string program_sources(const ProgramSources& sources) {
  json document = sources.document.empty() ? json(nullptr) : parsed_document(sources.document);
  const char* state = sources.document.empty() ? "absent" : document.is_null() ? "damaged" : "complete";
  json instances = json::array();
  for (const ProgramInstance& each :
       std::span(sources.instances).first(std::min(sources.instances.size(), kMostInstances)))
    instances.push_back({{"path", each.path}, {"pou", each.pou}});
  return text({{"digest", sources.digest},
               {"state", state},
               {"instances", std::move(instances)},
               {"document", std::move(document)}});
}

}  // namespace stepwright::protocol
