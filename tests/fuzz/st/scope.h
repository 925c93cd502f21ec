#pragma once

// Scope of a POU's body: every way from a variable to a scalar, an aggregate or an instance that it can name.

#include <vector>

#include "tests/fuzz/st/tree.h"

namespace stepwright::st_fuzz {

struct WayStep {
  std::string field;  // empty: an element
  const Type* array;
};

struct Way {
  const Variable* variable;
  std::vector<WayStep> steps;
  const Type* type;
  bool writable;
};

struct Scope {
  explicit Scope(const Pou& pou);

  std::vector<Way> readable[kScalars];  // enumerations not among them
  std::vector<Way> writable;            // scalars
  std::vector<Way> enumerations;
  std::vector<Way> aggregates;  // arrays and structures without instances in them
  std::vector<Way> blocks;

 private:
  void walk(const Way& way);
};

// Whether an instance of a block lies in it.
bool holds_block(const Type& type);

}  // namespace stepwright::st_fuzz
