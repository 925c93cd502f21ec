#include "programs/plan/progress_line.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "runtime/ground/result/counted.h"
#include "supervisor/pddl/definition/state.h"

namespace stepwright::plan {

ProgressMode progress_mode(bool asked) {
  if (isatty(STDERR_FILENO) != 0) return ProgressMode::Rewrite;
  return asked ? ProgressMode::Lines : ProgressMode::None;
}

std::string progress_text(const pddl::Progress& progress) {
  char text[96];
  std::snprintf(text, sizeof(text), "%.0f s: ", progress.wall_ms / 1000.0);
  std::string line = text;
  if (progress.best == nullptr) {
    line += "no plan yet";
  } else {
    line += "best " + pddl::number_text(progress.best->cost) + " in " +
            result::counted(progress.best->actions.size(), "step", "steps");
  }
  if (std::isfinite(progress.bound)) line += ", bound " + pddl::number_text(progress.bound);
  std::snprintf(text, sizeof(text), ", %llu states, %.0f MB",
                static_cast<unsigned long long>(progress.expanded), progress.peak_mb);
  return line + text;
}

void ProgressLine::show(const pddl::Progress& progress) {
  if (mode_ == ProgressMode::None) return;
  const bool rewrite = mode_ == ProgressMode::Rewrite;
  std::fprintf(stderr, rewrite ? "\r\x1b[K%s" : "%s\n", progress_text(progress).c_str());
  std::fflush(stderr);
  shown_ = true;
}

ProgressLine::~ProgressLine() {
  if (shown_ && mode_ == ProgressMode::Rewrite) std::fputs("\r\x1b[K", stderr);
}

}  // namespace stepwright::plan
