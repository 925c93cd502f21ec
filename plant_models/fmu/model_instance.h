#pragma once

// A running co-simulation: numbers by variable, steps in time. FMI 2.0 and 3.0 behind one interface; their C
// functions stay in the two files that implement it.
//
// Threads: one. The library runs in this process and may do what it likes to it: only in a process that
// nothing else depends on.

#include <filesystem>
#include <memory>
#include <string>

#include "plant_models/fmu/model_description.h"

namespace stepwright::fmu {

class ModelInstance {
 public:
  virtual ~ModelInstance() = default;

  // Requires a variable of the description, with a number. What the FMU refuses is `false`; `said()` has its
  // words. Elements of an array are given to it together, before the next of the calls below.
  virtual bool set(const ModelVariable& variable, double number) = 0;
  virtual bool get(const ModelVariable& variable, double& number) = 0;
  // Before the first step: what is set until finish_initialization() are start values.
  virtual bool begin_initialization() = 0;
  virtual bool finish_initialization() = 0;
  // From `time_s` on for `step_s`.
  virtual bool step(double time_s, double step_s) = 0;
  // The newest words of the FMU, of warnings and errors.
  virtual std::string said() const = 0;
};

// Loads the library and makes an instance. `folder` is where the FMU was unpacked. Fails with C0334.
[[nodiscard]] result::Result<std::unique_ptr<ModelInstance>> make_instance(
    const ModelDescription& description, const std::filesystem::path& library,
    const std::filesystem::path& folder);

namespace internal {

// A library and its functions by name.
class Library {
 public:
  [[nodiscard]] static result::Result<Library> load(const std::filesystem::path& file);
  Library(Library&& other) noexcept;
  Library& operator=(Library&& other) = delete;
  ~Library();

  // Notes the name where there is no such function.
  template <typename Function>
  void find(const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(symbol(name));
    if (function == nullptr) missing_ += missing_.empty() ? name : std::string(", ") + name;
  }
  // Null where there is no such function, and none is needed.
  template <typename Function>
  void find_optional(const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(symbol(name));
  }
  // C0334 where functions are missing.
  [[nodiscard]] result::Result<void> complete() const;

 private:
  Library(std::filesystem::path file, void* handle) : file_(std::move(file)), handle_(handle) {}
  void* symbol(const char* name) const;

  std::filesystem::path file_;
  void* handle_ = nullptr;
  std::string missing_;
};

[[nodiscard]] result::Result<std::unique_ptr<ModelInstance>> make_fmi2(const ModelDescription& description,
                                                                       Library library,
                                                                       const std::filesystem::path& folder);
[[nodiscard]] result::Result<std::unique_ptr<ModelInstance>> make_fmi3(const ModelDescription& description,
                                                                       Library library,
                                                                       const std::filesystem::path& folder);

}  // namespace internal
}  // namespace stepwright::fmu
