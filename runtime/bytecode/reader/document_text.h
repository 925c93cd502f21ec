#pragma once

// What a container brings for viewers: the text of its section Document. Nobody has looked at it: not the
// verifier, and not the one who sent it.
//
//   const std::string_view text = reader::document_text(container);   // empty: there is none

#include <cstddef>
#include <span>
#include <string_view>

namespace stepwright::reader {

// At most bytecode::kMaxDocumentBytes, a view into `container`; empty, too, if that is no container.
std::string_view document_text(std::span<const std::byte> container);

}  // namespace stepwright::reader
