#include "programs/runtime/plant_memory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace stepwright::cell_runtime {

// Two slots: the newer one is complete whenever `newest` names it.
struct PlantMemory::Record {
  static constexpr std::uint64_t kMagic = 0x314D'504C'5357'5753;
  std::uint64_t magic;
  std::atomic<std::uint32_t> newest;
  std::array<State, 2> slots;
};

namespace {

constexpr double kMaxPositionM = 10.0;

bool makes_sense(const PlantMemory::State& state) {
  const bool levels =
      std::all_of(state.begin() + 1, state.end(), [](double v) { return v >= 0.0 && v <= 100.0; });
  return levels && std::abs(state[0]) <= kMaxPositionM;
}

}  // namespace

PlantMemory::PlantMemory(std::filesystem::path file, int descriptor, Record* record)
    : file_(std::move(file)), descriptor_(descriptor), record_(record) {
  // Goes with its process, however that ends.
  owned_ = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
}

PlantMemory::~PlantMemory() {
  munmap(record_, sizeof(Record));
  std::error_code ignored;  // left behind, it is one more start from where the plant stands
  if (owned_) std::filesystem::remove(file_, ignored);
  close(descriptor_);
}

result::Result<std::unique_ptr<PlantMemory>> PlantMemory::open(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  void* memory = MAP_FAILED;
  struct stat info {};
  // The folder of shared memory is everyone's: somebody may have put a file of their own in this place.
  const bool foreign = descriptor >= 0 && fstat(descriptor, &info) == 0 && info.st_uid != geteuid();
  if (foreign) errno = EPERM;
  if (descriptor >= 0 && !foreign && ftruncate(descriptor, sizeof(Record)) == 0) {
    memory = mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  const int error = errno;
  if (memory == MAP_FAILED) {
    if (descriptor >= 0) close(descriptor);
    return result::fail("R0001", {file.string(), 0, 0},
                        std::string("the plant's state cannot be kept: ") + std::strerror(error));
  }
  return std::unique_ptr<PlantMemory>(new PlantMemory(file, descriptor, static_cast<Record*>(memory)));
}

std::optional<PlantMemory::State> PlantMemory::left_behind() const {
  if (record_->magic != Record::kMagic) return std::nullopt;
  const State state = record_->slots[record_->newest.load(std::memory_order_acquire) & 1];
  return makes_sense(state) ? std::optional<State>(state) : std::nullopt;
}

void PlantMemory::keep(const State& state) {
  const std::uint32_t next = (record_->newest.load(std::memory_order_relaxed) & 1) ^ 1;
  record_->slots[next] = state;
  record_->newest.store(next, std::memory_order_release);
  record_->magic = Record::kMagic;
}

}  // namespace stepwright::cell_runtime
