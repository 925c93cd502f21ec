#pragma once

// Compiles sources that a page brought, as `stepwright compile` does, in this process: the compiler reads no
// file and keeps nothing (ladder/driver/compile.h).
//
//   auto compiled = compile_sources({{"mixer.st", text}});
//
// Pure; any thread. Fails with what the compiler says (E...), each at its place.

#include <span>

#include "hmi_web/api/cell_change.h"
#include "ladder/driver/watcher.h"
#include "ladder/source/dialect.h"

namespace stepwright::hmi {

[[nodiscard]] result::Result<api::Compiled> compile_sources(
    const api::SourceTexts& sources, const source::Dialect& dialect = source::standard_dialect(),
    std::span<const driver::Watcher> watchers = {});

}  // namespace stepwright::hmi
