#pragma once

// Notes on tags as JSON for pages (hmi_web/doc/protocol.md): in `hello` those of the cell, in `program` those
// of the declarations.
//
// Pure; any thread.

#include <nlohmann/json_fwd.hpp>

#include "hmi_web/protocol/tag_note.h"

namespace stepwright::protocol {

// What is not said is left out, the name, too.
nlohmann::json to_json(const TagNote& note);

}  // namespace stepwright::protocol
