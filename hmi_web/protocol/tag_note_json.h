#pragma once

// What is said of a tag as pages get it (hmi_web/doc/protocol.md): in `hello` what the cell says, in
// `program` what the declaration does.
//
// Pure; any thread.

#include <nlohmann/json_fwd.hpp>

#include "hmi_web/protocol/tag_note.h"

namespace stepwright::protocol {

// What is not said is left out, the name, too.
nlohmann::json to_json(const TagNote& note);

}  // namespace stepwright::protocol
