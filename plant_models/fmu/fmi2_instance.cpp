// FMI 2.0 co-simulation: the few types and functions of the standard that are used (FMI 2.0.4, 2.1 and 4.2).

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "plant_models/fmu/model_instance.h"
#include "plant_models/fmu/numbers.h"

namespace stepwright::fmu::internal {
namespace {

using Component = void*;
using Reference = unsigned int;
enum Status : int { kOk, kWarning, kDiscard, kError, kFatal, kPending };
constexpr int kTerminated = 3;  // of fmi2StatusKind
constexpr int kCoSimulation = 1;

struct Callbacks {
  void (*logger)(void* environment, const char* instance, int status, const char* category,
                 const char* message, ...);
  void* (*allocate)(std::size_t count, std::size_t size);
  void (*release)(void* memory);
  void (*step_finished)(void* environment, int status);
  void* environment;
};

struct Functions {
  Component (*instantiate)(const char* name, int type, const char* guid, const char* resources,
                           const Callbacks* callbacks, int visible, int logging) = nullptr;
  void (*release)(Component) = nullptr;
  int (*set_up)(Component, int with_tolerance, double tolerance, double start, int with_stop,
                double stop) = nullptr;
  int (*enter_initialization)(Component) = nullptr;
  int (*exit_initialization)(Component) = nullptr;
  int (*terminate)(Component) = nullptr;
  int (*step)(Component, double time, double step, int no_earlier_state) = nullptr;
  int (*boolean_status)(Component, int kind, int* value) = nullptr;  // may be null
  int (*set_real)(Component, const Reference*, std::size_t, const double*) = nullptr;
  int (*get_real)(Component, const Reference*, std::size_t, double*) = nullptr;
  int (*set_integer)(Component, const Reference*, std::size_t, const int*) = nullptr;
  int (*get_integer)(Component, const Reference*, std::size_t, int*) = nullptr;
  int (*set_boolean)(Component, const Reference*, std::size_t, const int*) = nullptr;
  int (*get_boolean)(Component, const Reference*, std::size_t, int*) = nullptr;

  explicit Functions(Library& library) {
    library.find("fmi2Instantiate", instantiate);
    library.find("fmi2FreeInstance", release);
    library.find("fmi2SetupExperiment", set_up);
    library.find("fmi2EnterInitializationMode", enter_initialization);
    library.find("fmi2ExitInitializationMode", exit_initialization);
    library.find("fmi2Terminate", terminate);
    library.find("fmi2DoStep", step);
    library.find_optional("fmi2GetBooleanStatus", boolean_status);
    library.find("fmi2SetReal", set_real);
    library.find("fmi2GetReal", get_real);
    library.find("fmi2SetInteger", set_integer);
    library.find("fmi2GetInteger", get_integer);
    library.find("fmi2SetBoolean", set_boolean);
    library.find("fmi2GetBoolean", get_boolean);
  }
};

// As a URI: bytes that are no plain letters as %XX.
std::string uri_of(const std::filesystem::path& folder) {
  std::string uri = "file://";
  for (const char c : folder.string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '-' || c == '_') {
      uri += c;
      continue;
    }
    char text[4];
    std::snprintf(text, sizeof text, "%%%02X", byte);
    uri += text;
  }
  return uri;
}

bool good(int status) {
  return status == kOk || status == kWarning;
}

class Fmi2Instance final : public ModelInstance {
 public:
  Fmi2Instance(Library library, const Functions& functions)
      : library_(std::move(library)), call_(functions) {}
  ~Fmi2Instance() override {
    if (component_ == nullptr) return;
    if (running_) call_.terminate(component_);
    call_.release(component_);
  }

  bool instantiate(const ModelDescription& description, const std::filesystem::path& folder) {
    resources_ = uri_of(folder / "resources");
    callbacks_ = {&Fmi2Instance::log, std::calloc, std::free, nullptr, this};
    component_ = call_.instantiate(description.name.c_str(), kCoSimulation, description.token.c_str(),
                                   resources_.c_str(), &callbacks_, 0, 0);
    return component_ != nullptr;
  }

  bool set(const ModelVariable& variable, double number) override {
    const Reference reference = variable.reference;
    const int whole = nearest<int>(number);
    const int truth = number != 0.0 ? 1 : 0;
    switch (variable.type) {
      case VariableType::Integer:
      case VariableType::Enumeration:
        return good(call_.set_integer(component_, &reference, 1, &whole));
      case VariableType::Boolean:
        return good(call_.set_boolean(component_, &reference, 1, &truth));
      default:
        return good(call_.set_real(component_, &reference, 1, &number));
    }
  }

  bool get(const ModelVariable& variable, double& number) override {
    const Reference reference = variable.reference;
    int whole = 0;
    switch (variable.type) {
      case VariableType::Integer:
      case VariableType::Enumeration:
        if (!good(call_.get_integer(component_, &reference, 1, &whole))) return false;
        number = whole;
        return true;
      case VariableType::Boolean:
        if (!good(call_.get_boolean(component_, &reference, 1, &whole))) return false;
        number = whole != 0 ? 1.0 : 0.0;
        return true;
      default:
        return good(call_.get_real(component_, &reference, 1, &number));
    }
  }

  bool begin_initialization() override {
    return good(call_.set_up(component_, 0, 0.0, 0.0, 0, 0.0)) &&
           good(call_.enter_initialization(component_));
  }
  bool finish_initialization() override {
    running_ = good(call_.exit_initialization(component_));
    return running_;
  }
  bool step(double time_s, double step_s) override {
    const int status = call_.step(component_, time_s, step_s, 1);
    if (status == kDiscard && has_ended()) said_ = "it asks for the end of the simulation";
    return good(status);
  }
  std::string said() const override { return said_; }

 private:
  // A step that is discarded for that reason is no failure of a solver.
  bool has_ended() {
    int ended = 0;
    return call_.boolean_status != nullptr && call_.boolean_status(component_, kTerminated, &ended) == kOk &&
           ended != 0;
  }

  static void log(void* environment, const char*, int status, const char*, const char* message, ...) {
    if (environment == nullptr || message == nullptr || status == kOk) return;
    std::array<char, 512> text{};
    std::va_list arguments;
    va_start(arguments, message);
    std::vsnprintf(text.data(), text.size(), message, arguments);
    va_end(arguments);
    static_cast<Fmi2Instance*>(environment)->said_ = text.data();
    std::fprintf(stderr, "fmu: %s\n", text.data());
  }

  Library library_;
  Functions call_;
  Callbacks callbacks_{};
  std::string resources_;
  std::string said_;
  Component component_ = nullptr;
  bool running_ = false;
};

}  // namespace

result::Result<std::unique_ptr<ModelInstance>> make_fmi2(const ModelDescription& description, Library library,
                                                         const std::filesystem::path& folder) {
  const Functions functions(library);
  if (auto all = library.complete(); !all) return result::forward(all);
  auto instance = std::make_unique<Fmi2Instance>(std::move(library), functions);
  if (!instance->instantiate(description, folder)) {
    return result::fail(
        "C0334", {},
        "the FMU makes no instance of itself" + (instance->said().empty() ? "" : ": " + instance->said()));
  }
  return instance;
}

}  // namespace stepwright::fmu::internal
