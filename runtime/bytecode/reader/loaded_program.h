#pragma once

// A verified program that owns its bytes, for the host: loads a container and says in words why it refuses
// one. Portable targets verify in place instead (runtime/bytecode/program.h).
//
//   result::Result<LoadedProgram> loaded = LoadedProgram::load(std::move(bytes), "main.swb");
//   if (!loaded) std::cerr << result::to_string(loaded.error());

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/program.h"
#include "runtime/bytecode/trap.h"
#include "runtime/ground/result/result.h"

namespace stepwright::reader {

// Why the verifier refused these bytes. `name` stands in the diagnostic (a path, or "download"). Codes: B0001
// not a container, B0002 another format version, B0003 truncated or too long, B0004 damaged, B0005 anything
// else.
result::Diagnostic refusal(std::span<const std::byte> bytes, const bytecode::VerifyResult& verdict,
                           const std::string& name);

class LoadedProgram {
 public:
  // Fails with the `refusal`.
  [[nodiscard]] static result::Result<LoadedProgram> load(std::vector<std::byte> bytes,
                                                          const std::string& name);

  // Reads the file first; B0006 if it cannot be read.
  [[nodiscard]] static result::Result<LoadedProgram> load_file(const std::string& path);

  LoadedProgram(LoadedProgram&&) = default;
  LoadedProgram& operator=(LoadedProgram&&) = default;

  const bytecode::Program& program() const { return program_; }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  LoadedProgram(std::vector<std::byte> bytes, const bytecode::Program& program)
      : bytes_(std::move(bytes)), program_(program) {}

  std::vector<std::byte> bytes_;  // a move keeps the buffer, so that the view stays valid
  bytecode::Program program_;
};

// The place in the sources that an instruction was compiled from; an empty location if the container has
// none.
result::Location source_location(const bytecode::Program& program, std::uint32_t function, std::uint32_t pc);

// Where the user finds what trapped: the place of the fault, or of the call if a function of the library
// noticed it.
result::Location trap_location(const bytecode::Program& program, const bytecode::Trap& trap);

// The trap as an error at that place, with a code of its own (bytecode::diagnostic_code_of). A place within
// the library stands in the message.
result::Diagnostic describe(const bytecode::Program& program, const bytecode::Trap& trap);

// A string of the container.
std::string text_of(const bytecode::ContainerView& container, bytecode::StringRef ref);

}  // namespace stepwright::reader
