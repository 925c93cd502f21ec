#pragma once

// Values out of a copy of the process image: bounded reading, and direct addresses of the I/O areas.
//
//   std::optional<double> counts = read({bytecode::ElementaryType::Int, 2}, snapshot.image);
//
// Pure; any thread.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::server {

// As reader::read_quantity, so that a TIME is in seconds; no value if the variable reaches past the end of
// the image, nor of a text.
std::optional<double> read(const reader::Variable& variable, std::span<const std::byte> image);

// STRING, WSTRING, DATE, TOD and DT: what people read as text.
bool has_text(const reader::Variable& variable);
// Of such a variable, and of a LINT, ULINT or LWORD beyond 2^53, as reader::read_text, as long as a page
// shows it: after kMostTextBytes comes "…".
inline constexpr std::size_t kMostTextBytes = 254;
std::optional<std::string> read_text(const reader::Variable& variable, std::span<const std::byte> image);

// They have a bit in common.
bool overlap(const reader::Variable& one, const reader::Variable& other);
// The variable has a bit in common with any of the places.
bool overlap_any(const std::vector<reader::Variable>& places, const reader::Variable& variable);

// A direct address in the input or output area: "%IX0.2", "%IW1" (bytes 2 and 3), "%QB4". A word is read as
// signed, as an INT at that address is. `output_offset` is where the output area begins; inputs begin at 0.
// nullopt for anything else, markers included.
std::optional<reader::Variable> variable_at(std::string_view address, std::uint32_t output_offset);

}  // namespace stepwright::server
