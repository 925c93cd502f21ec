#pragma once

// A program as a viewer sees it, and where each of its values lies in the image.
//
// Invariant: `steps`, `transitions` and `tags` run parallel to the lists of `program`.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hmi_web/protocol/program.h"
#include "hmi_web/server/image_value.h"

namespace stepwright::server {

struct ProgramLayout {
  protocol::Program program;
  std::vector<ImageLocation> steps;
  std::vector<ImageLocation> transitions;
  std::vector<ImageLocation> tags;
  std::uint32_t output_offset = 0;  // of the output area in the image; the input area begins at 0
};

// The tag of that name, upper and lower case alike: its whole name or, failing that, the only tag whose last
// part (behind the last '.') it is.
std::optional<ImageLocation> find_tag(const ProgramLayout& layout, std::string_view name);

}  // namespace stepwright::server
