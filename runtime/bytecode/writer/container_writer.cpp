#include "runtime/bytecode/writer/container_writer.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "runtime/bytecode/code_check.h"
#include "runtime/bytecode/container_parse.h"
#include "runtime/bytecode/instruction.h"
#include "runtime/bytecode/program.h"
#include "runtime/bytecode/stack_need.h"
#include "runtime/bytecode/table_check.h"
#include "runtime/bytecode/writer/section_buffers.h"

namespace stepwright::writer {

namespace {

using bytecode::Section;

std::uint32_t size32(std::size_t size) {
  return static_cast<std::uint32_t>(size);
}

void add_types(const ContainerModel& model, SectionBuffers& out) {
  for (const Type& type : model.types) {
    bytecode::TypeRecord record{};
    record.name = out.string(type.name);
    record.kind = static_cast<std::uint8_t>(type.kind);
    record.elementary = static_cast<std::uint8_t>(type.elementary);
    record.size = type.size;
    record.lower = type.lower;
    const bool array = type.kind == bytecode::TypeKind::Array;
    const bool plain = type.kind == bytecode::TypeKind::Elementary;
    record.first = array ? type.element : plain ? 0 : out.count<Section::Members>();
    record.count = array ? type.count : size32(type.members.size());
    for (const Member& member : type.members) {
      out.add<Section::Members>({out.string(member.name), member.type, member.offset});
    }
    out.add<Section::Types>(record);
  }
}

void add_symbols(const ContainerModel& model, SectionBuffers& out) {
  for (const Symbol& symbol : model.symbols) {
    bytecode::SymbolRecord record{out.string(symbol.name),
                                  symbol.type,
                                  symbol.address,
                                  symbol.bit,
                                  static_cast<std::uint8_t>(symbol.section),
                                  symbol.flags};
    const bool located = !symbol.direct_address.empty();
    if (located) record.flags |= bytecode::kSymbolLocated;
    const std::uint32_t index = out.add<Section::Symbols>(record);
    if (located) out.add<Section::IoMap>({out.string(symbol.direct_address), index});
  }
}

void add_tasks(const ContainerModel& model, SectionBuffers& out) {
  for (const Task& task : model.tasks) {
    out.add<Section::Tasks>({out.string(task.name), task.interval_us, task.priority,
                             out.count<Section::ProgramCalls>(), size32(task.calls.size())});
    for (const ProgramCall& call : task.calls) {
      out.add<Section::ProgramCalls>({out.string(call.name), call.function, call.instance});
    }
  }
}

// Moves the function's own constants into the container's pool and points the code there.
std::vector<std::byte> pooled_code(const Function& function, std::vector<std::uint64_t>& pool) {
  std::vector<std::byte> code = function.code;
  bytecode::Instruction in;
  for (std::uint32_t pc = 0; pc < code.size() && bytecode::decode(code, pc, in); pc += in.size) {
    if (in.opcode != bytecode::Opcode::ConstI64 && in.opcode != bytecode::Opcode::ConstF64) continue;
    if (in.a >= function.constants.size()) continue;  // left to the verifier
    const std::uint64_t value = function.constants[in.a];
    const auto found = std::find(pool.begin(), pool.end(), value);
    const std::uint32_t index = size32(static_cast<std::size_t>(found - pool.begin()));
    if (found == pool.end()) pool.push_back(value);
    std::memcpy(code.data() + pc + 1, &index, sizeof(index));
  }
  return code;
}

void add_functions(const ContainerModel& model, SectionBuffers& out) {
  std::vector<std::uint64_t> pool;
  for (const Function& function : model.functions) {
    const std::vector<std::byte> code = pooled_code(function, pool);
    std::vector<std::byte>& all_code = out.buffer(Section::Code);
    bytecode::FunctionRecord record{};
    record.name = out.string(function.name);
    record.kind = static_cast<std::uint8_t>(function.kind);
    record.result = function.result;
    record.param_count = function.param_count;
    record.local_count = size32(function.locals.size());
    record.first_local = out.count<Section::Locals>();
    record.code_offset = size32(all_code.size());
    record.code_size = size32(code.size());
    record.instance_size = function.instance_size;
    const std::uint32_t index = out.add<Section::Functions>(record);
    all_code.insert(all_code.end(), code.begin(), code.end());
    for (const bytecode::StackType local : function.locals) {
      out.add<Section::Locals>(static_cast<std::uint8_t>(local));
    }
    for (const Function::Line& line : function.lines) {
      out.add<Section::SourceMap>({index, line.pc, line.file, line.line});
    }
  }
  for (const std::uint64_t value : pool) out.add<Section::Constants>(value);
}

std::uint32_t add_links(const std::vector<std::uint32_t>& steps, SectionBuffers& out) {
  const std::uint32_t first = out.count<Section::SfcLinks>();
  for (const std::uint32_t step : steps) out.add<Section::SfcLinks>(step);
  return first;
}

void add_charts(const ContainerModel& model, SectionBuffers& out) {
  for (const SfcChart& chart : model.charts) {
    out.add<Section::SfcCharts>({out.string(chart.name), out.count<Section::SfcSteps>(),
                                 size32(chart.steps.size()), out.count<Section::SfcTransitions>(),
                                 size32(chart.transitions.size())});
    for (const SfcStep& step : chart.steps) {
      const std::uint8_t flags = step.initial ? bytecode::kStepInitial : 0;
      out.add<Section::SfcSteps>(
          {out.string(step.name), out.string(step.comment), step.address, step.bit, flags, 0});
    }
    for (const SfcTransition& transition : chart.transitions) {
      bytecode::SfcTransitionRecord record{};
      record.name = out.string(transition.name);
      record.condition = out.string(transition.condition);
      record.first_source = add_links(transition.sources, out);
      record.source_count = size32(transition.sources.size());
      record.first_target = add_links(transition.targets, out);
      record.target_count = size32(transition.targets.size());
      record.address = transition.address;
      record.bit = transition.bit;
      out.add<Section::SfcTransitions>(record);
    }
  }
}

SectionBuffers sections_of(const ContainerModel& model) {
  SectionBuffers out;
  out.add<Section::Sizes>({model.sizes.input_bytes, model.sizes.output_bytes, model.sizes.marker_bytes,
                           model.sizes.data_bytes, 0, 0});
  add_types(model, out);
  add_symbols(model, out);
  add_tasks(model, out);
  add_functions(model, out);
  add_charts(model, out);
  out.buffer(Section::InitialData) = model.initial_data;
  for (const bytecode::RetainRecord& record : model.retain) out.add<Section::RetainMap>(record);
  for (const std::string& file : model.source_files) out.add<Section::SourceFiles>(out.string(file));
  return out;
}

// The verifier's refusal with the name of what it points at.
tl::unexpected<result::Diagnostics> refuse(const ContainerModel& model,
                                           const bytecode::VerifyResult& verdict) {
  result::Location where;
  std::string place = "section " + std::to_string(static_cast<std::uint32_t>(verdict.section)) + ", record " +
                      std::to_string(verdict.index);
  if (verdict.section == Section::Functions && verdict.index < model.functions.size()) {
    const Function& function = model.functions[verdict.index];
    place = "function " + function.name + ", byte " + std::to_string(verdict.offset);
    for (const Function::Line& line : function.lines) {
      if (line.pc > verdict.offset || line.file >= model.source_files.size()) break;
      where = {model.source_files[line.file], line.line, 0};
    }
  }
  return result::fail("B0100", where, place + ": " + bytecode::explain(verdict.status));
}

// Fills in what only the analysis of the code can know: max_stack, stack_slots, call_depth.
bytecode::VerifyResult complete(SectionBuffers& sections) {
  const std::vector<std::byte> draft = sections.assemble();
  bytecode::ContainerView view;
  if (const auto file = bytecode::parse_container(draft, view); !file.ok()) return file;
  if (const auto tables = bytecode::check_tables(view); !tables.ok()) return tables;
  for (std::uint32_t f = 0; f < view.count<Section::Functions>(); ++f) {
    bytecode::FunctionRecord record = view.record<Section::Functions>(f);
    std::vector<std::uint32_t> scratch(bytecode::code_check_words(record.code_size));
    const bytecode::CodeCheck check = bytecode::check_code(view, f, scratch);
    if (!check.result.ok()) return check.result;
    record.max_stack = check.max_stack;
    sections.set<Section::Functions>(f, record);
  }

  const std::vector<std::byte> measured = sections.assemble();
  if (const auto file = bytecode::parse_container(measured, view); !file.ok()) return file;
  std::vector<std::uint32_t> scratch(bytecode::stack_need_words(view.count<Section::Functions>()));
  const bytecode::StackNeed need = bytecode::compute_stack_need(view, scratch);
  if (!need.result.ok()) return need.result;
  bytecode::SizesRecord sizes = view.sizes();
  sizes.stack_slots = need.stack_slots;
  sizes.call_depth = need.call_depth;
  sections.set<Section::Sizes>(0, sizes);
  return {};
}

}  // namespace

result::Result<std::vector<std::byte>> write_container(const ContainerModel& model) {
  SectionBuffers sections = sections_of(model);
  if (const auto verdict = complete(sections); !verdict.ok()) return refuse(model, verdict);
  std::vector<std::byte> file = sections.assemble();
  std::vector<std::uint32_t> scratch(bytecode::verify_scratch_words(file));
  bytecode::Program program;
  if (const auto verdict = bytecode::verify(file, scratch, program); !verdict.ok())
    return refuse(model, verdict);
  return file;
}

}  // namespace stepwright::writer
