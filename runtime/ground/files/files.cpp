#include "runtime/ground/files/files.h"

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <span>

#include "runtime/ground/files/internal/replacement.h"

namespace stepwright::files {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kBlock = 64 * 1024;  // read at once

// `reason`: an errno.
result::Diagnostics unwritten(const std::string& path, int reason, const std::string& what = {}) {
  const bool is_full = reason == ENOSPC || reason == EDQUOT;
  return {{"E0002",
           result::Severity::Error,
           {path, 0, 0},
           "the file cannot be written: " + what + std::strerror(reason),
           is_full ? "the disk is full: make room there" : "its folder must exist and take a new file"}};
}

tl::unexpected<result::Diagnostics> unread(const std::string& path, int reason) {
  const std::string why = reason == 0 ? std::string() : std::string(": ") + std::strerror(reason);
  return result::fail("E0001", {path, 0, 0}, "cannot read the file" + why);
}

// "-" is standard output.
std::string place_of(const std::string& path) {
  return path == "-" ? "/dev/stdout" : path;
}

bool write_to_stream(const fs::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(file.flush());
}

// Where the bytes belong: behind a link, so that the link stays one.
fs::path behind_links(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? fs::path(path) : real;
}

// The system's error, and 0 if all of it is there.
int write_whole(const std::string& path, std::string_view bytes) {
  if (is_stream(path)) return write_to_stream(path, bytes) ? 0 : errno;
  // A command can be run again: it does not wait for the disk.
  return internal::replace(behind_links(path), std::as_bytes(std::span(bytes)),
                           {.beside = ".part", .durable = false});
}

}  // namespace

bool is_stream(const std::string& path) {
  if (path == "-" || path.starts_with("/dev/") || path.starts_with("/proc/")) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

result::Result<std::ifstream> open_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) {
    return result::fail("E0001", {path, 0, 0}, "cannot read what is no regular file",
                        "a pipe or a device may have no end: write it to a file first");
  }
  if (fs::is_directory(status)) return unread(path, EISDIR);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return unread(path, errno);
  return file;
}

result::Result<std::string> read_file(const std::string& path, std::uintmax_t most_bytes) {
  auto file = open_file(path);
  if (!file) return result::forward(file);
  const auto too_large = [&] {
    return result::fail("E0001", {path, 0, 0},
                        "the file has more than " + std::to_string(most_bytes >> 10) + " KiB",
                        "is this the file that was meant?");
  };
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return unread(path, error.value());
  if (size > most_bytes) return too_large();
  // Files of /proc have a size of 0, and others may grow.
  std::string text;
  for (std::uintmax_t step = size + 1; *file && text.size() <= most_bytes; step = kBlock) {
    const std::size_t had = text.size();
    text.resize(had + static_cast<std::size_t>(step));
    file->read(text.data() + had, static_cast<std::streamsize>(step));
    text.resize(had + static_cast<std::size_t>(file->gcount()));
  }
  if (file->bad()) return unread(path, errno);
  if (text.size() > most_bytes) return too_large();
  return text;
}

result::Diagnostics write_file(const std::string& given, std::string_view bytes) {
  const std::string path = place_of(given);
  const int error = write_whole(path, bytes);
  return error == 0 ? result::Diagnostics{} : unwritten(path, error);
}

result::Result<void> write_file(const std::string& given, std::string_view bytes, const Owner& owner) {
  const std::string path = place_of(given);
  const int error = write_whole(path, bytes);
  if (error != 0) return failed(owner, path, "the file cannot be written", error);
  return {};
}

result::Diagnostics check_writable(const std::string& given) {
  const std::string path = place_of(given);
  std::error_code error;
  if (fs::is_directory(path, error)) return unwritten(path, EISDIR);
  if (is_stream(path)) {
    return access(path.c_str(), W_OK) == 0 ? result::Diagnostics{} : unwritten(path, errno);
  }
  const fs::path folder = behind_links(path).parent_path();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK) == 0) return {};
  return unwritten(path, errno, "its folder: ");
}

bool is_xml(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".xml";
}

}  // namespace stepwright::files
