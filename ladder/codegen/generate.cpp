#include "ladder/codegen/generate.h"

#include <unordered_set>
#include <utility>

#include "ladder/codegen/container_limits.h"
#include "ladder/codegen/function_emitter.h"
#include "ladder/codegen/symbol_table.h"
#include "runtime/bytecode/writer/container_writer.h"

namespace stepwright::codegen {

namespace {

using semantics::Base;
using semantics::Model;
using semantics::Pou;

void reach(const Pou& pou, std::unordered_set<const Pou*>& reached) {
  if (!reached.insert(&pou).second) return;
  for (const Pou* each : pou.callees) reach(*each, reached);
}

// Only what a task runs becomes code, in the order of the declarations.
std::vector<const Pou*> functions_of(const Model& model) {
  std::unordered_set<const Pou*> reached;
  for (const semantics::Task& task : model.tasks)
    for (const semantics::TaskCall& each : task.calls) reach(*each.pou, reached);
  std::vector<const Pou*> functions;
  for (const auto& pou : model.pous)
    if (reached.count(pou.get()) != 0) functions.push_back(pou.get());
  return functions;
}

ProgramLayout lay_out(const Model& model, const std::vector<const Pou*>& functions) {
  ProgramLayout layout;
  layout.model = &model;
  std::uint32_t address = 0;
  for (std::size_t i = 0; i < layout.bases.size(); ++i) {
    layout.bases[i] = address;
    address += static_cast<std::uint32_t>(model.areas[i].size());
  }
  for (const Pou* each : functions)
    layout.functions.emplace(each, static_cast<std::uint32_t>(layout.functions.size()));
  return layout;
}

void add_memory(const Model& model, const ProgramLayout& layout, writer::ContainerModel& out) {
  const auto size = [&](Base base) { return static_cast<std::uint32_t>(model.area(base).size()); };
  out.sizes = {size(Base::Input), size(Base::Output), size(Base::Marker), size(Base::Data)};
  for (const auto& area : model.areas)
    out.initial_data.insert(out.initial_data.end(), area.begin(), area.end());
  for (const semantics::FirstReference& each : model.references) {
    const std::uint32_t target = layout.address(each.target);
    const std::size_t at = layout.bases[static_cast<std::size_t>(each.base)] +
                           std::size_t{model.offset_in_area(each.offset, each.base)};
    for (unsigned byte = 0; byte < 4; ++byte)
      out.initial_data[at + byte] = static_cast<std::byte>(target >> (8 * byte));
  }
}

void add_tasks(const Model& model, const ProgramLayout& layout, SymbolTable& symbols,
               writer::ContainerModel& out) {
  for (const semantics::Task& task : model.tasks) {
    writer::Task each;
    each.name = task.name;
    each.interval_us = task.interval_us;
    each.priority = task.priority;
    if (task.trigger) each.trigger = symbols.trigger(*task.trigger);
    for (const semantics::TaskCall& call : task.calls)
      each.calls.push_back({call.name, layout.functions.at(call.pou),
                            layout.bases[static_cast<std::size_t>(Base::Data)] + call.offset});
    out.tasks.push_back(std::move(each));
  }
}

}  // namespace

result::Result<std::vector<std::byte>> generate(const Model& model, const std::vector<ChartOrigin>& charts,
                                                const source::SourceSet& sources,
                                                const std::vector<std::string>& file_names) {
  writer::ContainerModel out;
  const std::vector<const Pou*> functions = functions_of(model);
  ProgramLayout layout = lay_out(model, functions);
  add_memory(model, layout, out);
  LiteralPool literals(static_cast<std::uint32_t>(out.initial_data.size()));
  layout.literals = &literals;
  ContainerLimits limits(sources);
  layout.limits = &limits;
  FileTable files(sources, file_names);
  for (const Pou* each : functions) {
    out.functions.push_back(FunctionEmitter(layout, files, *each).run());
    out.functions.back().of_library = sources.is_library(each->where.file);
  }
  out.initial_data.insert(out.initial_data.end(), literals.bytes().begin(), literals.bytes().end());
  out.sizes.data_bytes += static_cast<std::uint32_t>(literals.bytes().size());
  out.source_files = files.names();
  SymbolTable symbols(model, layout, out);
  symbols.globals();
  symbols.configured();
  for (const semantics::ProgramInstance& each : model.instances) symbols.instance(each, charts);
  add_tasks(model, layout, symbols, out);
  symbols.finish();
  if (!limits.errors().empty()) return tl::unexpected(std::move(limits.errors()));
  auto container = writer::try_write_container(out);
  if (!container) return tl::unexpected(limits.explained(std::move(container.error()), out, functions));
  return std::move(*container);
}

}  // namespace stepwright::codegen
