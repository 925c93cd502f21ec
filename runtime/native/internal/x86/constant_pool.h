#pragma once

// 64-bit constants behind the code, which instructions read as memory operands.

#include <cstdint>
#include <unordered_map>

#include <asmjit/x86.h>

namespace stepwright::native {

class ConstantPool {
 public:
  // The bits of an F64, or of an F32 in the lowest half.
  asmjit::x86::Mem at(asmjit::x86::Assembler& out, std::uint64_t bits, std::uint32_t bytes) {
    auto [entry, added] = labels_.try_emplace(bits);
    if (added) entry->second = out.newLabel();
    return asmjit::x86::ptr(entry->second, 0, bytes);
  }

  void emit(asmjit::x86::Assembler& out) {
    out.align(asmjit::AlignMode::kData, 8);
    for (const auto& [bits, label] : labels_) {
      out.bind(label);
      out.embedUInt64(bits);
    }
  }

 private:
  std::unordered_map<std::uint64_t, asmjit::Label> labels_;
};

}  // namespace stepwright::native
