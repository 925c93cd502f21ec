#pragma once

// Containers with a record changed and the checksum put right: what a faulty compiler could write.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <vector>

#include "runtime/bytecode/container_parse.h"
#include "runtime/bytecode/program.h"

namespace stepwright::bytecode {

inline VerifyResult verify_bytes(std::span<const std::byte> bytes) {
  // A copy in its own allocation, so that a sanitizer sees every read beyond the end.
  const std::vector<std::byte> exact(bytes.begin(), bytes.end());
  std::vector<std::uint32_t> scratch(verify_scratch_words(exact));
  Program program;
  return verify(exact, scratch, program);
}

inline void fix_checksum(std::vector<std::byte>& bytes) {
  if (bytes.size() < sizeof(FileHeader)) return;
  const std::uint64_t checksum = container_checksum(bytes);
  std::memcpy(bytes.data() + 16, &checksum, sizeof(checksum));
}

inline SectionEntry entry_of(const std::vector<std::byte>& bytes, Section section) {
  SectionEntry entry;
  std::memcpy(&entry, bytes.data() + sizeof(FileHeader) + static_cast<std::size_t>(section) * sizeof(entry),
              sizeof(entry));
  return entry;
}

template <Section S>
VerifyResult verify_changed(std::vector<std::byte> bytes, std::uint32_t index,
                            const std::function<void(Record<S>&)>& change) {
  std::byte* const at = bytes.data() + entry_of(bytes, S).offset + index * sizeof(Record<S>);
  Record<S> record;
  std::memcpy(&record, at, sizeof(record));
  change(record);
  std::memcpy(at, &record, sizeof(record));
  fix_checksum(bytes);
  return verify_bytes(bytes);
}

}  // namespace stepwright::bytecode
