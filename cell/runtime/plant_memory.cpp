#include "cell/runtime/plant_memory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace stepwright::cell_runtime {

// The head of the file. Two slots of numbers follow it: the newer one is complete whenever `newest` names it.
struct PlantMemory::Record {
  static constexpr std::uint64_t kMagic = 0x324D'504C'5357'5753;
  std::uint64_t magic;
  std::uint64_t numbers;  // in a slot
  std::atomic<std::uint32_t> newest;
  std::uint32_t reserved;
};

namespace {

constexpr std::size_t kSlots = 2;

}  // namespace

PlantMemory::PlantMemory(std::filesystem::path file, int descriptor, Record* record, std::size_t numbers)
    : file_(std::move(file)), descriptor_(descriptor), record_(record), numbers_(numbers) {
  // Goes with its process, however that ends.
  owned_ = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
}

PlantMemory::~PlantMemory() {
  munmap(record_, sizeof(Record) + kSlots * numbers_ * sizeof(double));
  std::error_code ignored;  // left behind, it is one more start from where the plant stands
  if (owned_) std::filesystem::remove(file_, ignored);
  close(descriptor_);
}

result::Result<std::unique_ptr<PlantMemory>> PlantMemory::open(const std::filesystem::path& file,
                                                               std::size_t numbers) {
  const std::size_t bytes = sizeof(Record) + kSlots * numbers * sizeof(double);
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  void* memory = MAP_FAILED;
  struct stat info {};
  // The folder of shared memory is everyone's: somebody may have put a file of their own in this place.
  const bool foreign = descriptor >= 0 && fstat(descriptor, &info) == 0 && info.st_uid != geteuid();
  if (foreign) errno = EPERM;
  // Never shorter: another process may have more of it mapped.
  const bool fits = info.st_size >= static_cast<off_t>(bytes);
  if (descriptor >= 0 && !foreign && (fits || ftruncate(descriptor, static_cast<off_t>(bytes)) == 0)) {
    memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  const int error = errno;
  if (memory == MAP_FAILED) {
    if (descriptor >= 0) close(descriptor);
    return result::fail("R0079", {file.string(), 0, 0},
                        std::string("the plant's state cannot be kept: ") + std::strerror(error));
  }
  return std::unique_ptr<PlantMemory>(
      new PlantMemory(file, descriptor, static_cast<Record*>(memory), numbers));
}

double* PlantMemory::slot(std::uint32_t index) const {
  return reinterpret_cast<double*>(record_ + 1) + (index & 1) * numbers_;
}

std::optional<std::vector<double>> PlantMemory::left_behind() const {
  if (record_->magic != Record::kMagic || record_->numbers != numbers_) return std::nullopt;
  const double* newest = slot(record_->newest.load(std::memory_order_acquire));
  return std::vector<double>(newest, newest + numbers_);
}

void PlantMemory::keep(std::span<const double> numbers) {
  const std::uint32_t next = (record_->newest.load(std::memory_order_relaxed) & 1) ^ 1;
  std::copy_n(numbers.begin(), numbers_, slot(next));
  record_->newest.store(next, std::memory_order_release);
  record_->numbers = numbers_;
  record_->magic = Record::kMagic;
}

}  // namespace stepwright::cell_runtime
