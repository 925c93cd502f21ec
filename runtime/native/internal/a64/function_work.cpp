#include "runtime/native/internal/a64/function_work.h"

#include <utility>

namespace stepwright::native::a64 {

using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

// Instructions of a function beyond which its code could be longer than a branch with a condition reaches:
// none becomes more than 80 bytes.
constexpr std::size_t kFarItems = (1u << 20) / 80;

}  // namespace

FunctionWork::FunctionWork(ProgramWork& program, std::uint32_t function)
    : program_(program),
      function_(function),
      emit_(program.out),
      operands_(emit_, own().places.first_slot + code().record.local_count * kSlotBytes) {
  emit_.set_far(code().items.size() > kFarItems);
}

bool FunctionWork::next_is_branch() const {
  const std::uint32_t index = item_ + 1;
  if (index >= code().items.size() || code().items[index].is_target) return false;
  const Opcode opcode = code().items[index].instruction.opcode;
  return opcode == Opcode::JumpIfFalse || opcode == Opcode::JumpIfTrue;
}

std::optional<CondCode> FunctionWork::take_flags() {
  return std::exchange(condition_, std::nullopt);
}

asmjit::Label FunctionWork::trap(TrapCode code, std::uint32_t refund) {
  program_.sites.push_back({code, function_, this->code().items[item_].pc});
  Cold& cold = cold_.emplace_back();
  cold.label = out().newLabel();
  cold.site = static_cast<std::uint32_t>(program_.sites.size());
  cold.refund = refund;
  return cold.label;
}

asmjit::Label FunctionWork::reference_trap(RegisterId reference) {
  const asmjit::Label label = trap(TrapCode::BadReference);
  program_.sites.push_back({TrapCode::NullReference, function_, code().items[item_].pc});
  cold_.back().reference = reference;
  return label;
}

void FunctionWork::settle_nan(StackType type, RegisterId result, RegisterId x, RegisterId y) {
  Cold& cold = cold_.emplace_back();
  cold.label = out().newLabel();
  cold.back = out().newLabel();
  cold.type = type;
  cold.result = result;
  cold.x = x;
  cold.y = y;
  out().fcmp(vector(result, type), vector(result, type));
  emit_.branch(CondCode::kVS, cold.label);
  out().bind(cold.back);
}

void FunctionWork::take(std::uint32_t bytes) {
  if (bytes < 4096) {
    out().subs(kBudget, kBudget, bytes);
  } else {
    emit_.constant(x(kScratch), bytes);
    out().subs(kBudget, kBudget, x(kScratch));
  }
}

void FunctionWork::charge(std::uint32_t bytes) {
  take(bytes);
  emit_.branch(CondCode::kLO, trap(TrapCode::Watchdog, bytes));
  cold_.back().paid = out().newLabel();
  out().bind(cold_.back().paid);
}

// The slice of the budget is too small: another one, if there is any.
void FunctionWork::emit_refill(const Cold& cold) {
  emit_.add(kBudget, kBudget, cold.refund);
  emit_.constant(w(kScratch), cold.refund);
  out().str(w(kScratch), field(offsetof(Context, cost)));
  out().bl(program_.refill);
  take(cold.refund);
  emit_.branch(CondCode::kHS, cold.paid);
}

void FunctionWork::emit_cold() {
  for (const Cold& cold : cold_) {
    out().bind(cold.label);
    if (cold.paid.isValid()) emit_refill(cold);
    cold.site != 0 ? emit_trap(cold) : emit_nan(cold);
  }
  cold_.clear();
}

void FunctionWork::emit_trap(const Cold& cold) {
  if (cold.refund != 0) emit_.add(kBudget, kBudget, cold.refund);
  if (cold.reference != kNoRegister) {
    const asmjit::Label null = out().newLabel();
    emit_.compare(x(cold.reference), bytecode::kNullRef);
    out().b(CondCode::kHS, null);
    emit_.constant(w(0), cold.site);
    out().b(program_.trapped);
    out().bind(null);
    emit_.constant(w(0), cold.site + 1);
  } else {
    emit_.constant(w(0), cold.site);
  }
  out().b(program_.trapped);
}

// That of x, else that of y, made quiet, else a negative one without a payload (operations::settle_nan).
void FunctionWork::emit_nan(const Cold& cold) {
  const bool single = cold.type == StackType::F32;
  const Gp bits = single ? static_cast<Gp>(w(kScratch)) : static_cast<Gp>(x(kScratch));
  const std::uint64_t quiet = single ? std::uint64_t{1} << 22 : std::uint64_t{1} << 51;
  const asmjit::Label of_x = out().newLabel();
  const asmjit::Label of_y = out().newLabel();
  const auto take = [&](RegisterId operand) {
    out().fmov(bits, vector(operand, cold.type));
    out().orr(bits, bits, quiet);
    out().fmov(vector(cold.result, cold.type), bits);
    out().b(cold.back);
  };
  out().fcmp(vector(cold.x, cold.type), vector(cold.x, cold.type));
  out().b(CondCode::kVS, of_x);
  out().fcmp(vector(cold.y, cold.type), vector(cold.y, cold.type));
  out().b(CondCode::kVS, of_y);
  emit_.constant(bits, single ? 0xFFC00000u : 0xFFF8000000000000u);
  out().fmov(vector(cold.result, cold.type), bits);
  out().b(cold.back);
  out().bind(of_x);
  take(cold.x);
  out().bind(of_y);
  take(cold.y);
}

bool FunctionWork::reads_plain_bool() const {
  return facts().plain_bool(function_, facts().effect(function_, item_, false).extent);
}

}  // namespace stepwright::native::a64
