#pragma once

// A program on every engine of this machine, each with a memory of its own; all are compared after each scan.
//
//   Engines engines(write_st(*program, {}));
//   engines.set("main.in3", 7);
//   EXPECT_EQ(engines.scan(), "");

#include <cstdint>
#include <memory>
#include <string>

#include "ladder/graphic/project.h"
#include "runtime/bytecode/trap.h"
#include "tests/fuzz/st/scalar.h"

namespace stepwright::st_fuzz {

class Engines {
 public:
  // Throws std::runtime_error with the diagnostics if the compiler or the verifier refuses it. `project` may
  // be null.
  explicit Engines(const std::string& text, const graphic::Project* project = nullptr);
  ~Engines();

  // Throw std::runtime_error if there is no such variable. `bits` as extended() gives them.
  void set(const std::string& path, Scalar type, std::uint64_t bits);
  std::uint64_t get(const std::string& path, Scalar type) const;

  // Difference of the engines (image, trap, budget); empty if none.
  std::string scan();

  // Of the last scan.
  const bytecode::Trap& trap() const;
  // Where it happened: "fuzz.st:7:3".
  std::string trap_place() const;

  static bool has_native();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace stepwright::st_fuzz
