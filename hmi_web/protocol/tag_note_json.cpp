#include "hmi_web/protocol/tag_note_json.h"

#include <nlohmann/json.hpp>

namespace stepwright::protocol {

using nlohmann::json;

json to_json(const TagNote& note) {
  json object = json::object();
  if (!note.name.empty()) object["name"] = note.name;
  if (!note.unit.empty()) object["unit"] = note.unit;
  if (!note.description.empty()) object["description"] = note.description;
  if (!note.group.empty()) object["group"] = note.group;
  if (note.decimals) object["decimals"] = *note.decimals;
  if (note.normal) object["normal"] = {note.normal->first, note.normal->second};
  if (!note.values.empty()) object["values"] = note.values;
  return object;
}

}  // namespace stepwright::protocol
