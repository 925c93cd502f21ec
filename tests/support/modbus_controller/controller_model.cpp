#include "tests/support/modbus_controller/controller_model.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/host/step_watch.h"
#include "runtime/image/image_bits.h"
#include "runtime/image/io_driver.h"
#include "runtime/scan/no_clock.h"
#include "runtime/service/digest.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::support {
namespace {

// The terminals: what the inputs block brought, what the outputs block shows.
class Terminals final : public image::IoDriver {
 public:
  explicit Terminals(const bytecode::SizesRecord& sizes)
      : inputs(sizes.input_bytes), outputs(sizes.output_bytes) {}
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> area) override {
    std::ranges::copy(inputs, area.begin());
    return status;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> area) override {
    std::ranges::copy(area, outputs.begin());
    return status;
  }
  std::vector<std::byte> inputs;
  std::vector<std::byte> outputs;
  image::IoStatus status = image::IoStatus::Good;
};

}  // namespace

struct ControllerModel::Machine {
  explicit Machine(reader::LoadedProgram program)
      : loaded(std::move(program)),
        memory(loaded.program().memory_size()),
        stack(loaded.program().sizes().stack_slots),
        image(memory, scan::layout_of(loaded.program())),
        engine(loaded.program(), stack),
        terminals(loaded.program().sizes()),
        safe_outputs(loaded.program().sizes().output_bytes),
        cycle(loaded.program(), engine, image, safe_outputs, terminals, clock, {}),
        steps(loaded.program()) {
    image.reset(loaded.program().container().section(bytecode::Section::InitialData));
  }

  reader::LoadedProgram loaded;
  std::vector<std::byte> memory;
  std::vector<std::uint64_t> stack;
  image::ProcessImage image;
  vm::Interpreter engine;
  Terminals terminals;
  scan::NoClock clock;
  std::vector<std::byte> safe_outputs;
  scan::ScanCycle cycle;
  host::StepWatch steps;
};

ControllerModel::ControllerModel(const ModelLimits& limits) : limits_(limits) {}
ControllerModel::~ControllerModel() = default;
ControllerModel::ControllerModel(ControllerModel&&) noexcept = default;
ControllerModel& ControllerModel::operator=(ControllerModel&&) noexcept = default;

std::uint16_t ControllerModel::flags() const {
  std::uint16_t flags = 0;
  if (lock_step_) flags |= control::kLockStep;
  if (transferring_) flags |= control::kTransferring;
  if (inputs_lost_) flags |= control::kInputsLost;
  return flags;
}

std::int64_t ControllerModel::next_ns() const {
  return state_ == control::State::Running ? machine_->cycle.next_time_ns() : next_start_ns_;
}

std::uint64_t ControllerModel::image_hash() const {
  return machine_ ? machine_->image.hash() : 0;
}
std::span<const std::byte> ControllerModel::program() const {
  return machine_ ? machine_->loaded.bytes() : std::span<const std::byte>{};
}
std::span<const std::byte> ControllerModel::image() const {
  return machine_ ? std::as_const(machine_->image).bytes() : std::span<const std::byte>{};
}
std::span<const std::byte> ControllerModel::outputs() const {
  return machine_ ? std::span<const std::byte>(machine_->terminals.outputs) : std::span<const std::byte>{};
}
std::uint16_t ControllerModel::input_bytes() const {
  return machine_ ? static_cast<std::uint16_t>(machine_->terminals.inputs.size()) : std::uint16_t{0};
}

void ControllerModel::note(control::Event kind) {
  ++event_;
  event_kind_ = kind;
  event_scan_ = scan_;
  event_image_.assign(image().begin(), image().end());
}

ModelAnswer ControllerModel::start(bool lock_step, bool) {
  if (!machine_) return {control::Refusal::NoProgram};
  if (state_ == control::State::Running) return {control::Refusal::AlreadyRunning};
  const image::ForceTable forces = machine_->cycle.forces();
  machine_->terminals.status = image::IoStatus::Good;
  machine_->cycle.start({next_start_ns_, scan_, trace_hash_});
  machine_->cycle.forces() = forces;
  machine_->steps.reset(machine_->image.bytes());
  state_ = control::State::Running;
  lock_step_ = lock_step;
  inputs_lost_ = false;
  trap_ = {};
  started_ns_ = now_ns_ - next_start_ns_;
  heard_ns_ = now_ns_;
  note(control::Event::Started);
  return {};
}

ModelAnswer ControllerModel::stop() {
  if (!machine_) return {control::Refusal::NoProgram};
  if (state_ != control::State::Running) return {};
  next_start_ns_ = machine_->cycle.next_time_ns();
  machine_->cycle.stop();
  state_ = control::State::Stopped;
  note(control::Event::Stopped);
  return {};
}

ModelAnswer ControllerModel::begin_transfer(std::uint32_t bytes, std::span<const std::byte> digest) {
  if (bytes > limits_.max_program_bytes) return {control::Refusal::TooLarge, limits_.max_program_bytes};
  transferring_ = true;
  transfer_.clear();
  transfer_bytes_ = bytes;
  transfer_digest_.assign(digest.begin(), digest.end());
  return {};
}

bool ControllerModel::piece(std::uint32_t offset, std::span<const std::byte> bytes) {
  if (!transferring_ || offset > transfer_.size() || offset + bytes.size() > transfer_bytes_) return false;
  if (offset + bytes.size() <= transfer_.size()) return true;  // a repetition
  if (offset != transfer_.size()) return false;
  transfer_.insert(transfer_.end(), bytes.begin(), bytes.end());
  return true;
}

ModelAnswer ControllerModel::commit() {
  if (!transferring_ || transfer_.size() < transfer_bytes_)
    return {control::Refusal::Incomplete, transfer_bytes_ - transferred()};
  transferring_ = false;
  if (!std::ranges::equal(service::sha256(transfer_), transfer_digest_))
    return {control::Refusal::WrongDigest};
  return install(std::exchange(transfer_, {}), transfer_digest_);
}

ModelAnswer ControllerModel::install(std::vector<std::byte> container, std::vector<std::byte> digest) {
  auto loaded = reader::LoadedProgram::load(std::move(container), "transfer");
  if (!loaded) return {control::Refusal::NotVerified};
  if (loaded->program().memory_size() > limits_.max_image_bytes)
    return {control::Refusal::NotSupported, limits_.max_image_bytes};
  stop();
  machine_ = std::make_unique<Machine>(std::move(*loaded));
  digest_ = std::move(digest);
  state_ = control::State::Stopped;
  trap_ = {};
  return {};
}

ModelAnswer ControllerModel::abort() {
  transferring_ = false;
  transfer_.clear();
  return {};
}

ModelAnswer ControllerModel::change_bits(control::Command command, std::uint32_t byte, std::uint64_t mask,
                                         std::uint64_t value) {
  if (!machine_) return {control::Refusal::NoProgram};
  const std::span<std::byte> image = machine_->image.bytes();
  const auto bytes = static_cast<std::size_t>(std::bit_width(mask) + 7) / 8;
  if (bytes == 0 || byte > image.size() || bytes > image.size() - byte)
    return {control::Refusal::OutOfBounds};
  if (command == control::Command::WriteBits) {
    std::uint64_t now = 0;
    std::memcpy(&now, image.data() + byte, bytes);
    now = (now & ~mask) | (value & mask);
    std::memcpy(image.data() + byte, &now, bytes);
    return {};
  }
  image::Force force;
  if (image::to_force({byte, mask, value}, image.size(), force) != image::BitsStatus::Done)
    return {control::Refusal::OutOfBounds};
  image::ForceTable& forces = machine_->cycle.forces();
  if (command == control::Command::Unforce)
    return {forces.clear(force.address, force.bit) ? control::Refusal::Done : control::Refusal::NotForced};
  return {forces.set(force, image.size()) ? control::Refusal::Done : control::Refusal::ForcesFull};
}

void ControllerModel::scan_once() {
  const scan::ScanReport report = machine_->cycle.run_scan();
  scan_ = report.scan;
  time_ns_ = report.time_ns;
  trace_hash_ = machine_->cycle.trace_hash();
  const bool changed = machine_->steps.changed(machine_->image.bytes());
  if (report.state != scan::ScanState::Running) {
    next_start_ns_ = machine_->cycle.next_time_ns();
    trap_ = report.trap;
    state_ = control::State::Fault;
    note(control::Event::Trap);
  } else if (changed) {
    note(control::Event::StepChange);
  }
}

void ControllerModel::turn(std::uint16_t number, std::span<const std::byte> inputs) {
  heard_ns_ = now_ns_;
  if (!machine_) return;
  const bool repeated = number == turn_;
  if (lock_step_ && repeated) return;
  turn_ = number;
  const std::size_t count = std::min(inputs.size(), machine_->terminals.inputs.size());
  std::ranges::copy(inputs.first(count), machine_->terminals.inputs.begin());
  if (lock_step_ && state_ == control::State::Running) scan_once();
}

void ControllerModel::tick(std::int64_t now_ns) {
  if (powered_ns_ == 0) powered_ns_ = now_ns;
  now_ns_ = now_ns;
  uptime_ns_ = now_ns - powered_ns_;
  if (state_ != control::State::Running || lock_step_) return;
  const bool io = !machine_->terminals.inputs.empty() || !machine_->terminals.outputs.empty();
  if (io && now_ns - heard_ns_ > limits_.inputs_lost_after_ns) {
    machine_->terminals.status = image::IoStatus::Lost;
    inputs_lost_ = true;
  }
  machine_->cycle.skip_to(now_ns - started_ns_ - 1'000'000'000);  // what is missed by more is left out
  while (state_ == control::State::Running && machine_->cycle.next_time_ns() <= now_ns - started_ns_)
    scan_once();
}

std::int64_t ControllerModel::next_tick_ns() const {
  if (state_ != control::State::Running || lock_step_) return -1;
  return started_ns_ + machine_->cycle.next_time_ns();
}

void ControllerModel::reset() {
  std::unique_ptr<Machine> before = std::move(machine_);
  const std::vector<std::byte> digest = digest_;
  const ModelLimits limits = limits_;
  const std::int64_t now_ns = now_ns_;
  *this = ControllerModel(limits);
  now_ns_ = powered_ns_ = now_ns;
  if (!before) return;
  const auto bytes = before->loaded.bytes();
  static_cast<void>(install({bytes.begin(), bytes.end()}, digest));
}

}  // namespace stepwright::support
