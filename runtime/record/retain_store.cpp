#include "runtime/record/retain_store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>

#include "runtime/base/crc32c.h"
#include "runtime/base/hash64.h"
#include "runtime/ground/files/durable_file.h"
#include "runtime/record/stored_values.h"

namespace stepwright::record {
namespace {

// The bytes of the file, little-endian. Slots begin at multiples of 4096, so that a write to one never
// touches a block of the other. A slot is the one that its sequence says: even ones are the first.
struct FileHeader {
  char magic[8];  // "SWRETAIN"
  std::uint16_t version;
  std::uint16_t reserved;  // 0
  std::uint32_t layout_bytes;
  std::uint32_t payload_bytes;
  std::uint32_t crc;  // of this header with 0 here, and the layout behind it
};
struct SlotHeader {
  std::uint32_t magic;  // "SWRS"
  std::uint32_t crc;    // of this header with 0 here, and the payload behind it
  std::uint64_t sequence;
  std::uint64_t layout_digest;
  std::uint32_t payload_bytes;
  std::uint32_t reserved;  // 0
};
static_assert(sizeof(FileHeader) == 24 && sizeof(SlotHeader) == 32);

constexpr files::Owner kStore{"R0024"};
constexpr char kFileMagic[8] = {'S', 'W', 'R', 'E', 'T', 'A', 'I', 'N'};
constexpr std::uint32_t kSlotMagic = 0x53525753;
constexpr std::size_t kBlock = 4096;
// An image of 1 MiB twice and the longest paths that its variables may have.
constexpr std::size_t kMaxFileBytes = std::size_t{320} << 20;

std::size_t aligned(std::size_t size) {
  return (size + kBlock - 1) / kBlock * kBlock;
}

std::size_t first_slot(std::size_t layout_bytes) {
  return aligned(sizeof(FileHeader) + layout_bytes);
}

std::size_t slot_stride(std::size_t payload_bytes) {
  return aligned(sizeof(SlotHeader) + payload_bytes);
}

template <typename T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span<const T, 1>(&value, 1));
}

// Of a header whose own sum is 0, and of what stands behind it.
template <typename Header>
std::uint32_t sum_of(const Header& header, std::span<const std::byte> behind) {
  return base::crc32c(behind, base::crc32c(bytes_of(header)));
}

// Header and payload of a slot, as they lie in the file.
void fill_slot(std::vector<std::byte>& out, std::uint64_t sequence, std::uint64_t digest,
               std::span<const std::byte> payload) {
  SlotHeader header{kSlotMagic, 0, sequence, digest, static_cast<std::uint32_t>(payload.size()), 0};
  header.crc = sum_of(header, payload);
  out.resize(sizeof header + payload.size());
  std::memcpy(out.data(), &header, sizeof header);
  if (!payload.empty()) std::memcpy(out.data() + sizeof header, payload.data(), payload.size());
}

struct Slot {
  std::uint64_t sequence = 0;
  std::span<const std::byte> payload;
};

std::optional<Slot> read_slot(std::span<const std::byte> file, std::size_t at, std::uint32_t payload_bytes,
                              std::uint64_t digest, unsigned index) {
  SlotHeader header{};
  if (at > file.size() || file.size() - at < sizeof header + payload_bytes) return std::nullopt;
  std::memcpy(&header, file.data() + at, sizeof header);
  const auto payload = file.subspan(at + sizeof header, payload_bytes);
  const std::uint32_t crc = std::exchange(header.crc, 0);
  const bool ours = header.magic == kSlotMagic && header.reserved == 0 && header.sequence % 2 == index &&
                    header.payload_bytes == payload_bytes && header.layout_digest == digest;
  if (!ours || sum_of(header, payload) != crc) return std::nullopt;
  return Slot{header.sequence, payload};
}

tl::unexpected<result::Diagnostics> damaged(const std::filesystem::path& path, const std::string& what,
                                            const char* hint = "") {
  return result::fail("R0023", {path.string(), 0, 0}, what, hint);
}

// Where a store may have its slots: enough for the names of the largest program.
constexpr std::size_t kMostBlocks = 16'384;

// The first bytes are those of a store, as far as there are any, or a slot of one stands at a block: a store
// stays one when its header is damaged.
bool is_store(int file, std::size_t size) {
  char begin[sizeof kFileMagic] = {};
  const std::size_t known = std::min(size, sizeof begin);
  if (pread(file, begin, known, 0) == static_cast<ssize_t>(known) &&
      std::memcmp(begin, kFileMagic, known) == 0)
    return true;
  for (std::size_t block = 1; block < kMostBlocks && block * kBlock < size; ++block) {
    std::uint32_t magic = 0;
    const auto at = static_cast<off_t>(block * kBlock);
    if (pread(file, &magic, sizeof magic, at) == sizeof magic && magic == kSlotMagic) return true;
  }
  return false;
}

// A name beside the store that nothing has.
std::filesystem::path free_name(const std::filesystem::path& path) {
  std::filesystem::path aside = path.string() + ".damaged";
  struct stat info {};
  for (int number = 2; lstat(aside.c_str(), &info) == 0; ++number)
    aside = path.string() + ".damaged-" + std::to_string(number);
  return aside;
}

}  // namespace

result::Result<void> RetainStore::check_place(const std::filesystem::path& path) {
  const auto refused = [&](const char* what) {
    return result::fail(kStore.code, {path.string(), 0, 0},
                        std::string(what) + ": it is neither replaced nor moved",
                        "[retain] file names a file for retained values alone");
  };
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0 && errno == ENOENT) return {};
  if (file < 0) return files::failed(kStore, path, "the store cannot be read", errno);
  struct stat info {};
  const bool known = fstat(file, &info) == 0;
  const bool plain = known && S_ISREG(info.st_mode);
  const bool ours = plain && is_store(file, static_cast<std::size_t>(info.st_size));
  close(file);
  if (ours) return {};
  if (plain) return refused("this file is no store of retained values");
  return refused(known && S_ISDIR(info.st_mode) ? "this is a folder" : "this is no plain file");
}

result::Result<std::optional<StoredState>> RetainStore::read(const std::filesystem::path& path) {
  auto content = files::read_bytes(path, kMaxFileBytes, kStore);
  if (!content) return result::forward(content);
  if (!*content) return std::nullopt;
  const std::span<const std::byte> file = **content;
  FileHeader header{};
  if (file.size() < sizeof header)
    return damaged(path, "the store ends within its header, at byte " + std::to_string(file.size()));
  std::memcpy(&header, file.data(), sizeof header);
  if (std::memcmp(header.magic, kFileMagic, sizeof kFileMagic) != 0) {
    return damaged(path, "byte 0: this is no store of retained values");
  }
  if (header.version != kVersion) {
    return damaged(path, "byte 8: the store has version " + std::to_string(header.version) +
                             ", this runtime reads " + std::to_string(kVersion));
  }
  if (header.layout_bytes > file.size() - sizeof header) {
    return damaged(path,
                   "the store ends within the names of its values, at byte " + std::to_string(file.size()));
  }
  const auto names = file.subspan(sizeof header, header.layout_bytes);
  const std::uint32_t crc = std::exchange(header.crc, 0);
  if (sum_of(header, names) != crc) {
    return damaged(path, "bytes 0 to " + std::to_string(sizeof header + names.size() - 1) +
                             ": the names of the values do not fit their checksum");
  }
  auto layout = StateLayout::decode(names);
  if (!layout || layout->size() != header.payload_bytes) {
    return damaged(path, "byte " + std::to_string(sizeof header) + ": the names of the values make no sense");
  }
  const std::uint64_t digest = base::hash_bytes(names);
  const std::size_t places[2] = {first_slot(names.size()),
                                 first_slot(names.size()) + slot_stride(header.payload_bytes)};
  std::string wrong;  // why a copy with the right sum is not used
  const auto copy = [&](unsigned index) {
    auto slot = read_slot(file, places[index], header.payload_bytes, digest, index);
    const std::string value = slot ? wrong_value(*layout, slot->payload) : std::string();
    if (value.empty()) return slot;
    wrong = "; " + value;
    slot.reset();
    return slot;
  };
  const auto a = copy(0);
  const auto b = copy(1);
  if (!a && !b) {
    const char* const what = wrong.empty() ? ": neither copy of the values fits its checksum"
                                           : ": neither copy of the values can be used";
    return damaged(path,
                   "bytes " + std::to_string(places[0]) + " and " + std::to_string(places[1]) + what + wrong);
  }
  const Slot& newest = a && (!b || a->sequence > b->sequence) ? *a : *b;
  StoredState state{std::move(*layout), {newest.payload.begin(), newest.payload.end()}, newest.sequence, {}};
  if (!a || !b) {
    state.damage =
        "byte " + std::to_string(places[a ? 1 : 0]) + ": one copy of the values is damaged" + wrong;
  }
  return state;
}

result::Result<RetainStore> RetainStore::create(const std::filesystem::path& path, const StateLayout& layout,
                                                std::span<const std::byte> payload, std::uint64_t sequence) {
  assert(payload.size() == layout.size());
  if (auto place = check_place(path); !place) return result::forward(place);
  const std::vector<std::byte> names = layout.encoded();
  FileHeader header{};
  std::memcpy(header.magic, kFileMagic, sizeof kFileMagic);
  header.version = kVersion;
  header.layout_bytes = static_cast<std::uint32_t>(names.size());
  header.payload_bytes = layout.size();
  header.crc = sum_of(header, names);
  // Both slots are written, so that no later write needs more room on the disk.
  std::vector<std::byte> file(first_slot(names.size()) + 2 * slot_stride(payload.size()));
  std::memcpy(file.data(), &header, sizeof header);
  std::memcpy(file.data() + sizeof header, names.data(), names.size());
  std::vector<std::byte> slot;
  for (const std::uint64_t each : {sequence, sequence + 1}) {
    fill_slot(slot, each, base::hash_bytes(names), payload);
    const std::size_t at = first_slot(names.size()) + (each % 2) * slot_stride(payload.size());
    std::memcpy(file.data() + at, slot.data(), slot.size());
  }
  if (auto replaced = files::replace_file(path, file, kStore); !replaced) return result::forward(replaced);
  RetainStore store;
  store.sequence_ = sequence + 1;
  if (auto opened = store.open(path, layout); !opened) return result::forward(opened);
  return store;
}

result::Result<RetainStore> RetainStore::resume(const std::filesystem::path& path, const StoredState& state) {
  RetainStore store;
  store.sequence_ = state.sequence;
  if (auto opened = store.open(path, state.layout); !opened) return result::forward(opened);
  return store;
}

result::Result<std::filesystem::path> RetainStore::set_aside(const std::filesystem::path& path) {
  if (auto place = check_place(path); !place) return result::forward(place);
  const std::filesystem::path aside = free_name(path);
  if (rename(path.c_str(), aside.c_str()) != 0)
    return files::failed(kStore, path, "the store cannot be moved aside", errno);
  return aside;
}

result::Result<void> RetainStore::open(const std::filesystem::path& path, const StateLayout& layout) {
  path_ = path;
  const std::vector<std::byte> names = layout.encoded();
  digest_ = base::hash_bytes(names);
  payload_bytes_ = layout.size();
  first_slot_ = first_slot(names.size());
  slot_stride_ = slot_stride(payload_bytes_);
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor_ < 0) return files::failed(kStore, path, "the store cannot be opened", errno);
  return {};
}

bool RetainStore::is_there() const {
  struct stat held {};
  struct stat named {};
  return fstat(descriptor_, &held) == 0 && stat(path_.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

result::Result<void> RetainStore::write(std::span<const std::byte> payload) {
  assert(payload.size() == payload_bytes_);
  fill_slot(buffer_, sequence_ + 1, digest_, payload);
  const std::size_t at = first_slot_ + ((sequence_ + 1) % 2) * slot_stride_;
  int error = is_there() ? 0 : ENOENT;
  if (error == 0) error = files::write_at(descriptor_, buffer_, at);
  if (error == 0 && fdatasync(descriptor_) != 0) error = errno;
  if (error != 0) return files::failed(kStore, path_, "retained values cannot be written", error);
  ++sequence_;
  return {};
}

RetainStore::RetainStore(RetainStore&& other) noexcept {
  *this = std::move(other);
}

RetainStore& RetainStore::operator=(RetainStore&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  path_ = std::move(other.path_);
  digest_ = other.digest_;
  first_slot_ = other.first_slot_;
  slot_stride_ = other.slot_stride_;
  payload_bytes_ = other.payload_bytes_;
  sequence_ = other.sequence_;
  buffer_ = std::move(other.buffer_);
  return *this;
}

RetainStore::~RetainStore() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace stepwright::record
