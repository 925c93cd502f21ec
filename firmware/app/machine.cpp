#include "firmware/app/machine.h"

#include <cstring>

#include "firmware/app/operation_set.h"
#include "firmware/app/retained_values.h"

namespace stepwright::app {
namespace {

namespace control = modbus::control;
using bytecode::Section;
using control::Refusal;

// What load() takes from the arena.
std::uint64_t need_of(const bytecode::Program& program) {
  return Arena::rounded(program.memory_size()) +
         Arena::rounded(std::uint64_t{program.sizes().stack_slots} * 8) +
         Arena::rounded(program.image_size()) + Arena::rounded(retain_bytes(program));
}

Lacking lacking(const bytecode::Program& program, std::size_t memory) {
  if (program.sizes().input_bytes > kMaxInputBytes) return Lacking::InputBytes;
  if (program.sizes().output_bytes > kMaxOutputBytes) return Lacking::OutputBytes;
  if (need_of(program) > memory) return Lacking::Memory;
  if (kBasic && !is_basic(program)) return Lacking::Operations;
  return Lacking::Nothing;
}

Judgement not_supported(Lacking what) {
  return {Refusal::NotSupported, static_cast<std::uint32_t>(what)};
}

}  // namespace

Machine::Machine(std::span<std::byte> memory, ModbusIo& io, scan::Clock& clock)
    : arena_(memory), io_(io), clock_(clock) {}

Judgement Machine::judge(std::span<const std::byte> container) {
  const std::span<std::uint32_t> scratch = arena_.rest<std::uint32_t>();
  if (bytecode::verify_scratch_words(container) > scratch.size()) return not_supported(Lacking::Scratch);
  const bytecode::VerifyResult result = bytecode::verify(container, scratch, judged_);
  if (!result.ok()) return {Refusal::NotVerified, static_cast<std::uint32_t>(result.status)};
  if (const Lacking what = lacking(judged_, arena_.size()); what != Lacking::Nothing)
    return not_supported(what);
  judged_bytes_ = container;
  return {};
}

std::uint64_t Machine::judged_retain_bytes() const {
  return retain_bytes(judged_);
}

void Machine::load(const storage::Digest& digest) {
  if (cycle_) earlier_overruns_ += cycle_->statistics().overruns;
  cycle_.reset();
  arena_.reset();
  program_ = judged_;
  container_ = judged_bytes_;
  digest_ = digest;
  const std::span<std::byte> memory = arena_.take<std::byte>(program_.memory_size());
  std::memset(memory.data(), 0, memory.size());
  image_.emplace(memory, scan::layout_of(program_));
  const auto stack = arena_.take<std::uint64_t>(program_.sizes().stack_slots);
  engine_.emplace(program_, stack);  // its code is run where it stands in the flash
  const auto event_image = arena_.take<std::byte>(program_.image_size());
  retain_copy_ = arena_.take<std::byte>(static_cast<std::size_t>(retain_bytes(program_)));
  image_->reset(program_.container().section(Section::InitialData));
  safe_outputs_.fill(std::byte{0});
  make_cycle(scan::ScanConfig::kNoOrigin);
  trap_ = {};
  io_.clear();
  state_ = control::State::Stopped;
  cycle_->stop();
  events_.use(event_image, image_->bytes());
}

// Forces stay: they belong to the program, not to one of its starts.
void Machine::make_cycle(std::int64_t clock_origin_ns) {
  image::ForceTable forces;
  if (cycle_) {
    forces = cycle_->forces();
    earlier_overruns_ += cycle_->statistics().overruns;
  }
  const scan::ScanConfig config{.budget = kBudget, .clock_origin_ns = clock_origin_ns};
  const auto safe_outputs = std::span(safe_outputs_).first(image_->outputs().size());
  cycle_.emplace(program_, *engine_, *image_, safe_outputs, io_, clock_, config);
  cycle_->forces() = forces;
}

Refusal Machine::start(const StartOptions& options) {
  if (state_ == control::State::Empty) return Refusal::NoProgram;
  if (running()) return Refusal::AlreadyRunning;
  lock_step_ = options.lock_step;
  origin_ns_ = options.now_ns - next_.time_ns;
  make_cycle(lock_step_ ? scan::ScanConfig::kNoOrigin : origin_ns_);
  const image::ForceTable forces = cycle_->forces();
  cycle_->start({next_.time_ns, figures_.scan, figures_.trace_hash});
  cycle_->forces() = forces;
  if (!options.retained.empty()) restore_retained(program_, options.retained, image_->bytes());
  trap_ = {};
  state_ = control::State::Running;
  events_.record(control::Event::Started, figures_.scan, image_->bytes());
  return Refusal::Done;
}

Refusal Machine::stop() {
  if (state_ == control::State::Empty) return Refusal::NoProgram;
  if (!running()) return Refusal::Done;
  next_.time_ns = cycle_->next_time_ns();
  cycle_->stop();
  state_ = control::State::Stopped;
  events_.record(control::Event::Stopped, figures_.scan, image_->bytes());
  return Refusal::Done;
}

void Machine::fault() {
  next_.time_ns = cycle_->next_time_ns();
  state_ = control::State::Fault;
  events_.record(control::Event::Trap, figures_.scan, image_->bytes());
}

void Machine::scan() {
  const std::int64_t begin_ns = clock_.now_ns();
  const scan::ScanReport report = cycle_->run_scan();
  figures_.scan = report.scan;
  figures_.time_ns = report.time_ns;
  figures_.image_hash = report.image_hash;
  figures_.trace_hash = cycle_->trace_hash();
  figures_.took_ns = clock_.now_ns() - begin_ns;
  if (figures_.took_ns > figures_.longest_ns) figures_.longest_ns = figures_.took_ns;
  if (report.trap) trap_ = report.trap;
  if (report.state != scan::ScanState::Running) {
    fault();
  } else if (events_.steps_changed(program_, image_->bytes())) {
    events_.record(control::Event::StepChange, figures_.scan, image_->bytes());
  }
}

bool Machine::due(std::int64_t now_ns) {
  if (!running() || lock_step_) return false;
  cycle_->settle_overruns(now_ns - origin_ns_);
  return cycle_->next_time_ns() <= now_ns - origin_ns_;
}

void Machine::idle() {
  if (cycle_ && !running()) cycle_->idle(next_.time_ns);
}

void Machine::end_forces(std::int64_t now_ns) {
  if (!cycle_) return;
  image::Force ended;
  while (cycle_->forces().take_ended(now_ns, ended)) {
  }
}

ScanFigures Machine::figures() const {
  ScanFigures figures = figures_;
  figures.overruns = earlier_overruns_ + (cycle_ ? cycle_->statistics().overruns : 0);
  return figures;
}

std::int64_t Machine::next_time_ns() const {
  return running() ? cycle_->next_time_ns() : next_.time_ns;
}

}  // namespace stepwright::app
