#pragma once

// Containers on their way in: one per client, filled chunk by chunk, handed out only when whole and of the
// announced digest.
//
// Threads: one. Bounded in number and size; a client that begins again drops what it had.

#include <cstddef>
#include <cstdint>
#include <list>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/service/requests.h"

namespace stepwright::service::internal {

class Downloads {
 public:
  static constexpr std::size_t kMaxDownloads = 4;  // the oldest gives way

  // R0004: empty or larger than a container can be.
  [[nodiscard]] result::Result<void> begin(std::uint64_t client, const DownloadBegin& request);
  // R0003: nothing was begun; R0004: not a chunk of kMaxChunkBytes at a multiple of it (the last one is
  // shorter).
  [[nodiscard]] result::Result<void> add(std::uint64_t client, const DownloadChunk& request);
  // The whole container; the download is over, whatever comes out. R0003: not begun like this, cut, or
  // damaged.
  [[nodiscard]] result::Result<std::vector<std::byte>> commit(std::uint64_t client,
                                                              const DownloadCommit& request);

 private:
  struct Download {
    std::uint64_t client = 0;
    Sha256 digest{};
    std::vector<std::byte> bytes;
    std::vector<bool> chunks;  // that arrived
  };
  std::list<Download>::iterator find(std::uint64_t client);

  std::list<Download> downloads_;  // the newest first
};

}  // namespace stepwright::service::internal
