#include "runtime/service/internal/downloads.h"

#include <algorithm>
#include <utility>

#include "runtime/host/limits.h"
#include "runtime/service/digest.h"

namespace stepwright::service::internal {

using host::kMaxChunkBytes;
using host::kMaxContainerBytes;

std::list<Downloads::Download>::iterator Downloads::find(std::uint64_t client) {
  return std::find_if(downloads_.begin(), downloads_.end(),
                      [client](const Download& download) { return download.client == client; });
}

result::Result<void> Downloads::begin(std::uint64_t client, const DownloadBegin& request) {
  if (request.total_bytes == 0 || request.total_bytes > kMaxContainerBytes) {
    return result::fail("R0004", {},
                        "a container of " + std::to_string(request.total_bytes) + " bytes is refused",
                        "1 to " + std::to_string(kMaxContainerBytes) + " bytes are possible");
  }
  if (const auto old = find(client); old != downloads_.end()) downloads_.erase(old);
  if (downloads_.size() == kMaxDownloads) downloads_.pop_back();
  Download download;
  download.client = client;
  download.digest = request.digest;
  download.bytes.resize(request.total_bytes);
  download.chunks.resize((request.total_bytes + kMaxChunkBytes - 1) / kMaxChunkBytes);
  downloads_.push_front(std::move(download));
  return {};
}

result::Result<void> Downloads::add(std::uint64_t client, const DownloadChunk& request) {
  const auto download = find(client);
  if (download == downloads_.end()) {
    return result::fail("R0003", {}, "a piece of a program arrived that nobody announced",
                        "begin the download again");
  }
  const std::size_t total = download->bytes.size();
  const bool inside = request.offset < total && request.offset % kMaxChunkBytes == 0;
  if (!inside || request.data.size() != std::min(kMaxChunkBytes, total - request.offset)) {
    return result::fail("R0004", {},
                        "a piece of " + std::to_string(request.data.size()) + " bytes at " +
                            std::to_string(request.offset) + " does not fit a program of " +
                            std::to_string(total) + " bytes");
  }
  std::copy(request.data.begin(), request.data.end(),
            download->bytes.begin() + static_cast<std::ptrdiff_t>(request.offset));
  download->chunks[request.offset / kMaxChunkBytes] = true;
  return {};
}

result::Result<std::vector<std::byte>> Downloads::commit(std::uint64_t client,
                                                         const DownloadCommit& request) {
  const auto found = find(client);
  if (found == downloads_.end() || found->digest != request.digest ||
      found->bytes.size() != request.total_bytes) {
    return result::fail("R0003", {}, "the download was never begun, or begun for another program",
                        "begin the download again");
  }
  Download download = std::move(*found);
  downloads_.erase(found);
  const auto arrived = std::count(download.chunks.begin(), download.chunks.end(), true);
  if (static_cast<std::size_t>(arrived) != download.chunks.size()) {
    return result::fail("R0003", {},
                        "the download was cut: " + std::to_string(arrived) + " of " +
                            std::to_string(download.chunks.size()) + " pieces arrived; nothing was changed",
                        "begin the download again");
  }
  if (sha256(download.bytes) != download.digest) {
    return result::fail("R0003", {}, "the program arrived damaged: its SHA-256 is not the announced one",
                        "begin the download again");
  }
  return std::move(download.bytes);
}

}  // namespace stepwright::service::internal
