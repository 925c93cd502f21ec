#pragma once

// The one log of a cell that is up: a line for each line of its processes, with the name of who says it, in a
// colour of its own on a terminal.
//
//   Console console({"hmi", "link", "runtime"});
//   console.line("link", "listens");          // "link     | listens"
//
// Threads: one. What cannot be written is lost.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/log/rotating_file.h"

namespace stepwright::up {

class Console {
 public:
  // To standard output, in colour if that is a terminal and NO_COLOR is not set; or to `file`.
  explicit Console(const std::vector<std::string>& names, std::unique_ptr<log::RotatingFile> file = nullptr);

  // Each line of the text in one of its own.
  void line(std::string_view name, std::string_view text);
  // What `stepwright up` itself has to say.
  void say(std::string_view text) { line(kOwn, text); }

  static constexpr const char* kOwn = "up";

 private:
  std::unique_ptr<log::RotatingFile> file_;
  std::size_t width_ = 0;                            // of the longest name
  std::map<std::string, int, std::less<>> colours_;  // of the terminal; empty: none
};

}  // namespace stepwright::up
