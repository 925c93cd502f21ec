#pragma once

// Result of the verifier: whether and where it refuses a container, and why. Plain values; any thread.

#include <cstdint>

#include "runtime/bytecode/container_format.h"

namespace stepwright::bytecode {

enum class VerifyStatus : std::uint8_t {
  Ok,
  NotAContainer,
  WrongVersion,
  Truncated,
  TrailingBytes,
  TooLarge,
  BadChecksum,
  BadSectionTable,
  BadRecord,
  BadString,
  BadType,
  BadAddress,
  BadOpcode,
  BadOperand,
  BadJump,
  StackUnderflow,
  StackType,
  StackJoin,
  MissingReturn,
  BadCall,
  BadFrame,
  Recursion,
  WrongSizes,
  ScratchTooSmall,
};

// For code `section` is Functions, `index` the function and `offset` the instruction's byte offset in it.
// For tables `index` is the record. For the file as a whole `offset` is a byte of the file.
struct VerifyResult {
  VerifyStatus status = VerifyStatus::Ok;
  Section section = Section::Sizes;
  std::uint32_t index = 0;
  std::uint32_t offset = 0;

  bool ok() const { return status == VerifyStatus::Ok; }
};

// One clause of plain English, e.g. "a bit is flipped or bytes are missing (the checksum differs)".
const char* explain(VerifyStatus status);

}  // namespace stepwright::bytecode
