#pragma once

// [tags] of a cell as the page is told it.
//
// Pure.

#include <span>
#include <vector>

#include "cell/config/tag_config.h"
#include "hmi_web/protocol/tag_note.h"

namespace stepwright::tags {

std::vector<protocol::TagNote> tag_notes(std::span<const config::TagConfig> tags);

}  // namespace stepwright::tags
