#include "supervisor/run/journal_file.h"

#include <cstddef>
#include <span>

#include "runtime/record/durable_file.h"

namespace stepwright::run {
namespace {

constexpr std::size_t kLargest = std::size_t{256} << 20;  // bytes; a journal has some hundred thousand

}  // namespace

result::Result<void> replace_journal_file(const std::filesystem::path& file, const std::string& text) {
  const std::string whole = text + '\n';
  const auto written = record::replace_file(file, std::as_bytes(std::span(whole)));
  if (written) return {};
  return result::fail("X0004", {file.string(), 0, 0},
                      "the journal cannot be written: " + written.error().front().message,
                      "is the state folder there, and is there room on the disk?");
}

result::Result<std::optional<std::string>> read_journal_file(const std::filesystem::path& file) {
  const auto bytes = record::read_whole(file, kLargest);
  if (!bytes)
    return result::fail(
        "X0004", {file.string(), 0, 0}, "the journal cannot be read: " + bytes.error().front().message,
        "a run may be under way that only it knows; mend its rights, or delete it to start afresh");
  if (!*bytes) return std::optional<std::string>();
  return std::string(reinterpret_cast<const char*>((*bytes)->data()), (*bytes)->size());
}

}  // namespace stepwright::run
