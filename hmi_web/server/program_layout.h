#pragma once

// A program as a viewer sees it, and where each of its values lies in the image.
//
//   auto layout = read_layout(container, digest);
//   auto level = find_tag(*layout, "S1_filtered");
//
// Immutable once made. Invariant: `steps`, `transitions` and `tags` run parallel to the lists of `program`.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/protocol/program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"

namespace stepwright::server {

struct ProgramLayout {
  protocol::Program program;
  std::vector<reader::Variable> steps;
  std::vector<std::optional<reader::Variable>> transitions;  // none: its bit is not kept
  std::vector<reader::Variable> tags;
  std::string document;             // of its sources (hmi_web/doc/program.md), as it came; empty: it has none
  std::uint32_t output_offset = 0;  // of the output area in the image; the input area begins at 0
};

// Reads a container: all its charts as one, its tags without the bits of steps and transitions and without
// the arrays that array_selection.h leaves out (`program.left_out`). Fails as reader::ProgramInfo::read.
[[nodiscard]] result::Result<ProgramLayout> read_layout(std::span<const std::byte> container,
                                                        const std::string& digest);

// The tag of that name, upper and lower case alike: its whole name or, failing that, the only tag whose last
// part (behind the last '.') it is.
// Of the index there is one for `program.tags` and `tags`.
std::optional<std::size_t> find_tag_index(const ProgramLayout& layout, std::string_view name);
std::optional<reader::Variable> find_tag(const ProgramLayout& layout, std::string_view name);

}  // namespace stepwright::server
