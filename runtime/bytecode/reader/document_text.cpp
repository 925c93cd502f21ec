#include "runtime/bytecode/reader/document_text.h"

#include "runtime/bytecode/container_parse.h"

namespace stepwright::reader {

std::string_view document_text(std::span<const std::byte> container) {
  bytecode::ContainerView view;
  if (!bytecode::parse_container(container, view).ok()) return {};
  const auto bytes = view.section(bytecode::Section::Document);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace stepwright::reader
