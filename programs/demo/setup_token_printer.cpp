#include "programs/demo/setup_token_printer.h"

#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "cell/processes/setup_token.h"

namespace stepwright::demo {
namespace {

std::uintmax_t size_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  return error ? 0 : size;
}

}  // namespace

SetupTokenPrinter::SetupTokenPrinter(std::filesystem::path log)
    : log_(std::move(log)), told_(size_of(log_)) {}

void SetupTokenPrinter::look() {
  if (size_of(log_) <= told_) return;
  std::ifstream file(log_);
  file.seekg(static_cast<std::streamoff>(told_));
  // The last line may still be written.
  for (std::string line; std::getline(file, line) && !file.eof();) {
    told_ += line.size() + 1;
    const auto token = processes::setup_token_of(line);
    if (!token) continue;
    std::printf("To act on the page, log in there with the set-up token %s (once).\n", token->c_str());
    std::fflush(stdout);
  }
}

}  // namespace stepwright::demo
