#include "ladder/codegen/literal_pool.h"

#include <cstring>

namespace stepwright::codegen {

std::uint32_t LiteralPool::address_of(const std::u16string& text, semantics::ElementaryType which) {
  const auto at = static_cast<std::uint32_t>(begin_ + bytes_.size());
  const auto [known, is_new] = known_.try_emplace({which, text}, at);
  if (!is_new) return known->second;
  const auto length = static_cast<std::uint16_t>(text.size());
  const std::size_t start = bytes_.size();
  bytes_.resize(start + bytecode::string_bytes(which, length));
  std::memcpy(bytes_.data() + start, &length, sizeof(length));
  std::memcpy(bytes_.data() + start + sizeof(length), &length, sizeof(length));
  const std::size_t width = bytecode::character_bytes(which);
  std::byte* const characters = bytes_.data() + start + bytecode::kStringHeaderBytes;
  for (std::size_t i = 0; i < text.size(); ++i) std::memcpy(characters + i * width, &text[i], width);
  return at;
}

}  // namespace stepwright::codegen
