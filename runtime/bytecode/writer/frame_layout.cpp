#include "runtime/bytecode/writer/frame_layout.h"

#include <algorithm>

#include "runtime/bytecode/instruction.h"
#include "runtime/bytecode/stack_need.h"

namespace stepwright::writer {

namespace {

using bytecode::Section;
using bytecode::VerifyResult;
using bytecode::VerifyStatus;

struct CallEdge {
  std::size_t caller = 0;
  std::size_t callee = 0;
  friend auto operator<=>(const CallEdge&, const CallEdge&) = default;
};

// One that is too large stays so.
std::uint32_t end_of_frame(const bytecode::FunctionRecord& function) {
  const std::uint64_t end = std::uint64_t{function.frame_offset} + function.frame_size;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(end, 0xFFFF'FFFF));
}

std::vector<CallEdge> call_edges(const std::vector<Function>& functions) {
  std::vector<CallEdge> edges;
  for (std::size_t f = 0; f < functions.size(); ++f) {
    const std::vector<std::byte>& code = functions[f].code;
    bytecode::Instruction in;
    for (std::uint32_t pc = 0; pc < code.size() && bytecode::decode(code, pc, in); pc += in.size) {
      if (!bytecode::is_call(in.opcode) || in.a >= functions.size()) continue;
      const bool of_function = functions[in.a].kind == bytecode::FunctionKind::Function;
      if (of_function == (in.opcode == bytecode::Opcode::Call)) edges.push_back({f, in.a});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

VerifyResult layout_frames(const ContainerModel& model, SectionBuffers& sections) {
  const std::vector<CallEdge> edges = call_edges(model.functions);
  std::vector<bytecode::FunctionRecord> records;
  for (std::uint32_t f = 0; f < model.functions.size(); ++f) {
    records.push_back(sections.get<Section::Functions>(f));
  }
  std::vector<std::uint32_t> depths(records.size(), 1);

  // An acyclic graph is settled after as many rounds as its longest chain; a cycle never settles.
  for (bool changed = true; changed;) {
    changed = false;
    for (const CallEdge& edge : edges) {
      const bytecode::FunctionRecord& caller = records[edge.caller];
      bytecode::FunctionRecord& callee = records[edge.callee];
      const std::uint32_t depth = std::max(depths[edge.callee], depths[edge.caller] + 1);
      const std::uint32_t offset = std::max(callee.frame_offset, end_of_frame(caller));
      if (depth > bytecode::kMaxCallDepth) {
        return {VerifyStatus::Recursion, Section::Functions, static_cast<std::uint32_t>(edge.callee), 0};
      }
      changed = changed || depth != depths[edge.callee] || offset != callee.frame_offset;
      depths[edge.callee] = depth;
      callee.frame_offset = offset;
    }
  }

  bytecode::SizesRecord sizes = sections.get<Section::Sizes>(0);
  for (std::uint32_t f = 0; f < records.size(); ++f) {
    sizes.frame_bytes = std::max(sizes.frame_bytes, end_of_frame(records[f]));
    sections.set<Section::Functions>(f, records[f]);
  }
  sections.set<Section::Sizes>(0, sizes);
  return {};
}

}  // namespace stepwright::writer
