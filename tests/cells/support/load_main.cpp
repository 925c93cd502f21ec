// cells_load SOCKET INTERVAL_US [trap|damaged|barrier|hello]: downloads a program with one task of that
// interval to the runtime behind the socket, starts it and ends. Two steps follow each other after 10 scans,
// the last one stays; with `trap` it ends in a trap. `damaged` downloads one that the verifier refuses,
// `barrier` starts with one, `hello` only says hello.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "runtime/service/connection.h"
#include "tests/support/patience.h"
#include "tests/support/step_program.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  if (argc < 3) return 2;
  auto connection = service::Connection::open(argv[1], {service::Role::Controller, "cells_load", 0});
  if (!connection) return std::fprintf(stderr, "%s\n", result::to_string(connection.error()).c_str()), 1;
  const std::string what = argc > 3 ? argv[3] : "";
  if (what == "hello") return 0;
  auto program = support::step_program({.steps = 2,
                                        .trap_at_end = what == "trap",
                                        .interval_us = static_cast<std::uint32_t>(std::atoi(argv[2]))});
  if (what == "damaged") program[program.size() / 2] ^= std::byte{1};
  using support::kPatience;
  auto digest = (*connection)->download(program, kPatience);
  if (!digest) return std::fprintf(stderr, "%s\n", result::to_string(digest.error()).c_str()), 1;
  auto started = (*connection)->call(service::Start{.barrier = what == "barrier"}, kPatience);
  if (!started) return std::fprintf(stderr, "%s\n", result::to_string(started.error()).c_str()), 1;
  std::puts(digest->c_str());
  return 0;
}
