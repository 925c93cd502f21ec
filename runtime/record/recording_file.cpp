#include "runtime/record/recording_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "runtime/record/recording_format.h"

namespace stepwright::record {
namespace {

constexpr std::size_t kChunkBytes = 64u << 10;

// A recording, or an empty file: what may be put aside, or given up for a newer one.
bool is_recording(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  FileHeader found{};
  const ssize_t size = ::read(file, found.magic.data(), found.magic.size());
  ::close(file);
  return size == 0 || (size == static_cast<ssize_t>(found.magic.size()) && found.magic == FileHeader{}.magic);
}

}  // namespace

tl::unexpected<result::Diagnostics> RecordingFile::failed(int error) const {
  return result::fail("R0051", {path_.string(), 0, 0},
                      std::string("the recording cannot be written: ") + std::strerror(error),
                      error == ENOSPC ? "make room, or bound it with [record] max_mb" : "");
}

result::Result<std::unique_ptr<RecordingFile>> RecordingFile::create(const std::filesystem::path& path) {
  std::unique_ptr<RecordingFile> self(new RecordingFile(path, -1));
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0) {
    // Devices and folders are nobody's recording.
    if (!S_ISREG(info.st_mode)) return self->failed(S_ISDIR(info.st_mode) ? EISDIR : EINVAL);
    const std::string aside = path.string() + ".1";
    for (const std::string& each : {path.string(), aside}) {
      if (::stat(each.c_str(), &info) != 0 || is_recording(each)) continue;
      return result::fail("R0051", {each, 0, 0}, "this is no recording: it is neither moved nor replaced",
                          "name a file for the recording alone");
    }
    if (::rename(path.c_str(), aside.c_str()) != 0) return self->failed(errno);
  }
  self->descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (self->descriptor_ < 0) return self->failed(errno);
  const FileHeader header;
  auto written = self->write(std::as_bytes(std::span(&header, 1)));
  if (!written) return result::forward(written);
  return self;
}

RecordingFile::~RecordingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

result::Result<void> RecordingFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return failed(count == 0 ? ENOSPC : errno);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    bytes_ += static_cast<std::uint64_t>(count);
  }
  return {};
}

result::Result<void> RecordingFile::add(std::span<const std::byte> record) {
  // A record of its own size would make the chunk too large: it begins the next one.
  if (chunk_.size() + record.size() + kMaxVarintBytes > kMaxChunkPayload) {
    if (auto flushed = flush(); !flushed) return flushed;
  }
  if (chunk_.empty()) chunk_.resize(sizeof(ChunkHeader));
  std::array<std::byte, kMaxVarintBytes> buffer;
  Encoder length(buffer);
  length.put_varint(record.size());
  chunk_.insert(chunk_.end(), length.bytes().begin(), length.bytes().end());
  chunk_.insert(chunk_.end(), record.begin(), record.end());
  return chunk_.size() < kChunkBytes ? result::Result<void>() : flush();
}

result::Result<void> RecordingFile::flush() {
  if (chunk_.empty()) return {};
  const auto payload = std::span<const std::byte>(chunk_).subspan(sizeof(ChunkHeader));
  ChunkHeader header;
  header.sequence = sequence_++;
  header.bytes = static_cast<std::uint32_t>(payload.size());
  header.crc = chunk_crc(header, payload);
  std::memcpy(chunk_.data(), &header, sizeof header);
  auto written = write(chunk_);
  chunk_.clear();
  return written;
}

result::Result<void> RecordingFile::close() {
  if (auto flushed = flush(); !flushed) return flushed;
  const bool synced = ::fdatasync(descriptor_) == 0 || errno == EINVAL || errno == EROFS;
  const int error = errno;
  ::close(std::exchange(descriptor_, -1));
  if (!synced) return failed(error);
  return {};
}

}  // namespace stepwright::record
