#include "programs/exec/exec_run.h"

#include "runtime/image/io_driver.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::exec {

namespace {

// Nothing is wired: inputs stay as they are, outputs go nowhere.
class NoIo final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte>) override { return image::IoStatus::Good; }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return image::IoStatus::Good;
  }
};

// Nobody asks how long a scan took.
class NoClock final : public scan::Clock {
 public:
  std::int64_t now_ns() override { return 0; }
};

result::Result<std::vector<loader::Variable>> resolve(const bytecode::Program& program,
                                                      const std::vector<std::string>& names) {
  std::vector<loader::Variable> variables;
  for (const std::string& name : names) {
    auto variable = loader::find_variable(program, name);
    if (!variable) return result::forward(variable);
    variables.push_back(std::move(*variable));
  }
  return variables;
}

}  // namespace

result::Result<ExecReport> run(const loader::LoadedProgram& loaded, const ExecOptions& options) {
  const bytecode::Program& program = loaded.program();
  auto variables = resolve(program, options.trace);
  if (!variables) return result::forward(variables);

  const bytecode::SizesRecord& sizes = program.sizes();
  std::vector<std::byte> memory(program.image_size());
  std::vector<std::uint64_t> stack(sizes.stack_slots);
  image::ProcessImage image(memory,
                            {sizes.input_bytes, sizes.output_bytes, sizes.marker_bytes, sizes.data_bytes});
  vm::Interpreter engine(program, stack);
  NoIo io;
  NoClock clock;
  scan::ScanCycle cycle(program, engine, image, io, clock, {});
  cycle.start({});

  ExecReport report;
  report.image_hash = image.hash();
  for (const auto& variable : *variables)
    report.trace.emplace_back(variable.name, std::vector<loader::Value>());
  while (report.scans < options.scans && cycle.state() == scan::ScanState::Running) {
    const scan::ScanReport scanned = cycle.run_scan();
    report.scans = scanned.scan;
    report.image_hash = scanned.image_hash;
    for (std::size_t i = 0; i < variables->size(); ++i) {
      report.trace[i].second.push_back(loader::read_value((*variables)[i], image.bytes()));
    }
    if (scanned.trap) {
      report.traps.push_back({scanned.scan, scanned.trap, loader::describe(program, scanned.trap)});
    }
  }
  report.trace_hash = cycle.trace_hash();
  return report;
}

}  // namespace stepwright::exec
