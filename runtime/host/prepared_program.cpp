#include "runtime/host/prepared_program.h"

#include <system_error>
#include <utility>

#include "runtime/host/memory_limit.h"
#include "runtime/host/program_fit.h"

namespace stepwright::host {
result::Result<std::unique_ptr<PreparedProgram>> PreparedProgram::create(std::vector<std::byte> container,
                                                                         std::string digest,
                                                                         const Environment& environment) {
  auto loaded = reader::LoadedProgram::load(std::move(container), "download");
  if (!loaded) return result::forward(loaded);
  const bytecode::Program& program = loaded->program();
  const AreaDriver& io = environment.io;
  auto fits = check_fit(program, {io.input_bytes(), io.output_bytes()}, "download");
  if (!fits) return result::forward(fits);
  auto bools = BoolBytes::of(program, "download");
  if (!bools) return result::forward(bools);
  auto merge_map = MergeMap::of(program, "download");
  if (!merge_map) return result::forward(merge_map);
  TaskPlan plan = plan_tasks(reader::task_infos(program.container()), environment.config);
  const std::size_t threads = plan.others().size() + 1;
  const MemoryNeed need{.code_bytes = program.container().section(bytecode::Section::Code).size(),
                        .image_bytes = program.memory_size(),
                        .threads = threads,
                        .native = environment.config.engine != EngineKind::Vm};
  if (auto room = check_memory(need, environment.config.memory_limit_bytes); !room)
    return result::forward(room);
  // An engine belongs to one thread.
  auto engines = make_engines(environment.config.engine, program, threads);
  if (!engines) return result::forward(engines);
  std::unique_ptr<bytecode::Engine> own = std::move(engines->back());
  engines->pop_back();
  Machine machine{std::move(own),        std::move(*engines), std::move(*bools),
                  std::move(*merge_map), std::move(plan),     std::vector<std::byte>(io.output_bytes())};
  try {
    return std::unique_ptr<PreparedProgram>(
        new PreparedProgram(std::move(*loaded), std::move(machine), std::move(digest), environment));
  } catch (const std::system_error& error) {
    return result::fail("R0071", {"download", 0, 0},
                        std::string("the system gives no thread for a task: ") + error.what(),
                        "the limit of processes (ulimit -u) may be reached");
  }
}

PreparedProgram::PreparedProgram(reader::LoadedProgram loaded, Machine machine, std::string digest,
                                 const Environment& environment)
    : digest_(std::move(digest)),
      loaded_(std::move(loaded)),
      memory_(loaded_.program().memory_size()),
      machine_(std::move(machine)),
      timings_(machine_.plan.tasks.size()),
      published_(machine_.plan.tasks.size()),
      image_(memory_, scan::layout_of(loaded_.program())),
      cycle_(loaded_.program(), *machine_.engine, image_, machine_.safe_outputs, environment.io,
             environment.clock,
             {.safe_state = environment.config.safety.safe_state.matrix(),
              .tasks = machine_.plan.options,
              .timings = timings_,
              .watch = environment.liveness,
              .own_tasks = machine_.plan.own_tasks,
              .clock_origin_ns = environment.config.clock == ClockMode::Real ? environment.clock_origin_ns
                                                                             : scan::ScanConfig::kNoOrigin}),
      steps_(loaded_.program()),
      events_(loaded_.program().image_size(), environment.plant_values) {
  image_.reset(loaded_.program().container().section(bytecode::Section::InitialData));
  const WorkerSetup setup{machine_.merge_map,          environment.clock,
                          environment.monitor,         environment.config.safety.stall_ns,
                          environment.clock_origin_ns, scan::ScanConfig{}.budget,
                          environment.task_failed};
  tasks_ = std::make_unique<TaskThreads>(loaded_.program(), image_, cycle_, setup, machine_.plan,
                                         std::move(machine_.engines), published_);
}

void PreparedProgram::publish_timings() {
  for (std::uint32_t i = 0; i < timings_.size(); ++i) {
    if (((machine_.plan.own_tasks >> i) & 1u) != 0) published_[i].store(timings_[i]);
  }
}

void PreparedProgram::warm() {
  image_.reset(loaded_.program().container().section(bytecode::Section::InitialData));
  events_.warm();
}

}  // namespace stepwright::host
