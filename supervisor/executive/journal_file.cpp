#include "supervisor/executive/journal_file.h"

#include <fstream>
#include <sstream>
#include <system_error>

namespace stepwright::executive {

result::Result<void> replace_journal_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path fresh = file.string() + ".new";
  std::ofstream out(fresh, std::ios::trunc);
  out << text << '\n';
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(fresh, file, error);
  if (!out || error) {
    return result::fail("X0004", {file.string(), 0, 0}, "the journal cannot be written",
                        "is the state folder there, and is there room on the disk?");
  }
  return {};
}

std::optional<std::string> read_journal_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  std::stringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

}  // namespace stepwright::executive
