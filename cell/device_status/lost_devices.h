#pragma once

// Lost devices of a cell, with the reasons, from what its Modbus client says over its status socket.
//
// Thread-safe: pure but for the question, which waits for an answer (a second for each piece of it).

#include <filesystem>
#include <string>
#include <string_view>

namespace stepwright::device_status {

// One sentence for a log, bounded: "device 'press' (10.0.0.2:502): no route to host". Of a status that is not
// understood, or in which no device is lost, it says that.
std::string describe_lost(std::string_view status_json);

// The same of the client that runs; or that none does.
std::string ask_lost(const std::filesystem::path& status_socket);

}  // namespace stepwright::device_status
