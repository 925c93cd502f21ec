#pragma once

// A result where nothing can go on without its value: in campaigns, benches and tests, which end a run by an
// exception.
//
//   const CellConfig config = value_or_throw(load_cell_config(file));

#include <stdexcept>
#include <utility>

#include "runtime/ground/result/result.h"

namespace stepwright::result {

// Throws std::runtime_error with all that is wrong.
template <typename Value>
Value value_or_throw(Result<Value> made) {
  if (!made) throw std::runtime_error(to_string(made.error()));
  return std::move(*made);
}

}  // namespace stepwright::result
