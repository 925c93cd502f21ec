// The socket fuzz: frames of every kind against a running server, and a valid request on a connection of its
// own after each burst, or after each frame:
//   modbus_socket_fuzz PORT FRAMES SEED batch|each
// Prints one JSON object. Exit code 1 if the server broke its word.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

#include "tests/fuzz/modbus/socket_client.h"
#include "tests/fuzz/modbus/socket_frames.h"
#include "tests/support/patience.h"

namespace {

using namespace stepwright::fuzz::modbus;
using Clock = std::chrono::steady_clock;

using stepwright::support::kPatience;
constexpr std::uint64_t kBatch = 200;  // frames between two valid requests
const Bytes kValid{0x03, 0x00, 0x00, 0x00, 0x02};

struct Figures {
  std::uint64_t frames = 0;
  std::uint64_t valid = 0;
  std::int64_t slowest_us = 0;
};

// The valid request: two holding registers, whatever is in them by now.
void ask_valid(SocketClient& good, Figures& figures) {
  const auto begun = Clock::now();
  const Bytes answer = good.ask(kValid);
  if (answer.size() != 6 || answer[0] != 3 || answer[1] != 4)
    throw std::runtime_error("a valid request was refused");
  const auto took = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begun);
  figures.slowest_us = std::max<std::int64_t>(figures.slowest_us, took.count());
  ++figures.valid;
}

// Every whole frame is answered; what is no frame ends the connection, and nothing else does.
void play(const Burst& burst, SocketClient& bad) {
  const std::uint64_t before = bad.answers();
  for (const Bytes& piece : burst.pieces) {
    if (bad.send(piece)) continue;
    if (burst.ending != Ending::Bad)
      throw std::runtime_error("the server closed a connection on which frames were right");
    break;
  }
  if (burst.ending == Ending::Bad) {
    bad.await_close();
  } else {
    bad.await_answers(burst.whole - (bad.answers() - before));
  }
  if (bad.answers() - before > burst.whole) throw std::runtime_error("more answers than requests");
  if (burst.ending != Ending::Clean) bad.connect();
}

void run(std::uint16_t port, std::uint64_t frames, std::uint32_t seed, bool after_each, Figures& figures) {
  SocketFrames source(read_seeds(STEPWRIGHT_SOURCE_DIR "/tests/fuzz/modbus/seeds.txt").tcp, seed);
  SocketClient bad(port, kPatience), good(port, kPatience);
  ask_valid(good, figures);
  std::uint64_t next = kBatch;
  while (figures.frames < frames) {
    const Burst burst = source.next();
    play(burst, bad);
    figures.frames += burst.frames;
    if (!after_each && figures.frames < next) continue;
    next = figures.frames + kBatch;
    // As many as there were frames, where each is to have one.
    for (unsigned i = 0; i < (after_each ? burst.frames : 1); ++i) ask_valid(good, figures);
  }
  std::cout << "{\"answers\": " << bad.answers() << ", \"exceptions\": " << bad.exceptions()
            << ", \"reconnections\": " << bad.reconnections();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  Figures figures;
  const auto begun = Clock::now();
  try {
    run(static_cast<std::uint16_t>(std::atoi(argv[1])), std::strtoull(argv[2], nullptr, 10),
        static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10)), argv[4] == std::string("each"),
        figures);
  } catch (const std::runtime_error& broken) {
    std::cerr << broken.what() << " after " << figures.frames << " frames and " << figures.valid
              << " valid requests\n";
    return 1;
  }
  const std::chrono::duration<double> wall = Clock::now() - begun;
  std::cout << ", \"frames\": " << figures.frames << ", \"valid\": " << figures.valid
            << ", \"slowest_valid_us\": " << figures.slowest_us << ", \"wall_s\": " << wall.count() << "}\n";
  return 0;
}
