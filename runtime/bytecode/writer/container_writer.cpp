#include "runtime/bytecode/writer/container_writer.h"

#include <cstring>
#include <string>
#include <unordered_map>
#include <utility>

#include "runtime/bytecode/code_check.h"
#include "runtime/bytecode/container_parse.h"
#include "runtime/bytecode/instruction.h"
#include "runtime/bytecode/program.h"
#include "runtime/bytecode/stack_need.h"
#include "runtime/bytecode/table_check.h"
#include "runtime/bytecode/writer/frame_layout.h"
#include "runtime/bytecode/writer/section_buffers.h"

namespace stepwright::writer {

namespace {

using bytecode::Section;

std::uint32_t size32(std::size_t size) {
  return static_cast<std::uint32_t>(size);
}

// What a type is made of: elements, members, enumerators, a target.
void add_parts(const Type& type, bytecode::TypeRecord& record, SectionBuffers& out) {
  using bytecode::TypeKind;
  const bool enumeration = type.kind == TypeKind::Enumeration;
  if (type.kind == TypeKind::Array || type.kind == TypeKind::Reference) record.first = type.element;
  if (type.kind == TypeKind::Array || type.kind == TypeKind::String) record.count = type.count;
  if (type.kind == TypeKind::Array) record.upper = type.lower + type.count - 1;
  if (type.kind != TypeKind::Struct && type.kind != TypeKind::Instance && !enumeration) return;
  record.first = out.count<Section::Members>();
  record.count = size32(type.members.size());
  for (const Member& member : type.members) {
    const std::uint32_t member_type = enumeration ? bytecode::kNoIndex : member.type;
    out.add<Section::Members>({out.string(member.name), member_type, member.offset, member.flags});
  }
}

void add_types(const ContainerModel& model, SectionBuffers& out) {
  for (const Type& type : model.types) {
    bytecode::TypeRecord record{};
    record.name = out.string(type.name);
    record.kind = static_cast<std::uint8_t>(type.kind);
    record.elementary = static_cast<std::uint8_t>(type.elementary);
    record.size = type.size;
    record.lower = type.lower;
    record.upper = type.upper;
    add_parts(type, record, out);
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
                             out.count<Section::ProgramCalls>(), size32(task.calls.size()), task.trigger});
    for (const ProgramCall& call : task.calls) {
      out.add<Section::ProgramCalls>({out.string(call.name), call.function, call.instance});
    }
  }
}

// The constants of all functions, each value once.
class ConstantPool {
 public:
  explicit ConstantPool(SectionBuffers& out) : out_(out) {}

  // Points the constant operands of one function's code into the pool.
  std::vector<std::byte> pooled_code(const Function& function) {
    using bytecode::Opcode;
    std::vector<std::byte> code = function.code;
    bytecode::Instruction in;
    for (std::uint32_t pc = 0; pc < code.size() && bytecode::decode(code, pc, in); pc += in.size) {
      const bool two = in.opcode == Opcode::CheckI64 || in.opcode == Opcode::CheckU64;
      if (!two && in.opcode != Opcode::ConstI64 && in.opcode != Opcode::ConstF64) continue;
      point(function, code.data() + pc + 1, in.a);
      if (two) point(function, code.data() + pc + 5, in.b);
    }
    return code;
  }

 private:
  void point(const Function& function, std::byte* operand, std::uint32_t own_index) {
    if (own_index >= function.constants.size()) return;  // left to the verifier
    const std::uint64_t value = function.constants[own_index];
    const auto [entry, inserted] = index_of_.try_emplace(value, out_.count<Section::Constants>());
    if (inserted) out_.add<Section::Constants>(value);
    std::memcpy(operand, &entry->second, sizeof(entry->second));
  }

  SectionBuffers& out_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_of_;
};

void add_functions(const ContainerModel& model, SectionBuffers& out) {
  ConstantPool pool(out);
  for (const Function& function : model.functions) {
    const std::vector<std::byte> code = pool.pooled_code(function);
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
    record.frame_size = (function.frame_size + 7) / 8 * 8;
    if (function.of_library) record.flags = bytecode::kFunctionOfLibrary;
    const std::uint32_t index = out.add<Section::Functions>(record);
    all_code.insert(all_code.end(), code.begin(), code.end());
    for (const bytecode::StackType local : function.locals) {
      out.add<Section::Locals>(static_cast<std::uint8_t>(local));
    }
    for (const Function::Line& line : function.lines) {
      out.add<Section::SourceMap>({index, line.pc, line.file, line.line, line.column});
    }
  }
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
                           model.sizes.data_bytes, 0, 0, 0});
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
tl::unexpected<Refusal> refuse(const ContainerModel& model, const bytecode::VerifyResult& verdict) {
  result::Location where;
  std::string place = "section " + std::to_string(static_cast<std::uint32_t>(verdict.section)) + ", record " +
                      std::to_string(verdict.index);
  if (verdict.section == Section::Functions && verdict.index < model.functions.size()) {
    const Function& function = model.functions[verdict.index];
    place = "function " + function.name + ", byte " + std::to_string(verdict.offset);
    for (const Function::Line& line : function.lines) {
      if (line.pc > verdict.offset || line.file >= model.source_files.size()) break;
      where = {model.source_files[line.file], line.line, line.column};
    }
  }
  return tl::unexpected<Refusal>(
      {verdict, result::fail("B0100", where, place + ": " + bytecode::explain(verdict.status)).value()});
}

// Fills in what only the analysis of the code can know: frames, max_stack, stack_slots, call_depth.
bytecode::VerifyResult complete(const ContainerModel& model, SectionBuffers& sections) {
  if (const auto frames = layout_frames(model, sections); !frames.ok()) return frames;
  const std::vector<std::byte> draft = sections.assemble();
  if (draft.size() > bytecode::kMaxContainerBytes)
    return {bytecode::VerifyStatus::TooLarge, Section::Code, 0, 0};
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

tl::expected<std::vector<std::byte>, Refusal> try_write_container(const ContainerModel& model) {
  SectionBuffers sections = sections_of(model);
  if (const auto verdict = complete(model, sections); !verdict.ok()) return refuse(model, verdict);
  std::vector<std::byte> file = sections.assemble();
  std::vector<std::uint32_t> scratch(bytecode::verify_scratch_words(file));
  bytecode::Program program;
  if (const auto verdict = bytecode::verify(file, scratch, program); !verdict.ok())
    return refuse(model, verdict);
  return file;
}

result::Result<std::vector<std::byte>> write_container(const ContainerModel& model) {
  auto written = try_write_container(model);
  if (!written) return tl::unexpected<result::Diagnostics>(std::move(written.error().diagnostics));
  return std::move(*written);
}

}  // namespace stepwright::writer
