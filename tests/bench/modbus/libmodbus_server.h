#pragma once

// The baseline: libmodbus's own way to serve many clients (its example bandwidth-server-many-up.c: one
// thread, select, modbus_receive, modbus_reply), with the map of OpenPLC's size, TCP_NODELAY on every
// connection and no debug output.

namespace stepwright::bench {

[[noreturn]] void serve_with_libmodbus(int listener);

}  // namespace stepwright::bench
