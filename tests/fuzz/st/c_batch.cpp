#include "tests/fuzz/st/c_batch.h"

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace stepwright::st_fuzz {

namespace {

// As c/meaning.h has them.
struct CLeaf {
  void* address;
  std::size_t size;
};
struct CProgram {
  void (*init)();
  int (*scan)();
  const CLeaf* leaves;
  std::size_t leaf_count;
};

}  // namespace

struct CBatch::Parts {
  Parts() = default;
  ~Parts() {
    if (library != nullptr) ::dlclose(library);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  support::TemporaryFolder folder;
  void* library = nullptr;
  const CProgram* programs = nullptr;
};

CBatch::CBatch(std::span<const Program* const> programs, const Dropped& dropped)
    : parts_(std::make_unique<Parts>()) {
  const std::string source = parts_->folder / "batch.c";
  const std::string object = parts_->folder / "batch.so";
  std::ofstream(source) << write_c(programs, dropped);
  // Optimised as users' C is, with the meaning kept: nothing is contracted or reordered, what wraps wraps,
  // and the library's functions are not computed by the compiler, which rounds otherwise.
  const std::string command = std::string("'") + STEPWRIGHT_C_COMPILER +
                              "' -x c -std=gnu11 -O2 -w -fmax-errors=3 -fwrapv -fno-strict-aliasing "
                              "-ffp-contract=off -fexcess-precision=standard "
                              "-fno-builtin-sin -fno-builtin-exp "
                              "-fno-builtin-log -fno-builtin-pow -fno-builtin-atan -fPIC -shared -I'" +
                              STEPWRIGHT_C_HEADERS + "' -o '" + object + "' '" + source + "'";
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("the C compiler refuses a batch: " + command);
  parts_->library = ::dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (parts_->library == nullptr) throw std::runtime_error(::dlerror());
  parts_->programs = static_cast<const CProgram*>(::dlsym(parts_->library, "programs"));
  for (std::size_t i = 0; i < programs.size(); ++i) parts_->programs[i].init();
}

CBatch::~CBatch() = default;

int CBatch::scan(std::size_t program) {
  return parts_->programs[program].scan();
}

void CBatch::set(std::size_t program, std::size_t leaf, std::uint64_t bits) {
  const CLeaf& target = parts_->programs[program].leaves[leaf];
  std::memcpy(target.address, &bits, target.size);
}

std::uint64_t CBatch::get(std::size_t program, std::size_t leaf, Scalar type) const {
  const CLeaf& source = parts_->programs[program].leaves[leaf];
  std::uint64_t bits = 0;
  std::memcpy(&bits, source.address, source.size);
  return extended(type, bits);
}

}  // namespace stepwright::st_fuzz
