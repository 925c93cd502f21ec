#include "plant_models/fmu/model_instance.h"

#include <dlfcn.h>

#include <utility>

namespace stepwright::fmu {
namespace internal {

result::Result<Library> Library::load(const std::filesystem::path& file) {
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* const why = dlerror();
    return result::fail("C0334", {file.string(), 0, 0},
                        std::string("the FMU's library cannot be loaded: ") + (why != nullptr ? why : "?"),
                        "does it need libraries that this machine does not have? (ldd)");
  }
  return Library(file, handle);
}

Library::Library(Library&& other) noexcept
    : file_(std::move(other.file_)),
      handle_(std::exchange(other.handle_, nullptr)),
      missing_(std::move(other.missing_)) {}

Library::~Library() {
  if (handle_ != nullptr) dlclose(handle_);
}

void* Library::symbol(const char* name) const {
  return dlsym(handle_, name);
}

result::Result<void> Library::complete() const {
  if (missing_.empty()) return {};
  return result::fail("C0334", {file_.string(), 0, 0}, "the FMU's library lacks " + missing_,
                      "is it of the version that modelDescription.xml says?");
}

}  // namespace internal

result::Result<std::unique_ptr<ModelInstance>> make_instance(const ModelDescription& description,
                                                             const std::filesystem::path& library,
                                                             const std::filesystem::path& folder) {
  auto loaded = internal::Library::load(library);
  if (!loaded) return result::forward(loaded);
  return description.version == FmiVersion::V2 ? internal::make_fmi2(description, std::move(*loaded), folder)
                                               : internal::make_fmi3(description, std::move(*loaded), folder);
}

}  // namespace stepwright::fmu
