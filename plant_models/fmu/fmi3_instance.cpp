// FMI 3.0 co-simulation: the few types and functions of the standard that are used (FMI 3.0.1, 2.2 and 4.2).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <vector>

#include "plant_models/fmu/model_instance.h"
#include "plant_models/fmu/numbers.h"

namespace stepwright::fmu::internal {
namespace {

using Instance = void*;
using Reference = std::uint32_t;
enum Status : int { kOk, kWarning, kDiscard, kError, kFatal };

using LogMessage = void (*)(void* environment, int status, const char* category, const char* message);

template <typename T>
struct Access {
  int (*set)(Instance, const Reference*, std::size_t, const T*, std::size_t) = nullptr;
  int (*get)(Instance, const Reference*, std::size_t, T*, std::size_t) = nullptr;

  void find(Library& library, const char* type) {
    library.find((std::string("fmi3Set") + type).c_str(), set);
    library.find((std::string("fmi3Get") + type).c_str(), get);
  }
};

struct Functions {
  Instance (*instantiate)(const char* name, const char* token, const char* resources, bool visible,
                          bool logging, bool events, bool early_return, const Reference* intermediate,
                          std::size_t count, void* environment, LogMessage log, void* update) = nullptr;
  void (*release)(Instance) = nullptr;
  int (*enter_initialization)(Instance, bool with_tolerance, double tolerance, double start, bool with_stop,
                              double stop) = nullptr;
  int (*exit_initialization)(Instance) = nullptr;
  int (*terminate)(Instance) = nullptr;
  int (*step)(Instance, double time, double step, bool no_earlier_state, bool* event, bool* terminate,
              bool* early, double* reached) = nullptr;
  Access<double> float64;
  Access<float> float32;
  Access<std::int8_t> int8;
  Access<std::uint8_t> uint8;
  Access<std::int16_t> int16;
  Access<std::uint16_t> uint16;
  Access<std::int32_t> int32;
  Access<std::uint32_t> uint32;
  Access<std::int64_t> int64;
  Access<std::uint64_t> uint64;
  Access<bool> boolean;

  explicit Functions(Library& library) {
    library.find("fmi3InstantiateCoSimulation", instantiate);
    library.find("fmi3FreeInstance", release);
    library.find("fmi3EnterInitializationMode", enter_initialization);
    library.find("fmi3ExitInitializationMode", exit_initialization);
    library.find("fmi3Terminate", terminate);
    library.find("fmi3DoStep", step);
    float64.find(library, "Float64");
    float32.find(library, "Float32");
    int8.find(library, "Int8");
    uint8.find(library, "UInt8");
    int16.find(library, "Int16");
    uint16.find(library, "UInt16");
    int32.find(library, "Int32");
    uint32.find(library, "UInt32");
    int64.find(library, "Int64");
    uint64.find(library, "UInt64");
    boolean.find(library, "Boolean");
  }
};

constexpr std::size_t kLargestNumber = 8;  // bytes of any type

// An array variable: the FMU takes and gives it as a whole only.
struct Array {
  VariableType type = VariableType::Float64;
  std::vector<double> wanted;  // what its elements were set to, else their start
  std::vector<double> read;
  bool changed = false;  // `wanted` is not yet known to the FMU
  bool fresh = false;    // `read` is what it has now
};

std::map<Reference, Array> arrays_of(const ModelDescription& description) {
  std::map<Reference, Array> arrays;
  for (const ModelVariable& variable : description.variables) {
    if (variable.elements == 0 || variable.type == VariableType::Other) continue;
    Array& array = arrays[variable.reference];
    array.type = variable.type;
    array.wanted.resize(std::max<std::size_t>(array.wanted.size(), variable.elements));
    array.read.resize(array.wanted.size());
    array.wanted[variable.element] = variable.start;
  }
  return arrays;
}

bool good(int status) {
  return status == kOk || status == kWarning;
}

class Fmi3Instance final : public ModelInstance {
 public:
  Fmi3Instance(Library library, const Functions& functions)
      : library_(std::move(library)), call_(functions) {}
  ~Fmi3Instance() override {
    if (instance_ == nullptr) return;
    if (running_) call_.terminate(instance_);
    call_.release(instance_);
  }

  bool instantiate(const ModelDescription& description, const std::filesystem::path& folder) {
    arrays_ = arrays_of(description);
    std::size_t most = 1;
    for (const auto& [reference, array] : arrays_) most = std::max(most, array.wanted.size());
    room_ = std::make_unique<std::byte[]>(most * kLargestNumber);
    resources_ = (folder / "resources").string() + "/";
    instance_ = call_.instantiate(description.name.c_str(), description.token.c_str(), resources_.c_str(),
                                  false, false, false, false, nullptr, 0, this, &Fmi3Instance::log, nullptr);
    return instance_ != nullptr;
  }

  bool set(const ModelVariable& variable, double number) override {
    if (variable.elements == 0) return write(variable.type, variable.reference, &number, 1);
    Array& array = arrays_.at(variable.reference);
    array.wanted[variable.element] = number;
    array.changed = true;
    return true;
  }
  bool get(const ModelVariable& variable, double& number) override {
    if (variable.elements == 0) return read(variable.type, variable.reference, &number, 1);
    Array& array = arrays_.at(variable.reference);
    if (!array.fresh)
      array.fresh = read(array.type, variable.reference, array.read.data(), array.read.size());
    number = array.read[variable.element];
    return array.fresh;
  }
  bool begin_initialization() override {
    return send_arrays() && good(call_.enter_initialization(instance_, false, 0.0, 0.0, false, 0.0));
  }
  bool finish_initialization() override {
    running_ = send_arrays() && good(call_.exit_initialization(instance_));
    return running_;
  }
  bool step(double time_s, double step_s) override {
    bool event = false;
    bool ended = false;
    bool early = false;
    double reached = 0.0;
    if (!send_arrays()) return false;
    if (!good(call_.step(instance_, time_s, step_s, true, &event, &ended, &early, &reached))) return false;
    if (ended) said_ = "it asks for the end of the simulation";
    return !ended;
  }
  std::string said() const override { return said_; }

 private:
  bool write(VariableType type, Reference reference, const double* numbers, std::size_t count) {
    return with(type, [&]<typename T>(Access<T>& access) {
      T* const typed = room_for<T>();
      std::transform(numbers, numbers + count, typed, nearest<T>);
      return good(access.set(instance_, &reference, 1, typed, count));
    });
  }
  bool read(VariableType type, Reference reference, double* numbers, std::size_t count) {
    return with(type, [&]<typename T>(Access<T>& access) {
      T* const typed = room_for<T>();
      if (!good(access.get(instance_, &reference, 1, typed, count))) return false;
      std::transform(typed, typed + count, numbers, [](T each) { return static_cast<double>(each); });
      return true;
    });
  }

  // For as many numbers as the largest variable has; the same of every type.
  template <typename T>
  T* room_for() const {
    static_assert(sizeof(T) <= kLargestNumber);
    return reinterpret_cast<T*>(room_.get());
  }

  // What was set since, before the FMU goes on; what was read is no longer true then.
  bool send_arrays() {
    for (auto& [reference, array] : arrays_) {
      if (array.changed && !write(array.type, reference, array.wanted.data(), array.wanted.size()))
        return false;
      array.changed = false;
      array.fresh = false;
    }
    return true;
  }

  // The functions of a type.
  template <typename Use>
  bool with(VariableType type, Use use) {
    switch (type) {
      case VariableType::Float32:
        return use(call_.float32);
      case VariableType::Int8:
        return use(call_.int8);
      case VariableType::UInt8:
        return use(call_.uint8);
      case VariableType::Int16:
        return use(call_.int16);
      case VariableType::UInt16:
        return use(call_.uint16);
      case VariableType::Int32:
        return use(call_.int32);
      case VariableType::UInt32:
        return use(call_.uint32);
      case VariableType::Int64:
      case VariableType::Enumeration:  // enumerations have 64 bits in FMI 3
        return use(call_.int64);
      case VariableType::UInt64:
        return use(call_.uint64);
      case VariableType::Boolean:
        return use(call_.boolean);
      default:
        return use(call_.float64);
    }
  }

  static void log(void* environment, int status, const char*, const char* message) {
    if (environment == nullptr || message == nullptr || status == kOk) return;
    static_cast<Fmi3Instance*>(environment)->said_ = std::string(message).substr(0, 500);
    std::fprintf(stderr, "fmu: %s\n", message);
  }

  Library library_;
  Functions call_;
  std::string resources_;
  std::string said_;
  std::map<Reference, Array> arrays_;
  std::unique_ptr<std::byte[]> room_;
  Instance instance_ = nullptr;
  bool running_ = false;
};

}  // namespace

result::Result<std::unique_ptr<ModelInstance>> make_fmi3(const ModelDescription& description, Library library,
                                                         const std::filesystem::path& folder) {
  const Functions functions(library);
  if (auto all = library.complete(); !all) return result::forward(all);
  auto instance = std::make_unique<Fmi3Instance>(std::move(library), functions);
  if (!instance->instantiate(description, folder)) {
    return result::fail(
        "C0334", {},
        "the FMU makes no instance of itself" + (instance->said().empty() ? "" : ": " + instance->said()));
  }
  return instance;
}

}  // namespace stepwright::fmu::internal
