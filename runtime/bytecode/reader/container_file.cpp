#include "runtime/bytecode/reader/container_file.h"

#include <array>
#include <cstring>
#include <fstream>

#include "runtime/bytecode/container_format.h"

namespace stepwright::reader {

bool is_container_or_empty(const std::filesystem::path& file) {
  std::array<char, sizeof bytecode::kMagic> begin{};
  std::ifstream text(file, std::ios::binary);
  if (!text.read(begin.data(), begin.size())) return text.gcount() == 0;
  return std::memcmp(begin.data(), &bytecode::kMagic, begin.size()) == 0;
}

}  // namespace stepwright::reader
