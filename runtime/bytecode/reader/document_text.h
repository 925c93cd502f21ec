#pragma once

// Reader of a container's section Document: the text that it brings for viewers. Nobody has checked the text:
// neither the verifier nor whoever sent it.
//
// Pure; any thread.
//
//   const std::string_view text = reader::document_text(container);   // empty: there is none

#include <cstddef>
#include <span>
#include <string_view>

namespace stepwright::reader {

// At most bytecode::kMaxDocumentBytes, a view into `container`; empty, too, if that is no container.
std::string_view document_text(std::span<const std::byte> container);

}  // namespace stepwright::reader
