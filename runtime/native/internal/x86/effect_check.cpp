#include "runtime/native/internal/x86/effect_check.h"

#include <limits>

namespace stepwright::native {

using asmjit::x86::CondCode;
namespace x86 = asmjit::x86;

namespace {

constexpr std::uint64_t kMostImmediate = std::numeric_limits<std::int32_t>::max();

// Around the instructions of one check: the flags may hold a comparison that is still needed.
class Check {
 public:
  explicit Check(FunctionWork& work) : work_(work), out_(work.out()), good_(out_.newLabel()) {
    out_.pushfq();
  }

  // The check holds under this condition; else the number of the check is noted, if it is the first.
  void holds_if(CondCode condition) {
    const x86::Mem noted = x86::ptr(kContext, static_cast<std::int32_t>(offsetof(Context, broken_check)), 4);
    std::vector<CodePlace>& checks = *work_.program().checks;
    checks.push_back({work_.function(), work_.current().pc});
    out_.j(condition, good_);
    out_.cmp(noted, 0);
    out_.jne(good_);
    out_.mov(noted, static_cast<std::uint32_t>(checks.size()));
    out_.bind(good_);
    out_.popfq();
  }

  // How far the place lies behind this one, compared with a distance; unsigned, so before it is far, too.
  void compare_distance(const Location& place, Space space, std::int64_t first, std::uint64_t distance) {
    const x86::Gp base = space == Space::Image ? kImage : space == Space::Instance ? kSelf : kContext;
    out_.lea(gp64(kScratch), work_.operands().memory(place, 1));
    out_.sub(gp64(kScratch), base);
    out_.sub(gp64(kScratch), static_cast<std::int32_t>(first));
    out_.cmp(gp64(kScratch), static_cast<std::int32_t>(distance));
  }

 private:
  FunctionWork& work_;
  x86::Assembler& out_;
  asmjit::Label good_;
};

Location place_of(const Pinned& variable) {
  return {variable.where.space, variable.where.first, kNoRegister, 0};
}

void check_equal(FunctionWork& work, const Location& place, std::uint32_t bytes, RegisterId reg) {
  Check check(work);
  if (is_xmm(reg)) {
    bytes == 4 ? work.out().movd(gp32(kScratch), xmm(reg)) : work.out().movq(gp64(kScratch), xmm(reg));
    reg = kScratch;
  }
  work.out().cmp(work.operands().memory(place, bytes), general(reg, bytes));
  check.holds_if(CondCode::kEqual);
}

void check_within(FunctionWork& work, const Location& place, const Extent& extent, std::uint32_t bytes) {
  if (extent.space == Space::Unknown || extent.end > kMostImmediate) return;
  Check check(work);
  check.compare_distance(place, extent.space, static_cast<std::int64_t>(extent.first),
                         extent.end - extent.first - bytes);
  check.holds_if(CondCode::kUnsignedLE);
}

// Far enough before or behind the variable.
void check_apart(FunctionWork& work, const Location& place, const Extent& variable, std::uint32_t bytes) {
  Check check(work);
  check.compare_distance(place, variable.space, static_cast<std::int64_t>(variable.first) - bytes + 1,
                         variable.end - variable.first + bytes - 1);
  check.holds_if(CondCode::kUnsignedGE);
}

}  // namespace

void check_access(FunctionWork& work, const Location& place, const MemoryEffect& effect,
                  std::uint32_t bytes) {
  if (work.program().checks == nullptr || bytes == 0) return;
  check_within(work, place, effect.extent, bytes);
  if (work.loop() == nullptr) return;
  for (const Pinned& variable : work.loop()->variables) {
    if (effect.store || variable.written) check_apart(work, place, variable.where, bytes);
  }
}

void check_address(FunctionWork& work, Value& address, const MemoryEffect& effect, std::uint32_t bytes) {
  if (work.program().checks == nullptr) return;
  if (address.is(Value::Kind::Address)) return check_within(work, address.location, effect.extent, bytes);
  const RegisterId reg = work.operands().in_register(address);
  check_within(work, {Space::Image, 0, reg, 0}, effect.extent, bytes);
}

void write_through(FunctionWork& work, const Pinned& variable) {
  if (work.program().checks == nullptr) return;
  work.operands().store_register(place_of(variable), size_of(variable.type), variable.reg);
}

void check_known(FunctionWork& work, const Value& load, RegisterId known) {
  check_equal(work, load.location, load.bytes(), known);
}

void check_loop(FunctionWork& work) {
  if (work.program().checks == nullptr || work.loop() == nullptr) return;
  const RegisterId ahead = work.take_ahead();
  for (const Pinned& variable : work.loop()->variables) {
    if (variable.reg != ahead) check_equal(work, place_of(variable), size_of(variable.type), variable.reg);
  }
}

}  // namespace stepwright::native
