#include "runtime/native/internal/code_memory.h"

#include <cassert>
#include <utility>

namespace stepwright::native {

namespace {

using asmjit::VirtMem::MemoryFlags;

constexpr std::size_t round_up(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

}  // namespace

CodeMemory::CodeMemory(CodeMemory&& other) noexcept
    : pages_(std::exchange(other.pages_, nullptr)),
      page_bytes_(std::exchange(other.page_bytes_, 0)),
      code_bytes_(std::exchange(other.code_bytes_, 0)) {}

CodeMemory& CodeMemory::operator=(CodeMemory&& other) noexcept {
  std::swap(pages_, other.pages_);
  std::swap(page_bytes_, other.page_bytes_);
  std::swap(code_bytes_, other.code_bytes_);
  return *this;
}

CodeMemory::~CodeMemory() {
  if (pages_ != nullptr) asmjit::VirtMem::release(pages_, page_bytes_);
}

asmjit::Error CodeMemory::take(asmjit::CodeHolder& code) {
  assert(pages_ == nullptr);
  if (const asmjit::Error error = code.flatten()) return error;
  if (const asmjit::Error error = code.resolveUnresolvedLinks()) return error;
  const std::size_t bytes = round_up(code.codeSize(), asmjit::VirtMem::info().pageSize);
  void* pages = nullptr;
  if (const asmjit::Error error = asmjit::VirtMem::alloc(&pages, bytes, MemoryFlags::kAccessReadWrite)) {
    return error;
  }
  pages_ = pages;
  page_bytes_ = bytes;
  if (const asmjit::Error error = code.relocateToBase(reinterpret_cast<std::uint64_t>(pages))) return error;
  code_bytes_ = code.codeSize();
  if (const asmjit::Error error = code.copyFlattenedData(pages, bytes)) return error;
  asmjit::VirtMem::flushInstructionCache(pages, bytes);
  return asmjit::VirtMem::protect(pages, bytes, MemoryFlags::kAccessRead | MemoryFlags::kAccessExecute);
}

}  // namespace stepwright::native
