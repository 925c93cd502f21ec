#include "runtime/operations/elementary.h"

namespace stepwright::operations {

namespace {

bool in_domain(Elementary function, double x) {
  switch (function) {
    case Elementary::Asin:
    case Elementary::Acos:
      return !(x < -1.0 || x > 1.0);
    case Elementary::Ln:
    case Elementary::Log:
      return !(x <= 0.0);
    default:
      return true;
  }
}

double value_of(Elementary function, double x) {
  switch (function) {
    case Elementary::Sin:
      return __builtin_sin(x);
    case Elementary::Cos:
      return __builtin_cos(x);
    case Elementary::Tan:
      return __builtin_tan(x);
    case Elementary::Asin:
      return __builtin_asin(x);
    case Elementary::Acos:
      return __builtin_acos(x);
    case Elementary::Atan:
      return __builtin_atan(x);
    case Elementary::Exp:
      return __builtin_exp(x);
    case Elementary::Ln:
      return __builtin_log(x);
    case Elementary::Log:
      return __builtin_log10(x);
  }
  return 0.0;
}

bool is_nan(double x) {
  return x != x;
}

}  // namespace

bool elementary(Elementary function, double x, double& result) {
  if (!in_domain(function, x)) return false;
  result = value_of(function, x);
  return true;
}

double arc_tangent(double y, double x) {
  return __builtin_atan2(y, x);
}

bool power(double x, double y, double& result) {
  if (x == 0.0 && y < 0.0) return false;
  const double value = __builtin_pow(x, y);
  if (is_nan(value) && !is_nan(x) && !is_nan(y)) return false;
  result = value;
  return true;
}

}  // namespace stepwright::operations
