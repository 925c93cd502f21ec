#include "runtime/replay/replay_run.h"

#include <chrono>
#include <utility>

#include "runtime/trace/csv_trace.h"

namespace stepwright::replay {

result::Result<RunResult> run(const RunOptions& options) {
  trace::CsvTrace csv(options.csv_file);
  const bool table = !options.csv_file.empty();
  result::Diagnostics refused;  // by the table, in the middle of the replay
  record::ReplayOptions replaying;
  replaying.engine = [&](const bytecode::Program& program) {
    return host::make_engine(options.engine, program);
  };
  if (options.until > 0) replaying.until = options.until;
  if (table) {
    replaying.on_program = [&](const reader::LoadedProgram& loaded) -> result::Result<void> {
      const auto info = reader::ProgramInfo::read(loaded.bytes());
      auto variables = info ? trace::resolve_names(*info, options.trace) : tl::unexpected(info.error());
      auto begun = variables ? csv.columns(std::move(*variables)) : result::forward(variables);
      if (!begun) refused = begun.error();
      return begun;
    };
    replaying.on_scan = [&](const scan::ScanReport& report, const image::ProcessImage& image) {
      csv.row(report.scan, report.time_ns, image.bytes());
    };
  }
  const auto begin = std::chrono::steady_clock::now();
  auto report = record::replay(options.file, replaying);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  if (!report) return result::forward(report);
  if (!refused.empty()) return tl::unexpected(std::move(refused));
  if (table && csv.rows() > 0) {
    if (auto finished = csv.finish(); !finished) return result::forward(finished);
  }
  return RunResult{std::move(*report), wall.count(), csv.rows()};
}

}  // namespace stepwright::replay
