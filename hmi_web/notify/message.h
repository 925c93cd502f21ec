#pragma once

// Message about alarms, in words for a mail and as JSON for a web hook.
//
// Pure; any thread.

#include <chrono>
#include <string>
#include <vector>

#include "hmi_web/notify/channel.h"

namespace stepwright::notify {

// `alarms` is not empty, the most urgent first. `repeat`: of the channel; 0: it is told once.
Message message_of(const std::string& cell, std::vector<StandingAlarm> alarms, std::chrono::seconds repeat);
// To see whether it arrives.
Message test_message(const std::string& cell, const Channel& channel, const std::string& user);
// As a mail server takes it (RFC 5322): headers without line breaks in them, lines that end with CR LF.
// `date` and `id` are the headers of that name.
std::string mail_of(const Channel& channel, const Message& message, const std::string& date,
                    const std::string& id);

}  // namespace stepwright::notify
