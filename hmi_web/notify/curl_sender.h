#pragma once

// SMTP and HTTP by libcurl, the only place that knows its API. TLS certificates are checked against those of
// the machine; nothing is followed to another address.
//
// Threads: as Sender.

#include "hmi_web/notify/sender.h"

namespace stepwright::notify {

class CurlSender : public Sender {
 public:
  static constexpr std::chrono::seconds kLongestConnect{10};
  static constexpr std::chrono::seconds kLongest{30};

  CurlSender();
  ~CurlSender() override;
  CurlSender(const CurlSender&) = delete;
  CurlSender& operator=(const CurlSender&) = delete;

  [[nodiscard]] result::Result<void> send(const Channel& channel, const Message& message,
                                          const std::stop_token& stop) override;
};

}  // namespace stepwright::notify
