#pragma once

// Result<T>: a value, or the diagnostics that say why there is none. The one alias for tl::expected.
// Mark every function that returns one [[nodiscard]].

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::result {

template <typename T>
using Result = tl::expected<T, Diagnostics>;

// An error of one diagnostic: `return fail("C0004", {file, line, column}, "...", "...");`
inline tl::unexpected<Diagnostics> fail(std::string code, Location where, std::string message,
                                        std::string hint = {}) {
  Diagnostics diagnostics;
  diagnostics.push_back(
      {std::move(code), Severity::Error, std::move(where), std::move(message), std::move(hint)});
  return tl::unexpected<Diagnostics>(std::move(diagnostics));
}

// Passes the diagnostics of a failed Result on: `if (!x) return forward(x);`
template <typename T>
tl::unexpected<Diagnostics> forward(Result<T>& failed) {
  return tl::unexpected<Diagnostics>(std::move(failed.error()));
}

}  // namespace stepwright::result
