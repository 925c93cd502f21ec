#pragma once

// The section Document of a container: what viewers show of the sources. Engines never read it, and a
// controller with little flash is given the file without it.
//
//   container = with_document(container, document);
//   send(without_document(container));
//
// Pure functions. The containers are valid files (bytecode::parse_container), else they are returned as they
// are.

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace stepwright::writer {

// A document that is empty or longer than bytecode::kMaxDocumentBytes is left out.
std::vector<std::byte> with_document(std::span<const std::byte> container, std::string_view document);
std::vector<std::byte> without_document(std::span<const std::byte> container);

}  // namespace stepwright::writer
