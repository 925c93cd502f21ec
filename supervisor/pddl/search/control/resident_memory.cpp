#include "supervisor/pddl/search/control/resident_memory.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <string_view>

namespace stepwright::pddl {

std::size_t resident_bytes() {
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  std::array<char, 128> text{};
  const ssize_t n = read(file, text.data(), text.size());
  close(file);
  if (n <= 0) return 0;
  const std::string_view words(text.data(), static_cast<std::size_t>(n));
  const std::size_t blank = words.find(' ');  // the first number is the address space
  if (blank == std::string_view::npos) return 0;
  std::size_t pages = 0;
  std::from_chars(words.data() + blank + 1, words.data() + words.size(), pages);
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace stepwright::pddl
