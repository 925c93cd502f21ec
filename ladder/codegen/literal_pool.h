#pragma once

// The texts of string literals: constants behind the variables of Data, each text once. Internal to this
// folder.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ladder/semantics/types/constant.h"

namespace stepwright::codegen {

class LiteralPool {
 public:
  // `begin`: the absolute address of the first byte.
  explicit LiteralPool(std::uint32_t begin) : begin_(begin) {}

  // The absolute address of a string that holds the text. Requires a string type.
  std::uint32_t address_of(const std::u16string& text, semantics::ElementaryType which);
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::uint32_t begin_;
  std::vector<std::byte> bytes_;
  std::map<std::pair<semantics::ElementaryType, std::u16string>, std::uint32_t> known_;
};

}  // namespace stepwright::codegen
