#include "plant_models/ode/subnormals.h"

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace stepwright::ode {
namespace {

#if defined(__x86_64__)
// Intel 64 manual, volume 1, 10.2.3: results (FZ) and arguments (DAZ).
constexpr std::uint64_t kFlush = 0x8040;

std::uint64_t control() {
  return _mm_getcsr();
}
void set_control(std::uint64_t value) {
  _mm_setcsr(static_cast<unsigned>(value));
}
#elif defined(__aarch64__)
// Arm architecture manual, FPCR.FZ: both.
constexpr std::uint64_t kFlush = 1u << 24;

std::uint64_t control() {
  return __builtin_aarch64_get_fpcr64();
}
void set_control(std::uint64_t value) {
  __builtin_aarch64_set_fpcr64(value);
}
#else
constexpr std::uint64_t kFlush = 0;

std::uint64_t control() {
  return 0;
}
void set_control(std::uint64_t) {}
#endif

}  // namespace

SubnormalsFlushed::SubnormalsFlushed() : before_(control()) {
  set_control(before_ | kFlush);
}

SubnormalsFlushed::~SubnormalsFlushed() {
  set_control(before_);
}

}  // namespace stepwright::ode
