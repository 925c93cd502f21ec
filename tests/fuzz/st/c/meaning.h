/* What ST's operations mean, in C, written from runtime/doc/bytecode_format.md and the standard, without a
   look at the engines: the third opinion in differential tests. Included once by every generated file. */

#include <math.h>
#include <setjmp.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { DIVISION_BY_ZERO = 1, CONVERSION_RANGE = 2, INDEX_RANGE = 3, BAD_ARGUMENT = 6, SUBRANGE_RANGE = 8 };

struct leaf {
  void* address;
  size_t size;
};
struct program {
  void (*init)(void);
  int (*scan)(void); /* the code of the trap; 0: none */
  const struct leaf* leaves;
  size_t leaf_count;
};

static jmp_buf trapped;
static _Noreturn void trap(int code) {
  longjmp(trapped, code);
}

/* Integers wrap. */
#define INTEGER(NAME, T)                                         \
  static inline T add_##NAME(T a, T b) {                         \
    return (T)((uint64_t)a + (uint64_t)b);                       \
  }                                                              \
  static inline T sub_##NAME(T a, T b) {                         \
    return (T)((uint64_t)a - (uint64_t)b);                       \
  }                                                              \
  static inline T mul_##NAME(T a, T b) {                         \
    return (T)((uint64_t)a * (uint64_t)b);                       \
  }                                                              \
  static inline T neg_##NAME(T a) {                              \
    return (T)(0 - (uint64_t)a);                                 \
  }                                                              \
  static inline T abs_##NAME(T a) {                              \
    return a < 0 ? neg_##NAME(a) : a;                            \
  }                                                              \
  static inline T div_##NAME(T a, T b) {                         \
    if (b == 0) trap(DIVISION_BY_ZERO);                          \
    return (T)-1 < 0 && b == (T)-1 ? neg_##NAME(a) : (T)(a / b); \
  }                                                              \
  static inline T mod_##NAME(T a, T b) {                         \
    return b == 0 || ((T)-1 < 0 && b == (T)-1) ? 0 : (T)(a % b); \
  }                                                              \
  ORDERED(NAME, T)

#define ORDERED(NAME, T)                 \
  static inline T min_##NAME(T a, T b) { \
    return b < a ? b : a;                \
  }                                      \
  static inline T max_##NAME(T a, T b) { \
    return a < b ? b : a;                \
  }

#define BITS(NAME, T, WIDTH)                                         \
  static inline T shl_##NAME(T a, int32_t n) {                       \
    if (n < 0) trap(BAD_ARGUMENT);                                   \
    return (uint32_t)n < WIDTH ? (T)((uint64_t)a << n) : 0;          \
  }                                                                  \
  static inline T shr_##NAME(T a, int32_t n) {                       \
    if (n < 0) trap(BAD_ARGUMENT);                                   \
    return (uint32_t)n < WIDTH ? (T)(a >> n) : 0;                    \
  }                                                                  \
  static inline T rol_##NAME(T a, int32_t n) {                       \
    if (n < 0) trap(BAD_ARGUMENT);                                   \
    const unsigned by = (uint32_t)n % WIDTH;                         \
    return by == 0 ? a : (T)((uint64_t)a << by | a >> (WIDTH - by)); \
  }                                                                  \
  static inline T ror_##NAME(T a, int32_t n) {                       \
    if (n < 0) trap(BAD_ARGUMENT);                                   \
    const unsigned by = (uint32_t)n % WIDTH;                         \
    return by == 0 ? a : (T)(a >> by | (uint64_t)a << (WIDTH - by)); \
  }                                                                  \
  ORDERED(NAME, T)

#define REALS(NAME, T)                                          \
  static inline T add_##NAME(T a, T b) {                        \
    return a + b;                                               \
  }                                                             \
  static inline T sub_##NAME(T a, T b) {                        \
    return a - b;                                               \
  }                                                             \
  static inline T mul_##NAME(T a, T b) {                        \
    return a * b;                                               \
  }                                                             \
  static inline T neg_##NAME(T a) {                             \
    return -a;                                                  \
  }                                                             \
  static inline T abs_##NAME(T a) {                             \
    return (T)fabs(a);                                          \
  }                                                             \
  static inline T div_##NAME(T a, T b) {                        \
    if (b == 0) trap(DIVISION_BY_ZERO);                         \
    return a / b;                                               \
  }                                                             \
  static inline T sqrt_##NAME(T a) {                            \
    if (a < 0) trap(BAD_ARGUMENT);                              \
    return (T)sqrt(a);                                          \
  }                                                             \
  static inline T ln_##NAME(T a) {                              \
    if (a <= 0) trap(BAD_ARGUMENT);                             \
    return (T)log(a);                                           \
  }                                                             \
  static inline T pow_##NAME(T a, T b) {                        \
    const double y = pow(a, b);                                 \
    if (a == 0 && b < 0) trap(BAD_ARGUMENT);                    \
    if (isnan(y) && !isnan(a) && !isnan(b)) trap(BAD_ARGUMENT); \
    return (T)y;                                                \
  }                                                             \
  static inline T exp_##NAME(T a) {                             \
    return (T)exp(a);                                           \
  }                                                             \
  static inline T sin_##NAME(T a) {                             \
    return (T)sin(a);                                           \
  }                                                             \
  static inline T atan_##NAME(T a) {                            \
    return (T)atan(a);                                          \
  }                                                             \
  ORDERED(NAME, T)

/* Of reals: to the nearest, ties to even, and towards zero. */
#define FROM_REAL(NAME, T, LOW, BEYOND)                    \
  static inline T whole_##NAME(double x) {                 \
    if (!(x >= LOW && x < BEYOND)) trap(CONVERSION_RANGE); \
    return (T)x;                                           \
  }                                                        \
  static inline T round_##NAME(double x) {                 \
    return whole_##NAME(rint(x));                          \
  }                                                        \
  static inline T trunc_##NAME(double x) {                 \
    return whole_##NAME(trunc(x));                         \
  }

INTEGER(SINT, int8_t)
INTEGER(INT, int16_t)
INTEGER(DINT, int32_t)
INTEGER(LINT, int64_t)
INTEGER(USINT, uint8_t)
INTEGER(UINT, uint16_t)
INTEGER(UDINT, uint32_t)
INTEGER(ULINT, uint64_t)
INTEGER(TIME, int64_t)
BITS(BYTE, uint8_t, 8)
BITS(WORD, uint16_t, 16)
BITS(DWORD, uint32_t, 32)
BITS(LWORD, uint64_t, 64)
REALS(REAL, float)
REALS(LREAL, double)
FROM_REAL(SINT, int8_t, -128.0, 128.0)
FROM_REAL(INT, int16_t, -32768.0, 32768.0)
FROM_REAL(DINT, int32_t, -2147483648.0, 2147483648.0)
FROM_REAL(LINT, int64_t, -0x1p63, 0x1p63)
FROM_REAL(USINT, uint8_t, 0.0, 256.0)
FROM_REAL(UINT, uint16_t, 0.0, 65536.0)
FROM_REAL(UDINT, uint32_t, 0.0, 4294967296.0)
FROM_REAL(ULINT, uint64_t, 0.0, 0x1p64)
FROM_REAL(TIME, int64_t, -0x1p63, 0x1p63)

/* A finite number that is too large traps. */
static inline float to_single(double x) {
  const float y = (float)x;
  if (isinf(y) && isfinite(x)) trap(CONVERSION_RANGE);
  return y;
}

static inline int64_t checked_index(int64_t index, int64_t low, int64_t high) {
  if (index < low || index > high) trap(INDEX_RANGE);
  return index - low;
}
