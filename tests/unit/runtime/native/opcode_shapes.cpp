#include "tests/unit/runtime/native/opcode_shapes.h"

#include "runtime/bytecode/trap.h"

namespace stepwright::native {

using bytecode::Opcode;
using bytecode::Operands;

namespace {

using namespace edge_layout;

constexpr const char* kLetters = "bilfdr";
constexpr std::uint32_t kSmallest = 0x80000000u;
constexpr std::uint32_t kLargest = 0x7FFFFFFFu;

// The opcode as its list entry says, once for each list of operands.
std::vector<Shape> with(Opcode opcode, const std::vector<std::vector<std::uint32_t>>& operands) {
  std::vector<Shape> out;
  for (const auto& each : operands)
    out.push_back({opcode, bytecode::info(opcode).pops, bytecode::info(opcode).pushes, each});
  return out;
}

std::vector<Shape> with_constants(Opcode opcode, const std::vector<std::uint64_t>& bounds) {
  std::vector<Shape> out;
  for (std::size_t i = 0; i < bounds.size(); i += 2)
    out.push_back({opcode, "l", "l", {0, 1}, {bounds[i], bounds[i + 1]}});
  return out;
}

// Loads, stores and fused operations at fixed places: operands that the test fills, and the memory's ends.
std::vector<Shape> fixed_places(Opcode opcode) {
  const bool of_this = std::string(bytecode::info(opcode).name).ends_with("This");
  // What lies in an instance as a BOOL is 0 or 1.
  const bool boolean = std::string(bytecode::info(opcode).name).find("Bool") != std::string::npos;
  const std::uint32_t place = boolean && of_this ? kBools : of_this ? 24u : kInputs + 24;
  if (bytecode::info(opcode).operands == Operands::U32)
    return with(opcode, {{place}, {place + 1}, {of_this ? kInstanceBytes - 8 : kImageBytes - 8}});
  return with(opcode, {{place, place + 1}, {place + 1, place}, {place, place}, {place + 1, place + 4}});
}

std::vector<Shape> of_locals(Opcode opcode) {
  std::vector<Shape> out;
  for (const char* letter = kLetters; *letter != '\0'; ++letter) {
    const std::string type(1, *letter);
    if (opcode == Opcode::LocalGet) out.push_back({opcode, "", type, {0}, {}, type});
    if (opcode == Opcode::LocalSet) out.push_back({opcode, type, "", {0}, {}, type});
    if (opcode == Opcode::Dup) out.push_back({opcode, type, type + type});
    if (opcode == Opcode::Drop) out.push_back({opcode, type, ""});
    if (opcode == Opcode::Select) out.push_back({opcode, type + type + "b", type});
  }
  return out;
}

std::vector<Shape> to_integers(Opcode opcode) {
  std::vector<Shape> out;
  for (std::uint32_t i = 0; i < bytecode::kIntTypeCount; ++i) {
    const bool wide = stack_type(static_cast<bytecode::IntType>(i)) == bytecode::StackType::I64;
    out.push_back({opcode, bytecode::info(opcode).pops, wide ? "l" : "i", {i}});
  }
  return out;
}

template <typename List>
std::vector<Shape> second_level(Opcode opcode, const List& list) {
  std::vector<Shape> out;
  for (std::uint32_t i = 0; i < list.size(); ++i) out.push_back({opcode, list[i].pops, list[i].pushes, {i}});
  return out;
}

std::vector<Shape> traps() {
  std::vector<Shape> out;
  for (std::uint32_t code = 1; code < bytecode::kTrapCodeCount; ++code)
    out.push_back({Opcode::Trap, "", "", {code}});
  return out;
}

}  // namespace

std::vector<Shape> shapes_of(Opcode opcode) {
  switch (opcode) {
    case Opcode::LocalGet:
    case Opcode::LocalSet:
    case Opcode::Dup:
    case Opcode::Drop:
    case Opcode::Select:
      return of_locals(opcode);
    case Opcode::LoadBit:
    case Opcode::StoreBit:
      return with(opcode, {{kInputs + 24, 0}, {kInputs + 24, 3}, {kInputs + 25, 7}, {kImageBytes - 1, 7}});
    case Opcode::AddrAbs:
      return with(opcode, {{0}, {kImageBytes - 1}});
    case Opcode::AddrThis:
      return with(opcode, {{0}, {kInstanceBytes - 1}});
    case Opcode::AddrFrame:
      return with(opcode, {{0}, {kFrameBytes - 1}});
    case Opcode::Index:
      return with(opcode, {{0, 0, 0},
                           {0, 7, 1},
                           {static_cast<std::uint32_t>(-3), 4, 8},
                           {2, 9, 12},
                           {kSmallest, kLargest, 1},
                           {kSmallest, kSmallest, 16},
                           {kLargest, kLargest, 2},
                           {0, kLargest, kImageBytes},
                           {static_cast<std::uint32_t>(-1), 1, 7}});
    case Opcode::IndexDyn:
      return with(opcode, {{0}, {1}, {8}, {12}, {kImageBytes}});
    case Opcode::Offset:
      return with(opcode, {{0}, {1}, {kImageBytes}});
    case Opcode::MemCopy:
      return with(opcode, {{0}, {1}, {8}, {13}, {16}, {100}, {kImageBytes}});
    case Opcode::ConstBool:
      return with(opcode, {{0}, {1}});
    case Opcode::ConstI32:
      return with(opcode, {{0}, {1}, {0xFFFFFFFF}, {kSmallest}, {kLargest}});
    case Opcode::ConstF32:
      return with(opcode, {{0}, {kSmallest}, {0x3F800000}, {0x7F800000}, {0x7FC00000}, {0x7F800001}, {1}});
    case Opcode::ConstI64:
    case Opcode::ConstF64: {
      std::vector<Shape> out;
      for (const std::uint64_t bits : {0ull, 1ull, ~0ull, 1ull << 63, 0x7FF0000000000001ull, 1ull << 31})
        out.push_back({opcode, "", bytecode::info(opcode).pushes, {0}, {bits}});
      return out;
    }
    case Opcode::CheckI32:
      return with(opcode,
                  {{0, 0}, {static_cast<std::uint32_t>(-2), 31}, {kSmallest, kLargest}, {1, kLargest}});
    case Opcode::CheckI64:
      return with_constants(
          opcode, {0, 0, static_cast<std::uint64_t>(-2), 31, 1ull << 63, (1ull << 63) - 1, 1, 1ull << 40});
    case Opcode::CheckU64:
      return with_constants(opcode, {0, 0, 2, 31, 0, ~0ull, 1ull << 63, ~0ull, 1, 1ull << 40});
    case Opcode::RolI32:
    case Opcode::RorI32:
      return with(opcode, {{8}, {16}, {32}});
    case Opcode::RoundF32:
    case Opcode::RoundF64:
    case Opcode::TruncF32:
    case Opcode::TruncF64:
      return to_integers(opcode);
    case Opcode::Intrinsic:
      return second_level(opcode, bytecode::kIntrinsics);
    case Opcode::StringOp:
      return second_level(opcode, bytecode::kStringOps);
    case Opcode::Trap:
      return traps();
    default:
      break;
  }
  const bytecode::OpcodeInfo& info = bytecode::info(opcode);
  if (info.operands == Operands::None && *info.pops != '*') return with(opcode, {{}});
  if (bytecode::is_fused_boolean(opcode)) return fixed_places(opcode);
  const bool access = opcode >= Opcode::LoadBoolAbs && opcode <= Opcode::StoreRefInd;
  return access ? fixed_places(opcode) : std::vector<Shape>{};
}

std::string name_of(const Shape& shape) {
  std::string out = bytecode::info(shape.opcode).name;
  if (shape.opcode == Opcode::Intrinsic) return out + " " + bytecode::kIntrinsics[shape.operands[0]].name;
  if (shape.opcode == Opcode::StringOp) return out + " " + bytecode::kStringOps[shape.operands[0]].name;
  for (const std::uint32_t each : shape.operands)
    out += " " + std::to_string(static_cast<std::int32_t>(each));
  return out;
}

}  // namespace stepwright::native
