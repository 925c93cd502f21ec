#include "runtime/modbus/server/runtime_data.h"

#include <thread>
#include <utility>

#include "runtime/modbus/server/internal/runtime_session.h"

namespace stepwright::modbus::server {
namespace {

using internal::Exchange;
using internal::Program;
using map::Table;
using pdu::Exception;
using pdu::Function;

}  // namespace

struct RuntimeData::State {
  State(const RuntimeDataOptions& wanted, News told)
      : options(wanted), news(std::move(told)), session(options, news, exchange) {}

  // The program as of now; null: nothing can be read. The server's own copy, so that no request takes a lock.
  const Program* current() {
    const std::uint64_t changes = exchange.changes.load(std::memory_order_acquire);
    if (changes != seen) {
      const std::lock_guard lock(exchange.mutex);
      program = exchange.program;
      seen = changes;
    }
    const auto now = std::chrono::nanoseconds(internal::Clock::now().time_since_epoch()).count();
    if (now > exchange.good_until_ns.load(std::memory_order_acquire)) return nullptr;
    return program.get();
  }

  RuntimeDataOptions options;
  News news;
  Exchange exchange;
  internal::RuntimeSession session;
  std::shared_ptr<const Program> program;
  std::uint64_t seen = 0;
  std::thread thread;
};

result::Result<std::unique_ptr<RuntimeData>> RuntimeData::create(const RuntimeDataOptions& options,
                                                                 News news) {
  auto state = std::make_unique<State>(options, std::move(news));
  if (!state->exchange.ok()) return result::fail("R0101", {}, "the system gives no more descriptors");
  state->thread = std::thread([session = &state->session] { session->run(); });
  return std::unique_ptr<RuntimeData>(new RuntimeData(std::move(state)));
}

RuntimeData::RuntimeData(std::unique_ptr<State> state) : state_(std::move(state)) {}

RuntimeData::~RuntimeData() {
  state_->exchange.quit.store(true);
  state_->exchange.work.notify();
  state_->thread.join();
}

pdu::Exception RuntimeData::read(const pdu::Request& request, std::span<std::byte> table) {
  const Program* const program = state_->current();
  if (program == nullptr) return Exception::DeviceFailure;
  auto exception = Exception::DeviceFailure;
  const auto copy = [&](const host::SnapshotView& view) {
    exception = Exception::DeviceFailure;
    if (!view.is_of(program->digest)) return;
    switch (request.function) {
      case Function::ReadCoils:
      case Function::ReadDiscreteInputs: {
        const Table bits = request.function == Function::ReadCoils ? Table::Coils : Table::DiscreteInputs;
        exception = program->map.read_bits(view, bits, request.address, request.count, table);
        return;
      }
      default: {
        const bool input = request.function == Function::ReadInputRegisters;
        const Table words = input ? Table::InputRegisters : Table::HoldingRegisters;
        exception = program->map.read_registers(view, words, request.address, request.count, table);
      }
    }
  };
  return program->connection->snapshots().consistent(copy) ? exception : Exception::DeviceFailure;
}

pdu::Exception RuntimeData::begin_write(std::uint64_t ticket, const pdu::Request& request) {
  const Program* const program = state_->current();
  if (program == nullptr) return Exception::DeviceFailure;
  map::Parts parts;
  auto exception = Exception::IllegalFunction;
  switch (request.function) {
    case Function::WriteSingleCoil:
    case Function::WriteMultipleCoils:
      exception = program->map.write_coils(request.address, request.count, request.data, parts);
      break;
    case Function::MaskWriteRegister:
      exception = program->map.mask_register(request.address, request.and_mask, request.or_mask, parts);
      break;
    case Function::ReadWriteMultipleRegisters:
      if (!program->map.covers(Table::HoldingRegisters, request.address, request.count))
        return Exception::IllegalDataAddress;
      exception =
          program->map.write_registers(request.write_address, request.write_count, request.data, parts);
      break;
    default:
      exception = program->map.write_registers(request.address, request.count, request.data, parts);
  }
  if (exception != Exception::None) return exception;
  Exchange& exchange = state_->exchange;
  const bool nothing = parts.empty();
  {
    const std::lock_guard lock(exchange.mutex);
    if (nothing) {
      exchange.written.push_back({ticket, Exception::None});  // a mask that changes nothing
    } else {
      if (exchange.writes.size() >= internal::kMostQueued) return Exception::DeviceBusy;
      exchange.writes.push_back({ticket,
                                 {program->digest, std::move(parts)},
                                 internal::Clock::now() + state_->options.write_timeout});
    }
  }
  (nothing ? exchange.done : exchange.work).notify();
  return Exception::None;
}

std::optional<Written> RuntimeData::take_written() {
  const std::lock_guard lock(state_->exchange.mutex);
  if (state_->exchange.written.empty()) return std::nullopt;
  const Written written = state_->exchange.written.front();
  state_->exchange.written.pop_front();
  return written;
}

int RuntimeData::descriptor() const {
  return state_->exchange.done.descriptor();
}

void RuntimeData::clear() {
  state_->exchange.done.clear();
}

bool RuntimeData::serving() {
  return state_->current() != nullptr;
}

}  // namespace stepwright::modbus::server
