#include "runtime/bytecode/reader/value_runs.h"

#include "runtime/bytecode/member_bit.h"

namespace stepwright::reader {
namespace {

using bytecode::Section;
using bytecode::TypeKind;

// An image of a runtime ends at 1 MiB, and each of its values takes a byte at least; what holds them is
// visited, too. A hostile container may lay members over each other without end.
constexpr std::uint32_t kMaxVisits = 4u << 20;
constexpr std::uint64_t kMaxBytes = 4u * bytecode::kMaxImageBytes;
// Types lead to earlier ones only, so that nothing holds itself; deep is what nobody declares.
constexpr std::uint32_t kMaxDepth = 256;

class Walk {
 public:
  Walk(const bytecode::ContainerView& view, const std::function<void(const ValueRun&)>& visit)
      : view_(view), visit_(visit) {}

  bool symbol(const bytecode::SymbolRecord& symbol) {
    if (symbol.bit == bytecode::kNoBit) return type(symbol.type, symbol.address, 0);
    return bit(symbol.address, symbol.bit);
  }

 private:
  bool type(std::uint32_t index, std::uint32_t address, std::uint32_t depth) {
    if (++visits_ > kMaxVisits || depth > kMaxDepth) return false;
    const auto record = view_.record<Section::Types>(index);
    if (record.size == 0) return true;  // a struct without members
    switch (static_cast<TypeKind>(record.kind)) {
      case TypeKind::Array:
        return array(record, address, depth);
      case TypeKind::Struct:
      case TypeKind::Instance:
        return members(record, address, depth);
      default:
        return run(record, address, 1);
    }
  }

  bool array(const bytecode::TypeRecord& record, std::uint32_t address, std::uint32_t depth) {
    const auto element = view_.record<Section::Types>(record.first);
    const auto kind = static_cast<TypeKind>(element.kind);
    if (kind != TypeKind::Array && kind != TypeKind::Struct && kind != TypeKind::Instance) {
      return run(element, address, record.count);
    }
    for (std::uint32_t i = 0; i < record.count; ++i) {
      if (!type(record.first, address + i * element.size, depth + 1)) return false;
    }
    return true;
  }

  bool members(const bytecode::TypeRecord& record, std::uint32_t address, std::uint32_t depth) {
    for (std::uint32_t i = 0; i < record.count; ++i) {
      const auto member = view_.record<Section::Members>(record.first + i);
      const std::uint32_t at = address + member.offset;
      const std::uint8_t number = bytecode::member_bit(member.flags);
      if (!(number == bytecode::kNoBit ? type(member.type, at, depth + 1) : bit(at, number))) return false;
    }
    return true;
  }

  bool bit(std::uint32_t address, std::uint8_t number) {
    return visit({TypeKind::Elementary, bytecode::ElementaryType::Bool, address, 1, 1, number});
  }

  bool run(const bytecode::TypeRecord& record, std::uint32_t address, std::uint32_t count) {
    if (record.size == 0) return true;
    return visit({static_cast<TypeKind>(record.kind),
                  static_cast<bytecode::ElementaryType>(record.elementary), address, record.size, count,
                  bytecode::kNoBit});
  }

  bool visit(const ValueRun& run) {
    bytes_ += std::uint64_t{run.size} * run.count;
    if (bytes_ > kMaxBytes) return false;
    visit_(run);
    return true;
  }

  const bytecode::ContainerView& view_;
  const std::function<void(const ValueRun&)>& visit_;
  std::uint32_t visits_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

result::Result<void> visit_values(const bytecode::Program& program, const std::string& name,
                                  const std::function<void(const ValueRun&)>& visit) {
  const bytecode::ContainerView& view = program.container();
  Walk walk(view, visit);
  for (std::uint32_t i = 0; i < view.count<Section::Symbols>(); ++i) {
    if (walk.symbol(view.record<Section::Symbols>(i))) continue;
    return result::fail("R0021", {name, 0, 0},
                        "the program's types come to more values than an image holds, or nest deeper than " +
                            std::to_string(kMaxDepth) + " levels",
                        "no program that `stepwright compile` makes does; compile it again");
  }
  return {};
}

}  // namespace stepwright::reader
