#include "runtime/bytecode/writer/document_section.h"

#include <array>

#include "runtime/bytecode/container_parse.h"
#include "runtime/bytecode/writer/section_buffers.h"

namespace stepwright::writer {

std::vector<std::byte> with_document(std::span<const std::byte> container, std::string_view document) {
  bytecode::ContainerView view;
  if (!bytecode::parse_container(container, view).ok()) return {container.begin(), container.end()};
  std::array<std::span<const std::byte>, bytecode::kMostSections> sections;
  for (std::uint32_t i = 0; i < bytecode::kSectionCount; ++i)
    sections[i] = view.section(static_cast<bytecode::Section>(i));
  const bool fits = !document.empty() && document.size() <= bytecode::kMaxDocumentBytes;
  if (!fits) return assemble(std::span(sections).first(bytecode::kSectionCount));
  sections.back() = std::as_bytes(std::span(document));
  return assemble(sections);
}

std::vector<std::byte> without_document(std::span<const std::byte> container) {
  return with_document(container, {});
}

}  // namespace stepwright::writer
