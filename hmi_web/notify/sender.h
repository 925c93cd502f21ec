#pragma once

// Hands a message to a mail server or a web hook.
//
// Threads: every function from any; send() waits for the other side, at most kLongest, and ends when `stop`
// is asked for. Diagnostics: H0085, with what the other side or the network said.

#include <chrono>
#include <stop_token>

#include "hmi_web/notify/channel.h"
#include "runtime/ground/result/result.h"

namespace stepwright::notify {

class Sender {
 public:
  virtual ~Sender() = default;
  [[nodiscard]] virtual result::Result<void> send(const Channel& channel, const Message& message,
                                                  const std::stop_token& stop) = 0;
};

}  // namespace stepwright::notify
