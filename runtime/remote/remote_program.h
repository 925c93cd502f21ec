#pragma once

// A verified program as the gateway knows it: the bytes that the controller runs, and what of them is needed
// to speak about its image. Immutable; any thread.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/bool_bytes.h"
#include "runtime/remote/controller_blocks.h"

namespace stepwright::remote {

class RemoteProgram {
 public:
  // Fails with the diagnostics of the verifier (B0001 to B0005), with R0021 (host::BoolBytes), or with R0145
  // if a turn of the register protocol cannot carry its inputs and outputs.
  [[nodiscard]] static result::Result<std::shared_ptr<const RemoteProgram>> create(
      std::vector<std::byte> container, std::string digest);

  // Whether it has room in a cell with areas of these sizes. Fails with R0145.
  [[nodiscard]] result::Result<void> check_fit(std::size_t input_bytes, std::size_t output_bytes) const;

  const std::string& digest() const { return digest_; }  // hexadecimal SHA-256 of the container
  ProgramDigest digest_bytes() const;
  std::span<const std::byte> bytes() const { return loaded_.bytes(); }
  const bytecode::Program& program() const { return loaded_.program(); }
  const bytecode::SizesRecord& sizes() const { return loaded_.program().sizes(); }
  std::uint32_t image_bytes() const { return loaded_.program().image_size(); }
  const host::BoolBytes& bools() const { return bools_; }
  // Of its fastest task; 0 if none is cyclic.
  std::int64_t interval_ns() const { return interval_ns_; }

 private:
  RemoteProgram(reader::LoadedProgram loaded, host::BoolBytes bools, std::string digest);

  reader::LoadedProgram loaded_;
  host::BoolBytes bools_;
  std::string digest_;
  std::int64_t interval_ns_ = 0;
};

}  // namespace stepwright::remote
