#include "runtime/exec/exec_run.h"

#include "runtime/image/no_io.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/trace/names.h"

namespace stepwright::exec {

namespace {

result::Result<std::vector<reader::NamedVariable>> resolve(const reader::LoadedProgram& loaded,
                                                           const std::vector<std::string>& names) {
  if (names.empty()) return std::vector<reader::NamedVariable>();
  auto info = reader::ProgramInfo::read(loaded.bytes());
  if (!info) return result::forward(info);
  return trace::resolve_names(*info, trace::asked(names), "B0300");
}

}  // namespace

result::Result<ExecReport> run(const reader::LoadedProgram& loaded, const ExecOptions& options) {
  const bytecode::Program& program = loaded.program();
  auto variables = resolve(loaded, options.trace);
  if (!variables) return result::forward(variables);

  std::vector<std::byte> memory(program.memory_size());
  image::ProcessImage image(memory, scan::layout_of(program));
  auto engine = host::make_engine(options.engine, program);
  if (!engine) return result::forward(engine);
  image::NoIo io;
  scan::NoClock clock;
  std::vector<std::byte> safe_outputs(image.outputs().size());
  scan::ScanCycle cycle(program, **engine, image, safe_outputs, io, clock, {});
  cycle.start({});

  if (options.csv != nullptr) {
    if (auto begun = options.csv->columns(*variables); !begun) return result::forward(begun);
  }
  ExecReport report;
  report.image_hash = image.hash();
  for (const reader::NamedVariable& variable : *variables)
    report.trace.emplace_back(variable.name, std::vector<reader::Value>());
  while (report.scans < options.scans && cycle.state() == scan::ScanState::Running) {
    const scan::ScanReport scanned = cycle.run_scan();
    report.scans = scanned.scan;
    report.image_hash = scanned.image_hash;
    for (std::size_t i = 0; i < variables->size(); ++i) {
      report.trace[i].second.push_back(reader::read_value((*variables)[i].variable, image.bytes()));
    }
    if (options.csv != nullptr) options.csv->row(scanned.scan, scanned.time_ns, image.bytes());
    if (scanned.trap) {
      report.traps.push_back({scanned.scan, scanned.trap, reader::describe(program, scanned.trap)});
    }
  }
  report.trace_hash = cycle.trace_hash();
  return report;
}

}  // namespace stepwright::exec
