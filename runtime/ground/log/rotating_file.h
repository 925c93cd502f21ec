#pragma once

// A file that several processes append whole lines to, and that does not grow without end: who finds it
// longer than it may be renames it to FILE.1 (that to FILE.2, and so on, up to the number that is kept), and
// all go on in a new one. No line is lost or torn by that.
//
//   auto file = RotatingFile::open("cell.log", {.max_bytes = 16 << 20, .keep = 4});
//   if (file) (*file)->append("a line\n");
//
// A terminal, a pipe or another special file is never renamed. Threads: one at a time; processes: any number.

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace stepwright::log {

struct Rotation {
  std::uint64_t max_bytes = 16u << 20;  // 0: it may grow without end
  std::uint32_t keep = 4;               // older files beside it
  mode_t mode = 0644;                   // of a new one
};

class RotatingFile {
 public:
  // Fails with errno.
  static tl::expected<std::unique_ptr<RotatingFile>, int> open(const std::filesystem::path& file,
                                                               const Rotation& rotation);
  ~RotatingFile();
  RotatingFile(const RotatingFile&) = delete;
  RotatingFile& operator=(const RotatingFile&) = delete;

  // 0, or errno of a line that could not be written, or not whole.
  int append(std::string_view line);

 private:
  RotatingFile(std::filesystem::path file, const Rotation& rotation)
      : file_(std::move(file)), rotation_(rotation) {}
  int reopen();
  // Somebody else may have renamed it meanwhile.
  bool is_still_there() const;
  void rotate();

  std::filesystem::path file_;
  Rotation rotation_;
  int descriptor_ = -1;
};

}  // namespace stepwright::log
