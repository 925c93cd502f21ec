#include "programs/up/detached.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace stepwright::up {
namespace {

// What a cell says until it is ready, and more; less of it on a disk that has no more. What was kept for the
// log of before counts as free.
constexpr std::array<off_t, 5> kRoomBytes = {256 * 1'024, 240 * 1'024, 192 * 1'024, 128 * 1'024, 64 * 1'024};
// Of the record of the cell, which is written next.
constexpr off_t kRecordBytes = 16 * 1'024;

tl::unexpected<result::Diagnostics> failure(const std::string& what) {
  return result::fail("M0014", {}, what + ": " + std::strerror(errno));
}

// A disk that is full fails here, where somebody hears of it. Not every file system can keep room.
bool keep_room(int file, off_t bytes) {
  return fallocate(file, FALLOC_FL_KEEP_SIZE, 0, bytes) == 0 || (errno != ENOSPC && errno != EDQUOT);
}

// So that the log leaves it to the record. False with errno.
bool keep_room_beside_record(int file, const std::filesystem::path& log) {
  const std::filesystem::path record = log.string() + ".room";
  const int held = open(record.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (held < 0) return errno != ENOSPC && errno != EDQUOT;
  const bool kept = keep_room(held, kRecordBytes) &&
                    std::ranges::any_of(kRoomBytes, [file](off_t bytes) { return keep_room(file, bytes); });
  const int reason = errno;
  close(held);
  unlink(record.c_str());
  errno = reason;
  return kept;
}

void print(const std::filesystem::path& log, std::FILE* out) {
  std::ifstream file(log);
  for (std::string line; std::getline(file, line);) std::fprintf(out, "%s\n", line.c_str());
  std::fflush(out);
}

// Its exit code, or that of a fault if it was killed.
int exit_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : to_int(result::ExitCode::RuntimeFault);
}

}  // namespace

Detached::~Detached() {
  if (waiter_ >= 0) close(waiter_);
}

result::Result<std::optional<int>> Detached::leave(const std::filesystem::path& log) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) return failure("the log " + log.string() + " cannot be opened");
  if (!keep_room_beside_record(file, log)) {
    const int reason = errno;
    close(file);
    return result::fail("M0022", {log.string(), 0, 0},
                        std::string("the log cannot be written: ") + std::strerror(reason),
                        "make room, or name another folder: [cell] state_dir");
  }
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return failure("the system gives no pipe");
  const pid_t child = fork();
  if (child < 0) return failure("cannot fork");
  if (child == 0) {
    close(ends[0]);
    waiter_ = ends[1];
    setsid();
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing >= 0) dup2(nothing, STDIN_FILENO);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    return std::optional<int>();
  }
  close(ends[1]);
  close(file);
  char word = 0;
  ssize_t length = 0;
  while ((length = read(ends[0], &word, 1)) < 0 && errno == EINTR) {
  }
  close(ends[0]);
  const int exit = length == 1 ? word : exit_of(child);
  print(log, exit == to_int(result::ExitCode::Done) ? stdout : stderr);
  return std::optional(exit);
}

void Detached::up(result::ExitCode exit) {
  if (waiter_ < 0) return;
  const char word = static_cast<char>(to_int(exit));
  [[maybe_unused]] const ssize_t written = write(waiter_, &word, 1);
  close(waiter_);
  waiter_ = -1;
}

}  // namespace stepwright::up
