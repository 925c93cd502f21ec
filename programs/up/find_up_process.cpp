#include "programs/up/find_up_process.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace stepwright::up {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "stepwright-up";

std::vector<std::string> arguments_of(const fs::path& process) {
  std::ifstream file(process / "cmdline", std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> words;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find('\0', at), all.size());
    words.push_back(all.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

// What `up` was asked for; nothing if this is another command.
std::optional<Options> options_of(const std::vector<std::string>& words) {
  const auto command = std::ranges::find(words, "up");
  if (command == words.end() || command - words.begin() > 1) return std::nullopt;
  Options options;
  for (auto at = command + 1; at != words.end(); ++at) {
    const bool set = *at == "--set";
    if (set || *at == "--port") {
      if (++at == words.end()) break;
      if (set) options.overrides.push_back(*at);
    } else if (at->starts_with("--set=")) {
      options.overrides.push_back(at->substr(6));
    } else if (!at->starts_with("-")) {
      options.cell = *at;
    }
  }
  return options;
}

std::set<std::string> overrides_of_cell(const Options& options) {
  std::set<std::string> all;
  for (const std::string& each : options.overrides)
    if (each.starts_with("cell.")) all.insert(each);
  return all;
}

fs::path whole(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  return error ? path.lexically_normal() : real;
}

// Of another user, or just gone: neither can be read.
bool keeps(const fs::path& process, const Options& wanted, const fs::path& file) {
  std::error_code hidden;
  if (!fs::read_symlink(process / "exe", hidden).filename().string().starts_with(kProgram)) return false;
  const auto options = options_of(arguments_of(process));
  const fs::path folder = fs::read_symlink(process / "cwd", hidden);
  return options && !hidden && whole(folder / options->cell) == file &&
         overrides_of_cell(*options) == overrides_of_cell(wanted);
}

}  // namespace

std::optional<pid_t> find_up_process(const Options& options) {
  std::error_code failed;
  const fs::path file = whole(fs::absolute(options.cell, failed));
  for (const auto& entry : fs::directory_iterator("/proc", failed)) {
    const std::string name = entry.path().filename().string();
    if (!std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) continue;
    const auto pid = static_cast<pid_t>(std::strtol(name.c_str(), nullptr, 10));
    if (pid != getpid() && keeps(entry.path(), options, file)) return pid;
  }
  return std::nullopt;
}

}  // namespace stepwright::up
