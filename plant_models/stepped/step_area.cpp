#include "plant_models/stepped/step_area.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace stepwright::stepped {
namespace {

constexpr std::size_t kLine = 64;  // each block begins with a line of the cache

std::uint32_t padded(std::size_t bytes) {
  return static_cast<std::uint32_t>((bytes + kLine - 1) / kLine * kLine);
}

std::string text_of(const StepNames& names) {
  std::string text;
  const auto add = [&text](const char* kind, const std::vector<std::string>& list) {
    for (const std::string& name : list) text.append(kind).append(" ").append(name).append("\n");
  };
  add("actuator", names.actuators);
  add("sensor", names.sensors);
  add("value", names.values);
  add("fault", names.faults);
  return text;
}

auto refused(const std::string& what) {
  return result::fail("R0151", {},
                      "no memory for the plant's process: " + what + ": " + std::strerror(errno));
}

auto no_area(const std::string& why) {
  return result::fail("R0152", {}, "descriptor 4 is no area of a plant: " + why,
                      "the runtime starts a plant with its socket as descriptor 3 and the area as 4");
}

bool within(BlockPlace place, std::size_t size, std::size_t bytes) {
  return place.at % sizeof(double) == 0 && place.at >= sizeof(StepHeader) && place.at <= bytes &&
         place.count <= (bytes - place.at) / size;
}

bool printable(char c) {
  return static_cast<unsigned char>(c) >= 0x20 && c != 0x7F;
}

}  // namespace

StepArea::StepArea(int descriptor, std::byte* memory, std::size_t bytes)
    : descriptor_(descriptor), memory_(memory), bytes_(bytes) {}

StepArea::StepArea(StepArea&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      memory_(std::exchange(other.memory_, nullptr)),
      bytes_(other.bytes_),
      actuators_(other.actuators_),
      sensors_(other.sensors_),
      values_(other.values_),
      faults_(other.faults_),
      names_(other.names_) {}

StepArea& StepArea::operator=(StepArea&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  std::swap(actuators_, other.actuators_);
  std::swap(sensors_, other.sensors_);
  std::swap(values_, other.values_);
  std::swap(faults_, other.faults_);
  std::swap(names_, other.names_);
  return *this;
}

StepArea::~StepArea() {
  if (memory_ != nullptr) munmap(memory_, bytes_);
  if (descriptor_ >= 0) close(descriptor_);
}

result::Result<StepArea> StepArea::make(const StepNames& names, std::uint64_t seed) {
  const std::string text = text_of(names);
  std::uint32_t end = padded(sizeof(StepHeader));
  const auto place = [&end](std::size_t count, std::size_t size) {
    const BlockPlace found{static_cast<std::uint32_t>(count), end};
    end += padded(count * size);
    return found;
  };
  StepArea area(memfd_create("stepwright-plant", MFD_CLOEXEC | MFD_ALLOW_SEALING), nullptr, 0);
  area.actuators_ = place(names.actuators.size(), sizeof(double));
  area.sensors_ = place(names.sensors.size(), sizeof(double));
  area.values_ = place(names.values.size(), sizeof(double));
  area.faults_ = place(names.faults.size(), sizeof(double));
  area.names_ = place(text.size(), 1);
  if (area.descriptor_ < 0) return refused("memfd_create");
  if (ftruncate(area.descriptor_, end) != 0) return refused("ftruncate");
  if (fcntl(area.descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    return refused("seals");
  void* const mapped = mmap(nullptr, end, PROT_READ | PROT_WRITE, MAP_SHARED, area.descriptor_, 0);
  if (mapped == MAP_FAILED) return refused("mmap");
  area.memory_ = static_cast<std::byte*>(mapped);
  area.bytes_ = end;
  StepHeader& header = area.header();
  header.version = kStepVersion;
  header.area_bytes = end;
  header.actuators = area.actuators_;
  header.sensors = area.sensors_;
  header.values = area.values_;
  header.faults = area.faults_;
  header.names = area.names_;
  header.seed = seed;
  std::memcpy(area.memory_ + area.names_.at, text.data(), text.size());
  header.magic = kStepMagic;
  return area;
}

result::Result<StepArea> StepArea::attach(int descriptor) {
  struct stat facts {};
  if (fstat(descriptor, &facts) != 0) return no_area(std::strerror(errno));
  const auto bytes = static_cast<std::size_t>(std::max<off_t>(facts.st_size, 0));
  if (bytes < sizeof(StepHeader)) {
    return no_area("it has " + std::to_string(bytes) + " bytes, the header alone has " +
                   std::to_string(sizeof(StepHeader)));
  }
  void* const mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (mapped == MAP_FAILED) return no_area(std::strerror(errno));
  StepArea area(-1, static_cast<std::byte*>(mapped), bytes);
  const StepHeader& header = area.header();
  if (header.magic != kStepMagic) return no_area("its first bytes are not SWPLANT1");
  if (header.version != kStepVersion) {
    return no_area("it is of version " + std::to_string(header.version) + ", this program speaks version " +
                   std::to_string(kStepVersion));
  }
  if (header.area_bytes > bytes) {
    return no_area("it has " + std::to_string(bytes) + " bytes, its header says " +
                   std::to_string(header.area_bytes));
  }
  area.actuators_ = header.actuators;
  area.sensors_ = header.sensors;
  area.values_ = header.values;
  area.faults_ = header.faults;
  area.names_ = header.names;
  bool fits = within(area.names_, 1, bytes);
  for (const BlockPlace place : {area.actuators_, area.sensors_, area.values_, area.faults_})
    fits = fits && within(place, sizeof(double), bytes);
  if (!fits) return no_area("a block lies outside of it");
  return area;
}

double StepArea::load(BlockPlace place, std::size_t index) const {
  auto* const number = reinterpret_cast<double*>(memory_ + place.at) + index;
  return std::atomic_ref<double>(*number).load(std::memory_order_relaxed);
}

void StepArea::store(BlockPlace place, std::size_t index, double number) const {
  auto* const target = reinterpret_cast<double*>(memory_ + place.at) + index;
  std::atomic_ref<double>(*target).store(number, std::memory_order_relaxed);
}

StepNames StepArea::names() const {
  StepNames names;
  std::string_view text(reinterpret_cast<const char*>(memory_ + names_.at), names_.count);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t space = line.find(' ');
    if (space == std::string_view::npos) continue;
    const std::string_view kind = line.substr(0, space);
    std::string name(line.substr(space + 1));
    if (kind == "actuator") names.actuators.push_back(std::move(name));
    if (kind == "sensor") names.sensors.push_back(std::move(name));
    if (kind == "value") names.values.push_back(std::move(name));
    if (kind == "fault") names.faults.push_back(std::move(name));
  }
  return names;
}

std::string StepArea::message() const {
  std::string text;
  for (std::size_t i = 0; i < kMessageBytes; ++i) {
    const char c = std::atomic_ref<char>(header().message[i]).load(std::memory_order_relaxed);
    if (c == 0) break;
    text += printable(c) ? c : ' ';
  }
  return text;
}

void StepArea::set_message(std::string_view text) const {
  const std::size_t bytes = std::min(text.size(), kMessageBytes - 1);
  std::memcpy(header().message, text.data(), bytes);
  header().message[bytes] = 0;
}

}  // namespace stepwright::stepped
