#include "runtime/native/internal/program_code.h"

namespace stepwright::native {

asmjit::Error ProgramCode::place(asmjit::CodeHolder& holder, asmjit::Label entry_label,
                                 const std::vector<asmjit::Label>& function_labels) {
  if (const asmjit::Error error = memory.take(holder)) return error;
  const std::byte* const base = memory.data();
  enter = reinterpret_cast<Entry>(reinterpret_cast<std::uintptr_t>(base) + holder.labelOffset(entry_label));
  for (const asmjit::Label& label : function_labels) functions.push_back(base + holder.labelOffset(label));
  return asmjit::kErrorOk;
}

}  // namespace stepwright::native
