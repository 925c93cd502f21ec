#include "runtime/operations/intrinsics.h"

#include "runtime/operations/arithmetic.h"
#include "runtime/operations/elementary.h"

namespace stepwright::operations {

namespace {

// IEEE 754 requires the square root to be rounded correctly, so that every machine gives the same bits.
inline float square_root(float x) {
  return __builtin_sqrtf(x);
}
inline double square_root(double x) {
  return __builtin_sqrt(x);
}

template <typename T>
bool replace_by_root(Slot* sp) {
  const T x = from_slot<T>(sp[-1]);
  if (x < 0) return false;
  sp[-1] = to_slot(square_root(x));
  return true;
}

template <typename T>
void replace_by_magnitude(Slot* sp) {
  const T x = from_slot<T>(sp[-1]);
  if (x < 0) sp[-1] = negate(static_cast<std::make_unsigned_t<T>>(x));
}

// The smaller of two; where they compare neither way (NaN) the first.
template <typename T>
void replace_by_smaller(Slot*& sp) {
  --sp;
  if (from_slot<T>(sp[0]) < from_slot<T>(sp[-1])) sp[-1] = sp[0];
}

template <typename T>
void replace_by_larger(Slot*& sp) {
  --sp;
  if (from_slot<T>(sp[-1]) < from_slot<T>(sp[0])) sp[-1] = sp[0];
}

template <typename T>
bool replace_by(Elementary function, Slot* sp) {
  double result = 0;
  if (!elementary(function, static_cast<double>(from_slot<T>(sp[-1])), result)) return false;
  sp[-1] = to_slot(static_cast<T>(result));
  return true;
}

template <typename T>
bool replace_by_angle(Slot*& sp) {
  --sp;
  sp[-1] = to_slot(static_cast<T>(arc_tangent(from_slot<T>(sp[-1]), from_slot<T>(sp[0]))));
  return true;
}

template <typename T>
bool replace_by_power(Slot*& sp) {
  double result = 0;
  if (!power(from_slot<T>(sp[-2]), from_slot<T>(sp[-1]), result)) return false;
  --sp;
  sp[-1] = to_slot(static_cast<T>(result));
  return true;
}

}  // namespace

bool call_intrinsic(bytecode::IntrinsicId id, Slot*& sp) {
  using Id = bytecode::IntrinsicId;
  switch (id) {
    case Id::AbsI32:
      replace_by_magnitude<std::int32_t>(sp);
      return true;
    case Id::AbsI64:
      replace_by_magnitude<std::int64_t>(sp);
      return true;
    case Id::AbsF32:
      sp[-1] &= 0x7FFFFFFFu;
      return true;
    case Id::AbsF64:
      sp[-1] &= 0x7FFFFFFFFFFFFFFFull;
      return true;
    case Id::SqrtF32:
      return replace_by_root<float>(sp);
    case Id::SqrtF64:
      return replace_by_root<double>(sp);
    case Id::MinI32:
      replace_by_smaller<std::int32_t>(sp);
      return true;
    case Id::MinI64:
      replace_by_smaller<std::int64_t>(sp);
      return true;
    case Id::MinU32:
      replace_by_smaller<std::uint32_t>(sp);
      return true;
    case Id::MinU64:
      replace_by_smaller<std::uint64_t>(sp);
      return true;
    case Id::MinF32:
      replace_by_smaller<float>(sp);
      return true;
    case Id::MinF64:
      replace_by_smaller<double>(sp);
      return true;
    case Id::MaxI32:
      replace_by_larger<std::int32_t>(sp);
      return true;
    case Id::MaxI64:
      replace_by_larger<std::int64_t>(sp);
      return true;
    case Id::MaxU32:
      replace_by_larger<std::uint32_t>(sp);
      return true;
    case Id::MaxU64:
      replace_by_larger<std::uint64_t>(sp);
      return true;
    case Id::MaxF32:
      replace_by_larger<float>(sp);
      return true;
    case Id::MaxF64:
      replace_by_larger<double>(sp);
      return true;
    case Id::SinF32:
      return replace_by<float>(Elementary::Sin, sp);
    case Id::SinF64:
      return replace_by<double>(Elementary::Sin, sp);
    case Id::CosF32:
      return replace_by<float>(Elementary::Cos, sp);
    case Id::CosF64:
      return replace_by<double>(Elementary::Cos, sp);
    case Id::TanF32:
      return replace_by<float>(Elementary::Tan, sp);
    case Id::TanF64:
      return replace_by<double>(Elementary::Tan, sp);
    case Id::AsinF32:
      return replace_by<float>(Elementary::Asin, sp);
    case Id::AsinF64:
      return replace_by<double>(Elementary::Asin, sp);
    case Id::AcosF32:
      return replace_by<float>(Elementary::Acos, sp);
    case Id::AcosF64:
      return replace_by<double>(Elementary::Acos, sp);
    case Id::AtanF32:
      return replace_by<float>(Elementary::Atan, sp);
    case Id::AtanF64:
      return replace_by<double>(Elementary::Atan, sp);
    case Id::ExpF32:
      return replace_by<float>(Elementary::Exp, sp);
    case Id::ExpF64:
      return replace_by<double>(Elementary::Exp, sp);
    case Id::LnF32:
      return replace_by<float>(Elementary::Ln, sp);
    case Id::LnF64:
      return replace_by<double>(Elementary::Ln, sp);
    case Id::LogF32:
      return replace_by<float>(Elementary::Log, sp);
    case Id::LogF64:
      return replace_by<double>(Elementary::Log, sp);
    case Id::Atan2F32:
      return replace_by_angle<float>(sp);
    case Id::Atan2F64:
      return replace_by_angle<double>(sp);
    case Id::PowF32:
      return replace_by_power<float>(sp);
    case Id::PowF64:
      return replace_by_power<double>(sp);
  }
  return false;
}

}  // namespace stepwright::operations
