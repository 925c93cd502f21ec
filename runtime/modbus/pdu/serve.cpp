#include "runtime/modbus/pdu/serve.h"

#include "runtime/modbus/pdu/answer.h"
#include "runtime/modbus/pdu/identification.h"
#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::pdu {
namespace {

Exception carry_out(DataModel& model, const Request& request, std::span<std::byte> table) {
  switch (request.function) {
    case Function::ReadCoils:
      return model.read_bits(BitTable::Coils, request.address, request.count, table);
    case Function::ReadDiscreteInputs:
      return model.read_bits(BitTable::DiscreteInputs, request.address, request.count, table);
    case Function::ReadHoldingRegisters:
      return model.read_registers(RegisterTable::Holding, request.address, request.count, table);
    case Function::ReadInputRegisters:
      return model.read_registers(RegisterTable::Input, request.address, request.count, table);
    case Function::WriteSingleCoil:
    case Function::WriteMultipleCoils:
      return model.write_coils(request.address, request.count, request.data);
    case Function::WriteSingleRegister:
    case Function::WriteMultipleRegisters:
      return model.write_registers(request.address, request.count, request.data);
    case Function::MaskWriteRegister:
      return model.mask_register(request.address, request.and_mask, request.or_mask);
    case Function::ReadWriteMultipleRegisters:
      return model.read_write_registers(
          {request.address, request.count, request.write_address, request.write_count, request.data}, table);
    case Function::EncapsulatedInterface:
      break;
  }
  return Exception::IllegalFunction;
}

}  // namespace

std::size_t serve(DataModel& model, std::span<const std::byte> pdu, std::span<std::byte> out) {
  if (pdu.empty()) return 0;
  const Parsed parsed = parse(pdu);
  if (parsed.exception != Exception::None) return answer_exception(parsed.function, parsed.exception, out);
  const Request& request = parsed.request;
  if (request.function == Function::EncapsulatedInterface) return answer_identification(request, model, out);
  const std::size_t bytes = request.reads_table() ? table_bytes(request) : 0;
  const Exception exception = carry_out(model, request, table_data(out, bytes));
  if (exception != Exception::None) return answer_exception(parsed.function, exception, out);
  return request.reads_table() ? answer_table(request.function, bytes, out) : answer_write(request, out);
}

}  // namespace stepwright::modbus::pdu
