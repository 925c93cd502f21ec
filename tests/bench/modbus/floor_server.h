#pragma once

// Baseline of all Modbus servers: one that knows the answer before it reads, so that what the system costs is
// left. One thread, epoll, one recv and one send for a request, which it neither checks nor looks up: only
// the transaction is copied. No server that asks the kernel twice for a request can be faster.

namespace stepwright::bench {

// Answers every request as a read of ten registers.
[[noreturn]] void serve_a_constant(int listener);

}  // namespace stepwright::bench
