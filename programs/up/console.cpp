#include "programs/up/console.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace stepwright::up {
namespace {

// Cyan, green, yellow, blue, magenta: red is left to what is wrong.
constexpr std::array kColours = {36, 32, 33, 34, 35};

// What a terminal would obey.
std::string harmless(std::string_view text) {
  std::string clean(text);
  for (char& c : clean)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F) c = '?';
  return clean;
}

}  // namespace

Console::Console(const std::vector<std::string>& names, std::unique_ptr<log::RotatingFile> file)
    : file_(std::move(file)), width_(std::char_traits<char>::length(kOwn)) {
  for (const std::string& name : names) width_ = std::max(width_, name.size());
  if (file_ || isatty(STDOUT_FILENO) == 0 || std::getenv("NO_COLOR") != nullptr) return;
  for (std::size_t i = 0; i < names.size(); ++i) colours_[names[i]] = kColours[i % kColours.size()];
}

void Console::line(std::string_view name, std::string_view text) {
  std::string head(name);
  head.resize(std::max(width_, name.size()), ' ');
  head += " |";
  if (const auto colour = colours_.find(name); colour != colours_.end()) {
    head.insert(0, "\x1b[" + std::to_string(colour->second) + "m");
    head += "\x1b[0m";
  }
  // A diagnostic's hint stands in a line of its own.
  std::string whole;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    whole += head + " " + harmless(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  if (file_) return static_cast<void>(file_->append(whole));
  std::fwrite(whole.data(), 1, whole.size(), stdout);
  std::fflush(stdout);
}

}  // namespace stepwright::up
