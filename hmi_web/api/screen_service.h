#pragma once

// Service for screens: engineers draw and save them, everybody looks at those of his role, and operators
// write with the parts that stand in them: the variable, the range and the values come from the saved
// drawing, never from the request.
//
//   ScreenService service(store, cell, std::chrono::system_clock::now);
//   service.write({.screen = "Mixer", .part = "level", .value = "20", .once = "3f...", .role =
//   Role::Operator});
//
// Threads: every function from any; write blocks as CellControl does. Invariant: a request whose `once` has
// been here is answered again as it was, and nothing is written a second time.
//
// Diagnostics: those of screen_store.h and CellControl; H0125 no such part, H0126 the part does not write
// that value, H0127 it asks for a confirmation, H0128 it takes another role, H0129 it has
// been changed since it was shown.

#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_web/access/audit_log.h"
#include "hmi_web/access/role.h"
#include "hmi_web/api/cell_control.h"
#include "hmi_web/screens/screen_store.h"
#include "runtime/ground/result/result.h"

namespace stepwright::api {

inline constexpr const char* kNoSuchPart = "H0125";
inline constexpr const char* kNotOfPart = "H0126";
inline constexpr const char* kNotConfirmed = "H0127";
inline constexpr const char* kPartOfOtherRole = "H0128";
inline constexpr const char* kPartChanged = "H0129";

// What somebody does with a part.
struct PartWrite {
  std::string screen = {};
  std::string part = {};
  std::string value = {};  // "start" or "stop" of a pair; ignored of a button
  std::string once = {};   // names the deed; the same deed is done once
  bool confirmed = false;
  access::Role role = access::Role::None;
  // What the page has shown: the variable, and the question. Nothing: whatever they are.
  std::optional<std::string> writes = {};
  std::optional<std::string> question = {};
};

struct PartWritten {
  std::string variable = {};
  std::string before = {};
  std::string after = {};
};

class ScreenService {
 public:
  // References must outlive it.
  ScreenService(screens::ScreenStore& store, CellControl& cell, access::WallClock clock)
      : store_(store), cell_(cell), clock_(std::move(clock)) {}

  screens::ScreenStore& store() { return store_; }
  access::WallClock::result_type now() const { return clock_(); }

  // Those that the role may see, and of engineers also removed ones.
  std::vector<screens::Screen> list(access::Role role) const;
  // Nothing: there is none, or it is not for this role.
  std::optional<screens::Screen> find(const std::string& name, access::Role role) const;

  // The screen that a page of the role opens with: its own, else that of everybody, of those that it may see.
  // Empty: the first of all.
  std::string start_of(access::Role role) const;

  // What whoever saves the drawing ought to know, as warnings with its lines: what is not drawn as it stands
  // there, and parts that the program that runs now takes nothing from. Nothing of what cannot be read.
  result::Diagnostics doubts_of(const std::string& name, std::string_view svg) const;

  [[nodiscard]] result::Result<PartWritten> write(const PartWrite& deed);

 private:
  result::Result<PartWritten> obey(const PartWrite& deed, bool& tried);

  screens::ScreenStore& store_;
  CellControl& cell_;
  const access::WallClock clock_;
  std::mutex mutex_;
  std::deque<std::pair<std::string, result::Result<PartWritten>>> done_;  // the newest deeds
};

}  // namespace stepwright::api
