#include "runtime/bytecode/reader/loaded_program.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

namespace stepwright::reader {

using bytecode::Section;
using bytecode::VerifyStatus;

namespace {

const char* code_of(VerifyStatus status) {
  switch (status) {
    case VerifyStatus::NotAContainer:
      return "B0001";
    case VerifyStatus::WrongVersion:
      return "B0002";
    case VerifyStatus::Truncated:
    case VerifyStatus::TrailingBytes:
      return "B0003";
    case VerifyStatus::BadChecksum:
      return "B0004";
    default:
      return "B0005";
  }
}

// Requires at least the header's bytes.
bytecode::FileHeader header_of(std::span<const std::byte> bytes) {
  bytecode::FileHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  return header;
}

std::string details(std::span<const std::byte> bytes, const bytecode::VerifyResult& verdict) {
  switch (verdict.status) {
    case VerifyStatus::Truncated:
      if (bytes.size() < sizeof(bytecode::FileHeader)) return "it ends within its header";
      [[fallthrough]];
    case VerifyStatus::TrailingBytes:
      return std::to_string(bytes.size()) + " bytes are there, " +
             std::to_string(header_of(bytes).total_bytes) + " should be";
    case VerifyStatus::WrongVersion:
      return "version " + std::to_string(header_of(bytes).version) + ", this program reads version " +
             std::to_string(bytecode::kVersion);
    case VerifyStatus::NotAContainer:
    case VerifyStatus::BadChecksum:
    case VerifyStatus::TooLarge:
    case VerifyStatus::WrongSizes:
      return {};
    default:
      return "section " + std::to_string(static_cast<std::uint32_t>(verdict.section)) + ", record " +
             std::to_string(verdict.index) + ", byte " + std::to_string(verdict.offset);
  }
}

const char* hint_for(VerifyStatus status) {
  switch (status) {
    case VerifyStatus::NotAContainer:
      return "compile the sources with `stepwright compile SOURCE -o IMAGE.swb`";
    case VerifyStatus::WrongVersion:
      return "compile the program again with the compiler of this version";
    case VerifyStatus::Truncated:
    case VerifyStatus::TrailingBytes:
    case VerifyStatus::BadChecksum:
      return "copy or download the file again";
    default:
      return "compile the program again; the file was not written by this compiler as it is";
  }
}

}  // namespace

result::Diagnostic refusal(std::span<const std::byte> bytes, const bytecode::VerifyResult& verdict,
                           const std::string& name) {
  const std::string more = details(bytes, verdict);
  return {code_of(verdict.status),
          result::Severity::Error,
          {name, 0, 0},
          bytecode::explain(verdict.status) + (more.empty() ? "" : ": " + more),
          hint_for(verdict.status)};
}

result::Result<LoadedProgram> LoadedProgram::load(std::vector<std::byte> bytes, const std::string& name) {
  std::vector<std::uint32_t> scratch(bytecode::verify_scratch_words(bytes));
  bytecode::Program program;
  const bytecode::VerifyResult verdict = bytecode::verify(bytes, scratch, program);
  if (!verdict.ok()) return tl::unexpected(result::Diagnostics{refusal(bytes, verdict, name)});
  return LoadedProgram(std::move(bytes), program);
}

result::Result<LoadedProgram> LoadedProgram::load_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (size < 0 || size > std::streamoff{bytecode::kMaxContainerBytes}) {
    return result::fail("B0006", {path, 0, 0}, size < 0 ? "the file cannot be read" : "the file is too large",
                        "name a container written by `stepwright compile`");
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), size);
  if (!file) return result::fail("B0006", {path, 0, 0}, "the file cannot be read", "check its permissions");
  return load(std::move(bytes), path);
}

std::string text_of(const bytecode::ContainerView& container, bytecode::StringRef ref) {
  const auto text = container.string(ref);
  return {text.begin(), text.end()};
}

result::Location source_location(const bytecode::Program& program, std::uint32_t function, std::uint32_t pc) {
  const bytecode::ContainerView& view = program.container();
  result::Location where;
  for (std::uint32_t i = 0; i < view.count<Section::SourceMap>(); ++i) {
    const auto record = view.record<Section::SourceMap>(i);
    if (record.function > function || (record.function == function && record.pc > pc)) break;
    if (record.function < function) continue;
    where = {text_of(view, view.record<Section::SourceFiles>(record.file)), record.line, record.column};
  }
  return where;
}

result::Location trap_location(const bytecode::Program& program, const bytecode::Trap& trap) {
  // A byte of the call, not of what follows it.
  return trap.in_library() ? source_location(program, trap.caller, trap.return_pc - 1)
                           : source_location(program, trap.function, trap.pc);
}

result::Diagnostic describe(const bytecode::Program& program, const bytecode::Trap& trap) {
  const bytecode::ContainerView& view = program.container();
  const auto function = view.record<Section::Functions>(trap.function);
  result::Diagnostic diagnostic;
  diagnostic.code = bytecode::diagnostic_code_of(trap.code);
  diagnostic.where = trap_location(program, trap);
  diagnostic.message = std::string(bytecode::name_of(trap.code)) + " in " + text_of(view, function.name);
  if (trap.in_library()) {
    const result::Location inner = source_location(program, trap.function, trap.pc);
    diagnostic.message += " (" + inner.file + ":" + std::to_string(inner.line) + "), called here";
  }
  return diagnostic;
}

}  // namespace stepwright::reader
