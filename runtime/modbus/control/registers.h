#pragma once

// The registers by which a controller is commanded and observed over Modbus alone
// (runtime/doc/modbus_controller.md). The firmware serves them, the gateway is their master. Both sides take
// every number from here.
//
// Multi-register numbers: the most significant register first. Byte strings (digests, images, containers):
// two bytes a register, the first byte in the high half; of an odd count the last low half is 0.
// Portable: plain constants and conversions, no state, any thread.
//
//   std::array<std::uint16_t, status::kCount> words;         // read with FC 3 from status::kFirst
//   const std::uint64_t scan = get64(words, status::kScan);

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::modbus::control {

inline constexpr std::uint16_t kMagic = 0x5357;  // "SW"
inline constexpr std::uint16_t kVersion = 2;
inline constexpr std::uint16_t kMaxRead = 125;         // registers of one FC 3 (and of FC 23's read half)
inline constexpr std::uint16_t kMaxWrite = 123;        // of one FC 16
inline constexpr std::uint16_t kMaxWriteInRw = 121;    // of FC 23's write half
inline constexpr std::uint16_t kDigestRegisters = 16;  // a SHA-256

// Status of the controller. Offsets are from kFirst.
namespace status {
inline constexpr std::uint16_t kFirst = 0xF000;
inline constexpr std::uint16_t kMagicAt = 0;
inline constexpr std::uint16_t kVersionAt = 1;
inline constexpr std::uint16_t kState = 2;           // State
inline constexpr std::uint16_t kFlags = 3;           // Flag
inline constexpr std::uint16_t kScan = 4;            // 64 bits: scans so far, over program changes
inline constexpr std::uint16_t kTimeNs = 8;          // 64 bits: scan clock of the newest scan
inline constexpr std::uint16_t kTraceHash = 12;      // 64 bits: over every scan so far
inline constexpr std::uint16_t kImageHash = 16;      // 64 bits: of the image after the newest scan
inline constexpr std::uint16_t kDigest = 20;         // 16 registers: of the loaded container; 0 without one
inline constexpr std::uint16_t kTrapCode = 36;       // bytecode::TrapCode of the newest trap; 0 = none
inline constexpr std::uint16_t kTrapFunction = 37;   // 32 bits
inline constexpr std::uint16_t kTrapPc = 39;         // 32 bits
inline constexpr std::uint16_t kTrapCaller = 41;     // 32 bits
inline constexpr std::uint16_t kTrapReturnPc = 43;   // 32 bits
inline constexpr std::uint16_t kCommandNumber = 45;  // of the newest command that was carried out or refused
inline constexpr std::uint16_t kCommandResult = 46;  // Refusal
inline constexpr std::uint16_t kCommandDetail = 47;  // 32 bits: see Refusal
inline constexpr std::uint16_t kEvent = 49;          // 32 bits: the number of the newest event, 0 = none yet
inline constexpr std::uint16_t kEventKind = 51;      // Event
inline constexpr std::uint16_t kEventScan = 52;      // 64 bits: the scan after which it happened
inline constexpr std::uint16_t kImageBytes = 56;     // 32 bits: of the loaded program
inline constexpr std::uint16_t kInputBytes = 58;
inline constexpr std::uint16_t kOutputBytes = 59;
inline constexpr std::uint16_t kProgramBytes = 60;   // 32 bits: of the loaded container
inline constexpr std::uint16_t kTransferBytes = 62;  // 32 bits: that arrived of the transfer under way
inline constexpr std::uint16_t kMaxProgramBytes =
    64;  // 32 bits: the largest container that this controller takes
inline constexpr std::uint16_t kMaxImageBytes = 66;  // 32 bits: image and frames
inline constexpr std::uint16_t kSlot = 68;           // 0 = A, 1 = B: where the loaded program stands in flash
inline constexpr std::uint16_t kScanUs = 69;         // 32 bits: how long the newest scan took
inline constexpr std::uint16_t kScanMaxUs = 71;      // 32 bits
inline constexpr std::uint16_t kOverruns = 73;       // 32 bits: scans that began a period late or more
inline constexpr std::uint16_t kResets = 75;         // by the watchdog since power-on
inline constexpr std::uint16_t kUptimeMs = 76;       // 32 bits
inline constexpr std::uint16_t kCount = 78;
}  // namespace status

// Numbers are those of host::RuntimeState.
enum class State : std::uint16_t { Empty = 0, Stopped = 1, Running = 2, Fault = 3 };

// Numbers are those of host::EventKind.
enum class Event : std::uint16_t { Started = 0, StepChange = 1, Stopped = 2, Trap = 3 };

enum Flag : std::uint16_t {
  kLockStep = 1u << 0,        // scans run by turns, not by the clock
  kTransferring = 1u << 1,    // a transfer is under way
  kInputsLost = 1u << 2,      // the fault is the master's silence
  kWatchdogReset = 1u << 3,   // the last start was the watchdog's
  kRetainRestored = 1u << 4,  // the program began with retained values
};

// One command: written whole, with FC 16 from kFirst. It is carried out between two scans; then the status
// shows its number. A number that equals the newest one is a repetition: nothing happens, the answer stands.
namespace command {
inline constexpr std::uint16_t kFirst = 0xF080;
inline constexpr std::uint16_t kNumber = 0;  // 1 to 65535; the master counts and leaves 0 out
inline constexpr std::uint16_t kCode = 1;    // Command
inline constexpr std::uint16_t kArguments = 2;
inline constexpr std::uint16_t kMaxCount = 24;
}  // namespace command

enum class Command : std::uint16_t {
  Nothing = 0,         // for a heartbeat
  Start = 1,           // argument 0: StartFlag bits
  Stop = 2,            //
  TransferBegin = 3,   // arguments 0-1: bytes; 2-17: SHA-256
  TransferCommit = 4,  // checks the digest, verifies, writes the free slot, loads; stops what runs
  TransferAbort = 5,   //
  WriteBits = 6,       // bits::; of another program than the loaded one it is refused
  Force = 7,           // the same, with its end
  Unforce = 8,         // the same; value ignored
  ClearRetained = 9,   // forgets what is retained; only while nothing runs
};

// Arguments of the commands that name memory. An address is another variable in the next program.
namespace bits {
inline constexpr std::uint16_t kByte = 0;     // 32 bits: byte of the image
inline constexpr std::uint16_t kMask = 2;     // 64 bits, little-endian from there
inline constexpr std::uint16_t kValue = 6;    // 64 bits
inline constexpr std::uint16_t kDigest = 10;  // the first 4 registers of the program's SHA-256
inline constexpr std::uint16_t kMs = 14;      // 64 bits: after so long a force ends by itself; 0: never
inline constexpr std::uint16_t kCount = 18;
inline constexpr std::uint16_t kDigestBytes = 8;
}  // namespace bits

enum StartFlag : std::uint16_t {
  kStartLockStep = 1u << 0,
  kStartCold = 1u << 1,  // retained variables have their initial values too
};

// Why a command was refused. Done is 0.
enum class Refusal : std::uint16_t {
  Done = 0,
  UnknownCommand = 1,
  NoProgram = 2,
  AlreadyRunning = 3,
  OutOfBounds = 4,  // bits beyond the image, or a mask of 0
  ForcesFull = 5,
  NotForced = 6,
  TooLarge = 7,    // detail: the limit in bytes
  Incomplete = 8,  // commit before all bytes arrived; detail: how many are missing
  WrongDigest = 9,
  NotVerified = 10,  // detail: bytecode::VerifyError
  FlashFailed = 11,
  NotStopped = 12,  // only while nothing runs
  BadArguments = 13,
  NotSupported = 14,  // the program uses what this controller lacks; detail: which limit
  OtherProgram = 15,  // bits of a program that is not the loaded one
};

// The container in pieces, in order, with FC 16 from kFirst: the offset of its first byte, how many bytes,
// and these. A piece that lies wholly before what arrived is a repetition and is ignored; one that leaves a
// gap gets exception 3.
namespace transfer {
inline constexpr std::uint16_t kFirst = 0xF100;
inline constexpr std::uint16_t kOffset = 0;  // 32 bits
inline constexpr std::uint16_t kBytes = 2;
inline constexpr std::uint16_t kData = 3;
inline constexpr std::uint16_t kMaxBytes = (kMaxWrite - kData) * 2;  // 240
}  // namespace transfer

// Memory that is read in windows: what and from which byte is written to kFirst, then the window is read.
// With FC 23 both are one request. All registers of one answer are of one instant between two scans.
namespace select {
inline constexpr std::uint16_t kFirst = 0xF180;
inline constexpr std::uint16_t kWhat = 0;    // Memory
inline constexpr std::uint16_t kOffset = 1;  // 32 bits, in bytes
inline constexpr std::uint16_t kCount = 3;
}  // namespace select

enum class Memory : std::uint16_t {
  Image = 0,       // as it is now
  EventImage = 1,  // as it was after the newest event; stays until the next one
  Program = 2,     // the loaded container
};

// Bytes beyond the end of the memory read as 0. The first registers say what the bytes are of.
namespace window {
inline constexpr std::uint16_t kFirst = 0xF190;
inline constexpr std::uint16_t kScan =
    0;  // 64 bits: of Image the newest scan, of EventImage that of the event
inline constexpr std::uint16_t kEvent = 4;  // 32 bits: the newest event
inline constexpr std::uint16_t kData = 6;
inline constexpr std::uint16_t kMaxBytes = 200;
inline constexpr std::uint16_t kCount = kData + kMaxBytes / 2;
}  // namespace window

// The plant's side of the I/O. Inputs are written from kFirst, with the turn first. In lock-step a new turn
// lets exactly one scan run before the request is answered; by the clock it counts as a sign of life only,
// and the next scan takes the inputs.
namespace inputs {
inline constexpr std::uint16_t kFirst = 0xF200;
inline constexpr std::uint16_t kTurn =
    0;  // 1 to 65535, then 1 again; the newest turn once more is a repetition
inline constexpr std::uint16_t kData = 1;
inline constexpr std::uint16_t kMaxBytes = (kMaxWriteInRw - kData) * 2;  // 240
}  // namespace inputs

// With FC 23 (write inputs, read outputs) a whole exchange is one request: the write comes first, and the
// outputs are those of the scan that it let run.
namespace outputs {
inline constexpr std::uint16_t kFirst = 0xF280;
inline constexpr std::uint16_t kTurn = 0;        // the newest turn
inline constexpr std::uint16_t kState = 1;       // State
inline constexpr std::uint16_t kScan = 2;        // 64 bits
inline constexpr std::uint16_t kTimeNs = 6;      // 64 bits
inline constexpr std::uint16_t kTraceHash = 10;  // 64 bits
inline constexpr std::uint16_t kEvent = 14;      // 32 bits: the newest event
inline constexpr std::uint16_t kNextNs = 16;     // 64 bits: scan clock at which the next scan is due
inline constexpr std::uint16_t kData = 20;
inline constexpr std::uint16_t kMaxBytes = (kMaxRead - kData) * 2;  // 210
}  // namespace outputs

// All of them: a request that touches any other register from here to kEnd gets exception 2.
inline constexpr std::uint16_t kBegin = status::kFirst;
inline constexpr std::uint16_t kEnd = 0xF300;

// Requires `at` and as many registers as the number has within `words`.
constexpr std::uint32_t get32(std::span<const std::uint16_t> words, std::size_t at) {
  return std::uint32_t{words[at]} << 16 | words[at + 1];
}
constexpr std::uint64_t get64(std::span<const std::uint16_t> words, std::size_t at) {
  return std::uint64_t{get32(words, at)} << 32 | get32(words, at + 2);
}
constexpr void put32(std::span<std::uint16_t> words, std::size_t at, std::uint32_t value) {
  words[at] = static_cast<std::uint16_t>(value >> 16);
  words[at + 1] = static_cast<std::uint16_t>(value & 0xFFFF);
}
constexpr void put64(std::span<std::uint16_t> words, std::size_t at, std::uint64_t value) {
  put32(words, at, static_cast<std::uint32_t>(value >> 32));
  put32(words, at + 2, static_cast<std::uint32_t>(value & 0xFFFF'FFFF));
}

// Byte strings. `words` needs (bytes + 1) / 2 registers.
constexpr void put_bytes(std::span<std::uint16_t> words, std::span<const std::byte> bytes) {
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const auto high = static_cast<std::uint16_t>(bytes[i]);
    const auto low = i + 1 < bytes.size() ? static_cast<std::uint16_t>(bytes[i + 1]) : std::uint16_t{0};
    words[i / 2] = static_cast<std::uint16_t>(high << 8 | low);
  }
}
constexpr void get_bytes(std::span<const std::uint16_t> words, std::span<std::byte> bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::uint16_t word = words[i / 2];
    bytes[i] = static_cast<std::byte>(i % 2 == 0 ? word >> 8 : word & 0xFF);
  }
}

}  // namespace stepwright::modbus::control
