#include "tests/bench/engines/baseline.h"

#include <dlfcn.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace stepwright::bench {

namespace {

class Library final : public Subject {
 public:
  Library(const std::string& file, std::size_t results)
      : handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)), count_(results) {
    if (handle_ == nullptr) throw std::runtime_error(dlerror());
    set_ = symbol<void (*)(const std::uint8_t*, const float*)>("set");
    scan_ = symbol<void (*)(long long)>("scan");
    get_ = symbol<void (*)(double*)>("get");
  }
  ~Library() override { dlclose(handle_); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  void set(std::span<const std::uint8_t> bools, std::span<const float> reals) override {
    set_(bools.data(), reals.data());
  }
  void scan(std::int64_t now_ns) override { scan_(now_ns); }
  std::vector<double> results() override {
    std::vector<double> values(count_);
    get_(values.data());
    return values;
  }

 private:
  template <typename F>
  F symbol(const char* name) {
    return reinterpret_cast<F>(dlsym(handle_, name));
  }

  void* handle_;
  std::size_t count_;
  void (*set_)(const std::uint8_t*, const float*) = nullptr;
  void (*scan_)(long long) = nullptr;
  void (*get_)(double*) = nullptr;
};

}  // namespace

std::unique_ptr<Subject> compile_c(const std::string& text, std::size_t results) {
  std::string folder = (std::filesystem::temp_directory_path() / "stepwright_engines_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const std::string source = folder + "/program.c";
  const std::string library = folder + "/program.so";
  std::ofstream(source) << text;
  // No contraction: the results must agree to the last bit.
  const std::string command =
      "gcc -std=gnu11 -O2 -ffp-contract=off -fPIC -shared '" + source + "' -o '" + library + "'";
  const bool compiled = std::system(command.c_str()) == 0;
  std::unique_ptr<Subject> subject;
  if (compiled) subject = std::make_unique<Library>(library, results);
  std::filesystem::remove_all(folder);
  if (!compiled) throw std::runtime_error("gcc failed");
  return subject;
}

}  // namespace stepwright::bench
