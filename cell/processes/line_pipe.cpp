#include "cell/processes/line_pipe.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace stepwright::processes {
namespace {

constexpr std::size_t kLongestLine = 16 << 10;

void close_end(int& end) {
  if (end >= 0) ::close(end);
  end = -1;
}

}  // namespace

result::Result<LinePipe> LinePipe::open() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return result::fail("M0014", {}, std::string("the system gives no pipe: ") + std::strerror(errno));
  LinePipe pipe;
  pipe.reading_ = ends[0];
  pipe.writing_ = ends[1];
  fcntl(pipe.reading_, F_SETFL, O_NONBLOCK);
  return pipe;
}

LinePipe::~LinePipe() {
  close_end(reading_);
  close_end(writing_);
}

LinePipe::LinePipe(LinePipe&& other) noexcept
    : reading_(std::exchange(other.reading_, -1)),
      writing_(std::exchange(other.writing_, -1)),
      begun_(std::move(other.begun_)) {}

LinePipe& LinePipe::operator=(LinePipe&& other) noexcept {
  std::swap(reading_, other.reading_);
  std::swap(writing_, other.writing_);
  std::swap(begun_, other.begun_);
  return *this;
}

std::vector<std::string> LinePipe::lines() {
  std::vector<std::string> whole;
  std::array<char, 4'096> piece{};
  while (reading_ >= 0) {
    const ssize_t length = read(reading_, piece.data(), piece.size());
    if (length <= 0) break;
    for (ssize_t i = 0; i < length; ++i) {
      const char c = piece[static_cast<std::size_t>(i)];
      if (c != '\n') begun_ += c;
      if (c == '\n' || begun_.size() >= kLongestLine) whole.push_back(std::exchange(begun_, {}));
    }
  }
  return whole;
}

std::vector<std::string> LinePipe::last_lines() {
  std::vector<std::string> all = lines();
  if (!begun_.empty()) all.push_back(std::exchange(begun_, {}));
  return all;
}

}  // namespace stepwright::processes
