#include "ladder/codegen/container_limits.h"

#include <algorithm>
#include <utility>

#include "ladder/source/codes.h"
#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/utf8.h"

namespace stepwright::codegen {

using bytecode::Section;
using bytecode::VerifyStatus;

namespace {

constexpr std::string_view kCut = " ...";

// A source may be no UTF-8 (a comment or a string in another encoding), a file's name likewise: "?" for each
// byte that is no part of a character.
std::string as_utf8(std::string text) {
  if (bytecode::is_utf8(text)) return text;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 1;
    while (length <= 4 && at + length <= text.size() && !bytecode::is_utf8({&text[at], length})) ++length;
    const bool whole = length <= 4 && at + length <= text.size();
    if (!whole) text[at] = '?';
    at += whole ? length : 1;
  }
  return text;
}

// Cut before a character of UTF-8, so that a whole one is the last.
std::string cut(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most - kCut.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;
  text.resize(end);
  return text += kCut;
}

}  // namespace

std::string ContainerLimits::name(std::string name, std::size_t most) {
  return cut(as_utf8(std::move(name)), most);
}

std::string ContainerLimits::text(std::string text) {
  text = cut(as_utf8(std::move(text)), bytecode::kMaxTextBytes);
  if (text.size() <= bytecode::kMaxStringBytes) return text;
  if (long_texts_ + text.size() > bytecode::kMaxLongTextBytes)
    return cut(std::move(text), bytecode::kMaxStringBytes);
  long_texts_ += text.size();
  return text;
}

result::Diagnostic ContainerLimits::too_large(source::Position where, std::string message,
                                              std::string hint) const {
  return {source::code::kTooLarge, result::Severity::Error, sources_.location(where), std::move(message),
          std::move(hint)};
}

void ContainerLimits::too_many_locals(const semantics::Pou& pou, source::Position where) {
  errors_.push_back(too_large(
      where, "'" + pou.spelling + "' needs more than " + std::to_string(bytecode::kMaxLocals) + " locals",
      "variables of a function, VAR_TEMP and what expressions keep aside are locals; arrays, structures and "
      "variables of function blocks are not"));
}

void ContainerLimits::check_path(std::string_view path, source::Position where) {
  if (path.size() <= bytecode::kMaxStringBytes) return;
  errors_.push_back({source::code::kLongName, result::Severity::Error, sources_.location(where),
                     "the path through the instances to this is longer than " +
                         std::to_string(bytecode::kMaxStringBytes) +
                         " bytes: " + std::string(path.substr(0, 60)) + " ...",
                     "shorten the names of the instances, or nest them less deep"});
}

result::Diagnostics ContainerLimits::explained(writer::Refusal refusal, const writer::ContainerModel& out,
                                               const std::vector<const semantics::Pou*>& functions) const {
  const bytecode::VerifyResult& verdict = refusal.verdict;
  if (verdict.status != VerifyStatus::TooLarge || functions.empty()) return std::move(refusal.diagnostics);
  if (verdict.section == Section::Functions && verdict.index < functions.size()) {
    const semantics::Pou& pou = *functions[verdict.index];
    return {too_large(pou.where,
                      "'" + pou.spelling + "' and what it calls need more than " +
                          std::to_string(bytecode::kMaxStackSlots) + " locals and operands at once",
                      "let fewer functions with many locals call each other")};
  }
  if (verdict.section == Section::Code)
    return {too_large(functions.front()->where, "the compiled program is larger than 64 MiB",
                      "split it into several programs for several runtimes")};
  const auto larger = [](const writer::Function& a, const writer::Function& b) {
    return a.frame_size < b.frame_size;
  };
  const auto largest = std::max_element(out.functions.begin(), out.functions.end(), larger);
  const semantics::Pou& pou = *functions[static_cast<std::size_t>(largest - out.functions.begin())];
  return {too_large(pou.where,
                    "the variables of the program, its texts and the arrays, structures and strings of its "
                    "functions, once for each of " +
                        std::to_string(out.tasks.size()) + " tasks, are larger than 64 MiB",
                    "'" + pou.spelling +
                        "' has the most of them: make it a function block, or its variables "
                        "global")};
}

}  // namespace stepwright::codegen
