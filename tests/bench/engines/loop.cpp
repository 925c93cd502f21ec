#include "tests/bench/engines/workload.h"

namespace stepwright::bench {

namespace {

constexpr const char* kSt = R"(PROGRAM main
VAR
  a, b, c : ARRAY[0..99] OF REAL;
  gain : REAL := -0.5;
  bias : REAL;
  x, y : REAL;
  i, j : DINT;
END_VAR
FOR i := 1 TO 10000 DO
  x := a[j] * gain + b[j];
  y := bias - x * 0.5;
  c[j] := c[j] * gain + y;
  a[j] := (x + y) * 0.25;
  b[j] := x;
  j := j + 1;
  IF j > 99 THEN j := 0; END_IF;
END_FOR;
END_PROGRAM
)";

// Array bounds are checked, as the engines do it.
constexpr const char* kHand = R"(
static float a[100], b[100], c[100], gain = -0.5f, bias, x, y;
static int i, j;
#define CHECK(index) do { if ((unsigned)(index) > 99) __builtin_trap(); } while (0)
void set(const unsigned char *bools, const float *reals) { (void)bools; bias = reals[0]; }
void scan(long long now_ns) {
  (void)now_ns;
  for (i = 1; i <= 10000; ++i) {
    CHECK(j);
    x = a[j] * gain + b[j];
    y = bias - x * 0.5f;
    c[j] = c[j] * gain + y;
    a[j] = (x + y) * 0.25f;
    b[j] = x;
    j = j + 1;
    if (j > 99) j = 0;
  }
}
void get(double *results) {
  *results++ = x;
  *results++ = y;
  *results++ = j;
  for (int k = 0; k < 100; ++k) *results++ = a[k];
  for (int k = 0; k < 100; ++k) *results++ = b[k];
  for (int k = 0; k < 100; ++k) *results++ = c[k];
}
)";

// No bounds checks; arithmetic with a literal is in double.
constexpr const char* kMatiecBody = R"(
typedef float REAL;
typedef int DINT;
typedef struct { REAL value[100]; FLAGS flags; } TABLE;
typedef struct { TABLE a, b, c; VAR(REAL) gain; VAR(REAL) bias; VAR(REAL) x; VAR(REAL) y; VAR(DINT) i; VAR(DINT) j; } MAIN;
static MAIN instance = {.gain = {.value = -0.5f}};
static MAIN *volatile where = &instance;
void set(const unsigned char *bools, const float *reals) { (void)bools; instance.bias.value = reals[0]; }
void scan(long long now_ns) {
  (void)now_ns;
  MAIN *data = where;
  for (SET_ONE(data->i, 1); GET(data->i) <= 10000; SET_ONE(data->i, GET(data->i) + 1)) {
    SET(data->x, data->a.value[GET(data->j)] * GET(data->gain) + data->b.value[GET(data->j)]);
    SET(data->y, GET(data->bias) - GET(data->x) * 0.5);
    SET_ELEMENT(data->c, GET(data->j), data->c.value[GET(data->j)] * GET(data->gain) + GET(data->y));
    SET_ELEMENT(data->a, GET(data->j), (GET(data->x) + GET(data->y)) * 0.25);
    SET_ELEMENT(data->b, GET(data->j), GET(data->x));
    SET(data->j, GET(data->j) + 1);
    if (GET(data->j) > 99) SET(data->j, 0);
  }
}
void get(double *results) {
  *results++ = instance.x.value;
  *results++ = instance.y.value;
  *results++ = instance.j.value;
  for (int k = 0; k < 100; ++k) *results++ = instance.a.value[k];
  for (int k = 0; k < 100; ++k) *results++ = instance.b.value[k];
  for (int k = 0; k < 100; ++k) *results++ = instance.c.value[k];
}
)";

constexpr const char* kSetAsExpression =
    "#define SET_ONE(v, x) ((v).flags & FORCED ? (v).value : ((v).value = (x)))\n";

}  // namespace

Workload loop() {
  Workload out{"loop", kSt, kHand, std::string(kMatiecStyle) + kSetAsExpression + kMatiecBody, {}, {}, {}};
  out.reals = {"main.bias"};
  out.results = {"main.x", "main.y", "main.j"};
  for (const char* const table : {"a", "b", "c"}) {
    for (int k = 0; k < 100; ++k)
      out.results.push_back(std::string("main.") + table + "[" + std::to_string(k) + "]");
  }
  return out;
}

}  // namespace stepwright::bench
