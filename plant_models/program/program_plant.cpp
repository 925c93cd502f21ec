#include "plant_models/program/program_plant.h"

#include "plant_models/program/store_number.h"
#include "runtime/ground/result/closest.h"
#include "runtime/host/engine_choice.h"

namespace stepwright::program_plant {
namespace {

std::string hint_of(const reader::ProgramInfo& info, const std::string& name) {
  std::vector<std::string> names;
  for (const reader::Tag& tag : info.tags()) names.push_back(tag.name);
  const std::string* const meant = result::closest(name, names, 3);
  if (meant != nullptr) return "did you mean '" + *meant + "'?";
  return "variables have the name of their program in front: Tank.level";
}

// Time would stand still at a task that is due again at once.
bool is_never_past(const reader::TaskInfo& task) {
  return task.interval_us == 0 && task.trigger.empty();
}

}  // namespace

result::Result<std::vector<reader::Variable>> find_variables(const reader::ProgramInfo& info,
                                                             const std::vector<WantedVariable>& wanted,
                                                             const result::Location& program) {
  std::vector<reader::Variable> found;
  result::Diagnostics problems;
  const auto complain = [&problems](const result::Location& where, std::string message, std::string hint) {
    problems.push_back({"C0336", result::Severity::Error, where, std::move(message), std::move(hint)});
  };
  for (const WantedVariable& each : wanted) {
    const reader::Variable* const variable = info.find(each.name);
    if (variable == nullptr) {
      complain(each.where, "the plant's program has no variable '" + each.name + "'",
               hint_of(info, each.name));
    } else if (bytecode::is_string(variable->type)) {
      complain(each.where, "variable '" + each.name + "' of the plant's program is a string",
               "a terminal is a number or a BOOL");
    } else {
      found.push_back(*variable);
    }
  }
  for (const reader::TaskInfo& task : info.tasks()) {
    if (!is_never_past(task)) continue;
    complain(program, "task '" + task.name + "' of the plant's program has no interval",
             "TASK " + task.name + "(INTERVAL := T#10ms, PRIORITY := 1)");
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return found;
}

ProgramPlant::ProgramPlant(reader::LoadedProgram loaded)
    : loaded_(std::move(loaded)),
      memory_(loaded_.program().memory_size()),
      image_(memory_, scan::layout_of(loaded_.program())),
      safe_outputs_(image_.outputs().size()) {}

result::Result<std::unique_ptr<ProgramPlant>> ProgramPlant::create(std::vector<std::byte> container,
                                                                   const stepped::StepNames& names,
                                                                   const Parameters& parameters,
                                                                   const result::Location& program) {
  auto loaded = reader::LoadedProgram::load(std::move(container), "the plant's program");
  if (!loaded) return result::forward(loaded);
  auto info = reader::ProgramInfo::read(loaded->bytes());
  if (!info) return result::forward(info);
  std::vector<WantedVariable> wanted;
  for (const auto* list : {&names.actuators, &names.sensors, &names.values, &names.faults}) {
    for (const std::string& name : *list) wanted.push_back({name, program});
  }
  for (const auto& [name, value] : parameters) wanted.push_back({name, program});
  auto found = find_variables(*info, wanted, program);
  if (!found) return result::forward(found);

  std::unique_ptr<ProgramPlant> plant(new ProgramPlant(std::move(*loaded)));
  auto engine = host::make_engine(host::EngineKind::Auto, plant->loaded_.program());
  if (!engine) return result::forward(engine);
  plant->engine_ = std::move(*engine);
  plant->cycle_ =
      std::make_unique<scan::ScanCycle>(plant->loaded_.program(), *plant->engine_, plant->image_,
                                        plant->safe_outputs_, plant->io_, plant->clock_, scan::ScanConfig{});
  plant->cycle_->start({});
  auto next = found->begin();
  const auto take = [&next](std::size_t count) {
    std::vector<reader::Variable> list(next, next + static_cast<std::ptrdiff_t>(count));
    next += static_cast<std::ptrdiff_t>(count);
    return list;
  };
  plant->actuators_ = take(names.actuators.size());
  plant->sensors_ = take(names.sensors.size());
  plant->values_ = take(names.values.size());
  const std::vector<reader::Variable> faults = take(names.faults.size());
  for (const auto& [name, value] : parameters) store_number(*next++, value, plant->image_.bytes());
  for (const reader::Variable& variable : faults) {
    plant->faults_.push_back({variable, reader::read_number(variable, plant->image_.bytes())});
  }
  return plant;
}

void ProgramPlant::sample(const stepped::StepArea& area) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    area.set_sensor(i, reader::read_number(sensors_[i], image_.bytes()));
  for (std::size_t i = 0; i < values_.size(); ++i)
    area.set_value(i, reader::read_number(values_[i], image_.bytes()));
}

std::string ProgramPlant::step(std::int64_t time_ns, const stepped::StepArea& area) {
  for (std::size_t i = 0; i < actuators_.size(); ++i)
    store_number(actuators_[i], area.actuator(i), image_.bytes());
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    Fault& fault = faults_[i];
    const double now = area.fault(i);
    if (now == fault.known) continue;
    fault.known = now;
    store_number(fault.variable, now == 0.0 ? fault.without : now, image_.bytes());
  }
  while (cycle_->next_time_ns() < time_ns) {
    const scan::ScanReport report = cycle_->run_scan();
    if (report.trap) return result::to_string(reader::describe(loaded_.program(), report.trap));
  }
  sample(area);
  return {};
}

}  // namespace stepwright::program_plant
