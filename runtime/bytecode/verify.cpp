#include "runtime/bytecode/code_check.h"
#include "runtime/bytecode/container_parse.h"
#include "runtime/bytecode/program.h"
#include "runtime/bytecode/stack_need.h"
#include "runtime/bytecode/table_check.h"

namespace stepwright::bytecode {

namespace {

// The stages share the scratch memory one after the other.
std::uint64_t scratch_words(const ContainerView& view) {
  std::uint64_t words = stack_need_words(view.count<Section::Functions>());
  for (std::uint32_t f = 0; f < view.count<Section::Functions>(); ++f) {
    const std::uint64_t need = code_check_words(view.record<Section::Functions>(f).code_size);
    if (need > words) words = need;
  }
  return words;
}

VerifyResult check_all_code(const ContainerView& view, std::span<std::uint32_t> scratch) {
  for (std::uint32_t f = 0; f < view.count<Section::Functions>(); ++f) {
    const CodeCheck check = check_code(view, f, scratch);
    if (!check.result.ok()) return check.result;
    if (check.max_stack != view.record<Section::Functions>(f).max_stack) {
      return {VerifyStatus::WrongSizes, Section::Functions, f, 0};
    }
  }
  return {};
}

}  // namespace

std::uint64_t verify_scratch_words(std::span<const std::byte> bytes) {
  ContainerView view;
  if (!parse_container(bytes, view).ok() || !check_tables(view).ok()) return 0;
  return scratch_words(view);
}

VerifyResult verify(std::span<const std::byte> bytes, std::span<std::uint32_t> scratch, Program& program) {
  ContainerView view;
  if (const VerifyResult file = parse_container(bytes, view); !file.ok()) return file;
  if (const VerifyResult tables = check_tables(view); !tables.ok()) return tables;
  if (scratch.size() < scratch_words(view)) return {.status = VerifyStatus::ScratchTooSmall};
  if (const VerifyResult code = check_all_code(view, scratch); !code.ok()) return code;

  const StackNeed need = compute_stack_need(view, scratch);
  if (!need.result.ok()) return need.result;
  const SizesRecord sizes = view.sizes();
  if (need.stack_slots != sizes.stack_slots || need.call_depth != sizes.call_depth) {
    return {.status = VerifyStatus::WrongSizes};
  }
  program = Program(view);
  return {};
}

}  // namespace stepwright::bytecode
