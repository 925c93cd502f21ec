#pragma once

// Layout of a causal graph's boxes: in columns by how many actions come before one, and the columns in bands,
// so that a long plan is read like a text and not along one endless line.
//
// Pure functions.

#include <cstddef>
#include <vector>

#include "supervisor/translate/schedule.h"

namespace stepwright::translate::internal {

struct CausalPlace {
  int band = 0;
  int column = 0;  // within its band
  int line = 0;    // within its column
};

struct CausalLayout {
  std::vector<CausalPlace> places;  // by action
  std::vector<int> lines;           // by band: of its tallest column
};

// `columns` stand side by side, at least one.
CausalLayout causal_layout(const Schedule& schedule, int columns);

}  // namespace stepwright::translate::internal
