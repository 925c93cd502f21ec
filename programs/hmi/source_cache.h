#pragma once

// The sources of the running program for the pages that ask for them: read out of the container when the
// first page asks, kept until another program runs.
//
// Threads: from any. What it is given outlives it.

#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "hmi_web/api/cell_program.h"
#include "programs/hmi/running_program.h"

namespace stepwright::hmi {

// The answer about a program's sources, running or not.
api::Answer sources_of(const std::string& digest, const reader::ProgramInfo& info, std::string_view document);

class SourceCache final : public api::CellProgram {
 public:
  explicit SourceCache(const RunningProgram& running) : running_(running) {}

  api::Answer sources() const override;

 private:
  const RunningProgram& running_;
  mutable std::mutex mutex_;  // guards what follows
  mutable api::Answer kept_;  // of the program with its ETag
};

}  // namespace stepwright::hmi
