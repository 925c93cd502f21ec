#include "runtime/host/snapshot_memory.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <cstring>

#include "runtime/host/limits.h"
#include "runtime/host/plant_values.h"

namespace stepwright::host {
namespace {

constexpr std::uint64_t kMagic =
    0x32504E5357535453u;  // "STSWSNP2", which also names the version of the layout
constexpr std::size_t kDigestBytes = 64;

// All of it is copied in words of 8 bytes.
struct Fixed {
  std::uint64_t scan;
  std::int64_t time_ns;
  std::uint64_t image_bytes;
  std::array<char, kDigestBytes> digest;
  std::array<double, kMaxPlantValues> plant;
};
static_assert(sizeof(Fixed) % 8 == 0);

struct Slot {
  Fixed fixed;
  std::array<std::byte, kMaxImageBytes> image;
};

// Snapshots are numbered from 1; number n is in slot n % 2.
struct Layout {
  std::uint64_t magic;
  std::uint64_t plant_count;
  std::array<std::array<char, kMaxNameBytes>, kMaxPlantValues> names;  // constant, padded with zeros
  std::uint64_t begun;     // number of the one that is being written, or was last
  std::uint64_t complete;  // of the newest that is whole; 0: there is none
  std::array<Slot, 2> slots;
};
static_assert(offsetof(Layout, begun) % 8 == 0 && offsetof(Layout, slots) % 8 == 0 && sizeof(Slot) % 8 == 0);

using Word = std::uint64_t;

// Whole words only: the source may end within one. Each word is a release and its load an acquire, so that
// whoever sees one word of a write sees that the write has begun (on x86-64 that costs nothing).
void store_words(std::byte* to, const void* from, std::size_t bytes) {
  auto* words = reinterpret_cast<Word*>(to);
  const auto* source = static_cast<const std::byte*>(from);
  const std::size_t whole = bytes / sizeof(Word);
  // Of a length that the compiler knows, so that no word costs a call.
  for (std::size_t i = 0; i < whole; ++i) {
    Word word;
    std::memcpy(&word, source + i * sizeof(Word), sizeof(Word));
    std::atomic_ref(words[i]).store(word, std::memory_order_release);
  }
  if (whole * sizeof(Word) == bytes) return;
  Word word = 0;
  std::memcpy(&word, source + whole * sizeof(Word), bytes - whole * sizeof(Word));
  std::atomic_ref(words[whole]).store(word, std::memory_order_release);
}

// The memory is mapped for reading only; an atomic load does not write.
Word load_word(const std::byte* from, std::memory_order order) {
  auto* word = reinterpret_cast<Word*>(const_cast<std::byte*>(from));
  return std::atomic_ref(*word).load(order);
}

void load_words(void* to, const std::byte* from, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; i += sizeof(Word)) {
    const Word word = load_word(from + i, std::memory_order_acquire);
    std::memcpy(static_cast<std::byte*>(to) + i, &word, std::min(sizeof(Word), bytes - i));
  }
}

// Any bytes: from within a word to within another.
void load_bytes(std::span<std::byte> to, const std::byte* memory, std::size_t offset) {
  std::size_t at = 0;
  while (at < to.size()) {
    const std::size_t within = (offset + at) % sizeof(Word);
    const Word word = load_word(memory + offset + at - within, std::memory_order_acquire);
    std::array<std::byte, sizeof(Word)> bytes;
    std::memcpy(bytes.data(), &word, sizeof word);
    const std::size_t count = std::min(sizeof(Word) - within, to.size() - at);
    if (count == sizeof(Word)) {
      std::memcpy(to.data() + at, &word, sizeof word);
    } else {
      std::memcpy(to.data() + at, bytes.data() + within, count);
    }
    at += count;
  }
}

std::size_t slot_offset(std::uint64_t number) {
  return offsetof(Layout, slots) + number % 2 * sizeof(Slot);
}

tl::unexpected<result::Diagnostics> refused(const std::string& what) {
  return result::fail("R0077", {}, what + ": " + std::strerror(errno));
}

}  // namespace

result::Result<std::unique_ptr<SnapshotWriter>> SnapshotWriter::create(
    std::span<const std::string> plant_names) {
  if (auto wrong = check_plant_values(plant_names, {}); !wrong.empty())
    return tl::unexpected(std::move(wrong));
  std::unique_ptr<SnapshotWriter> self(new SnapshotWriter());
  const int writable = memfd_create("stepwright-snapshot", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (writable < 0) return refused("no shared memory for snapshots");
  void* memory = MAP_FAILED;
  if (ftruncate(writable, sizeof(Layout)) == 0) {
    memory = mmap(nullptr, sizeof(Layout), PROT_READ | PROT_WRITE, MAP_SHARED, writable, 0);
  }
  // After this the mapping just made is the only one that can ever write.
  const bool sealed =
      memory != MAP_FAILED &&
      fcntl(writable, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_FUTURE_WRITE | F_SEAL_SEAL) == 0;
  if (sealed) {
    self->shared_ = ::open(("/proc/self/fd/" + std::to_string(writable)).c_str(), O_RDONLY | O_CLOEXEC);
  }
  const int error = errno;
  close(writable);
  if (memory != MAP_FAILED) self->memory_ = static_cast<std::byte*>(memory);
  errno = error;
  if (self->shared_ < 0) return refused("the memory for snapshots cannot be shared");
  auto* layout = reinterpret_cast<Layout*>(self->memory_);
  layout->plant_count = plant_names.size();
  for (std::size_t i = 0; i < plant_names.size(); ++i) {
    std::copy(plant_names[i].begin(), plant_names[i].end(), layout->names[i].begin());
  }
  layout->magic = kMagic;
  return self;
}

SnapshotWriter::~SnapshotWriter() {
  if (memory_ != nullptr) munmap(memory_, sizeof(Layout));
  if (shared_ >= 0) close(shared_);
}

void SnapshotWriter::publish(std::uint64_t scan, std::int64_t time_ns, std::string_view digest,
                             std::span<const std::byte> image, std::span<const double> plant) {
  assert(image.size() <= kMaxImageBytes && plant.size() <= kMaxPlantValues);
  Fixed fixed;
  fixed.scan = scan;
  fixed.time_ns = time_ns;
  fixed.image_bytes = image.size();
  fixed.digest.fill(0);
  std::copy_n(digest.begin(), std::min(digest.size(), kDigestBytes), fixed.digest.begin());
  std::copy(plant.begin(), plant.end(), fixed.plant.begin());
  const std::size_t fixed_bytes = offsetof(Fixed, plant) + plant.size() * sizeof(double);

  const std::atomic_ref begun(*reinterpret_cast<Word*>(memory_ + offsetof(Layout, begun)));
  const std::atomic_ref complete(*reinterpret_cast<Word*>(memory_ + offsetof(Layout, complete)));
  const Word number = complete.load(std::memory_order_relaxed) + 1;
  std::byte* const slot = memory_ + slot_offset(number);
  begun.store(number, std::memory_order_relaxed);
  store_words(slot + offsetof(Slot, fixed), &fixed, fixed_bytes);
  store_words(slot + offsetof(Slot, image), image.data(), image.size());
  complete.store(number, std::memory_order_release);
}

result::Result<std::unique_ptr<SnapshotReader>> SnapshotReader::open(int descriptor) {
  struct stat info {};
  if (fstat(descriptor, &info) != 0 || info.st_size != static_cast<off_t>(sizeof(Layout))) {
    return result::fail("R0005", {}, "the shared memory is not that of a snapshot");
  }
  void* memory = mmap(nullptr, sizeof(Layout), PROT_READ, MAP_SHARED, descriptor, 0);
  if (memory == MAP_FAILED) return refused("the snapshot cannot be mapped");
  std::unique_ptr<SnapshotReader> self(new SnapshotReader());
  self->memory_ = static_cast<const std::byte*>(memory);
  const auto* layout = reinterpret_cast<const Layout*>(memory);
  if (layout->magic != kMagic || layout->plant_count > kMaxPlantValues) {
    return result::fail("R0005", {}, "the shared memory has another version of the snapshot's layout");
  }
  for (std::size_t i = 0; i < layout->plant_count; ++i) {
    const auto& name = layout->names[i];
    self->names_.emplace_back(name.begin(), std::find(name.begin(), name.end(), '\0'));
  }
  return self;
}

SnapshotReader::~SnapshotReader() {
  if (memory_ != nullptr) munmap(const_cast<std::byte*>(memory_), sizeof(Layout));
}

std::optional<Snapshot> SnapshotReader::read() const {
  Fixed fixed;
  Snapshot snapshot;
  const std::size_t fixed_bytes = offsetof(Fixed, plant) + names_.size() * sizeof(double);
  const bool there = consistent([&](const SnapshotView& view) {
    load_words(&fixed, view.slot_ + offsetof(Slot, fixed), fixed_bytes);
    // Half-written sizes are possible here; they are thrown away but must not be followed.
    if (fixed.image_bytes > kMaxImageBytes) return;
    snapshot.image.resize(fixed.image_bytes);
    load_words(snapshot.image.data(), view.slot_ + offsetof(Slot, image), snapshot.image.size());
  });
  if (!there) return std::nullopt;
  snapshot.scan = fixed.scan;
  snapshot.time_ns = fixed.time_ns;
  snapshot.program_digest.assign(fixed.digest.begin(),
                                 std::find(fixed.digest.begin(), fixed.digest.end(), '\0'));
  for (std::size_t i = 0; i < names_.size(); ++i) snapshot.plant.push_back({names_[i], fixed.plant[i]});
  return snapshot;
}

std::uint64_t SnapshotReader::sequence() const {
  return load_word(memory_ + offsetof(Layout, complete), std::memory_order_acquire);
}

const std::byte* SnapshotReader::slot_of(std::uint64_t number) const {
  return memory_ + slot_offset(number);
}

// The next snapshot goes into the other slot; only the one after it comes here.
bool SnapshotReader::untouched(std::uint64_t number) const {
  return load_word(memory_ + offsetof(Layout, begun), std::memory_order_relaxed) <= number + 1;
}

// Who shares the processor with the writer, or with too many others, is overtaken in each of its turns unless
// it begins a new one.
void SnapshotReader::let_others_run(int attempt) {
  constexpr int kAtOnce = 4;
  if (attempt >= kAtOnce) sched_yield();
}

SnapshotView::SnapshotView(const std::byte* slot)
    : slot_(slot),
      image_bytes_(load_word(slot + offsetof(Slot, fixed.image_bytes), std::memory_order_acquire)) {
  // Half-written sizes are possible; they must not be followed.
  if (image_bytes_ > kMaxImageBytes) image_bytes_ = 0;
}

bool SnapshotView::is_of(std::string_view digest) const {
  std::array<std::byte, kDigestBytes> shown;
  load_bytes(shown, slot_, offsetof(Slot, fixed.digest));
  const std::size_t size = std::min(digest.size(), kDigestBytes);
  return std::memcmp(shown.data(), digest.data(), size) == 0 &&
         (size == kDigestBytes || shown[size] == std::byte{0});
}

std::uint64_t SnapshotView::scan() const {
  return load_word(slot_ + offsetof(Slot, fixed.scan), std::memory_order_acquire);
}

bool SnapshotView::load(std::size_t offset, std::span<std::byte> to) const {
  if (offset > image_bytes_ || to.size() > image_bytes_ - offset) return false;
  load_bytes(to, slot_, offsetof(Slot, image) + offset);
  return true;
}

}  // namespace stepwright::host
