#pragma once

// The state of a runtime as the page reads it. Pure; any thread.
//
//   report.state = word_for(status.state);

#include "runtime/host/messages.h"

namespace stepwright::hmi {

inline const char* word_for(host::RuntimeState state) {
  switch (state) {
    case host::RuntimeState::Empty:
      return "empty";
    case host::RuntimeState::Stopped:
      return "stopped";
    case host::RuntimeState::Running:
      return "running";
    case host::RuntimeState::Fault:
      return "fault";
  }
  return "";
}

}  // namespace stepwright::hmi
