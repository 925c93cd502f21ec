#include "tests/bench/engines/baseline.h"

#include <dlfcn.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

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
  const support::TemporaryFolder folder;
  const std::string source = folder / "program.c";
  const std::string library = folder / "program.so";
  std::ofstream(source) << text;
  // No contraction: the results must agree to the last bit.
  const std::string command =
      "gcc -std=gnu11 -O2 -ffp-contract=off -fPIC -shared '" + source + "' -o '" + library + "'";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("gcc failed");
  return std::make_unique<Library>(library, results);
}

}  // namespace stepwright::bench
