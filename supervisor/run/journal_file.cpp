#include "supervisor/run/journal_file.h"

#include <cstddef>

#include "runtime/ground/files/durable_file.h"

namespace stepwright::run {
namespace {

constexpr std::size_t kLargest = std::size_t{256} << 20;  // bytes; a journal has some hundred thousand
constexpr files::Owner kWritten{"X0004", "is the state folder there, and is there room on the disk?"};
constexpr files::Owner kRead{
    "X0004", "a run may be under way that only it knows; mend its rights, or delete it to start afresh"};

void name_the_journal(result::Diagnostics& problems, const char* what) {
  problems.front().message.insert(0, what);
}

}  // namespace

result::Result<void> replace_journal_file(const std::filesystem::path& file, const std::string& text) {
  auto written = files::replace_file(file, text + '\n', kWritten);
  if (!written) name_the_journal(written.error(), "the journal cannot be written: ");
  return written;
}

result::Result<std::optional<std::string>> read_journal_file(const std::filesystem::path& file) {
  auto text = files::read_text(file, kLargest, kRead);
  if (!text) name_the_journal(text.error(), "the journal cannot be read: ");
  return text;
}

}  // namespace stepwright::run
