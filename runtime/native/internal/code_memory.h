#pragma once

// Pages that hold machine code: writable while the code is copied there, then executable, never both.

#include <cstddef>

#include <asmjit/core.h>

namespace stepwright::native {

class CodeMemory {
 public:
  CodeMemory() = default;
  CodeMemory(const CodeMemory&) = delete;
  CodeMemory& operator=(const CodeMemory&) = delete;
  CodeMemory(CodeMemory&& other) noexcept;
  CodeMemory& operator=(CodeMemory&& other) noexcept;
  ~CodeMemory();

  // Relocates the code to pages of its own and makes them executable. What the library says if it cannot.
  asmjit::Error take(asmjit::CodeHolder& code);

  const std::byte* data() const { return static_cast<const std::byte*>(pages_); }
  std::size_t code_bytes() const { return code_bytes_; }

 private:
  void* pages_ = nullptr;
  std::size_t page_bytes_ = 0;
  std::size_t code_bytes_ = 0;
};

}  // namespace stepwright::native
