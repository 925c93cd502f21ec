#include "tests/bench/ltl_monitor/watched_program.h"

#include <stdexcept>

namespace stepwright::bench {

namespace {

constexpr const char* kPlant = R"(PROGRAM main
VAR p1, p2, p3, p4, p5, p6, p7, p8 : BOOL; scans : UDINT; END_VAR
scans := scans + 1;
END_PROGRAM
)";

}  // namespace

WatchedProgram::WatchedProgram(EngineKind kind, std::span<const driver::Watcher> watchers)
    : program_(compile_st(kPlant, watchers), kind), places_(program_.variable("main.p1").address) {
  if (program_.variable("main.p8").address != places_ + kPlaces - 1)
    throw std::runtime_error("the places do not lie side by side");
  if (watchers.empty()) {
    reset_ = verdict_ = places_;
    return;
  }
  reset_ = program_.variable(watchers.front().name + ".Reset").address;
  verdict_ = program_.variable(watchers.front().name + ".Verdict").address;
}

}  // namespace stepwright::bench
