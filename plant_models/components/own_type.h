#pragma once

// A type that a plant's file describes itself, by states, equations and events:
//
//   [types.silo]
//   meaning = "a silo with a screw"
//   parameters.rate = { unit = "kg/s", default = "2 kg/s" }
//   inputs.run = { switch = true }
//   inputs.feed = { unit = "kg/s", default = "0 kg/s" }
//   states.content = { unit = "kg", start = "0 kg", derivative = "feed - (run ? rate : 0 * rate)" }
//   outputs.content_out = { unit = "kg", value = "content" }
//   outputs.empty = { switch = true, value = "content <= 0" }
//   events.runs_empty = { when = "content", falling = true, set.content = "0" }
//   faults.blocked = { unit = "percent", high = 100, rest = "0 percent" }
//   ports.inlet = { role = "branch", flow = "k * inlet_pressure" }      # of liquid

#include <optional>
#include <string>

#include "plant_models/components/component_type.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::components {

// Nothing if it is wrong, which is reported to the document: C0341 (units), C0349 (expressions), codes of
// figures.
std::optional<ComponentType> read_own_type(const settings::TomlTable& table, const std::string& name);

}  // namespace stepwright::components
