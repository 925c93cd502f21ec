#pragma once

// The three programs of the engine benchmark: each as ST, as C in the manner of matiec's output (a value and
// its flags side by side, a test of the force flag at every assignment, short-circuit && and ||, literals in
// double precision), and as the branch-free C that one would write by hand for the same job.
//
// Each C text defines
//   void set(const unsigned char *bools, const float *reals);  the inputs of the next scan
//   void scan(long long now_ns);
//   void get(double *results);                                 in the order of `results`

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::bench {

struct Workload {
  std::string name;
  std::string st;
  std::string hand_c;
  std::string matiec_style_c;
  std::vector<std::string> bools;    // inputs by their path, set in every scan
  std::vector<std::string> reals;    // the same, of type REAL
  std::vector<std::string> results;  // what all must agree on
};

// `count` rungs of three contacts and a coil: q := a AND NOT b OR c, over 128 inputs and the coils above.
Workload rungs(std::uint32_t count);

// 10,000 rounds of 9 arithmetic operations, a comparison, 6 array accesses and 3 assignments, in REAL.
Workload loop();

// 100 on-delay timers, 100 counters, 100 PID controllers of 16 floating-point operations, 100 assignments.
Workload blocks();

// Common beginning of both renderings in C.
inline constexpr const char* kMatiecStyle = R"(
typedef unsigned char BOOL;
typedef unsigned char FLAGS;
#define FORCED 0x02
#define VAR(type) struct { type value; FLAGS flags; }
#define GET(v) ((v).value)
#define SET(v, x) do { if (!((v).flags & FORCED)) (v).value = (x); } while (0)
#define SET_ELEMENT(v, i, x) do { if (!((v).flags & FORCED)) (v).value[i] = (x); } while (0)
)";

}  // namespace stepwright::bench
