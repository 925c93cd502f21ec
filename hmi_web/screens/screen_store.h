#pragma once

// The screens of a cell, in one folder: NAME/000007.svg and .json for each version, and NAME.svg where
// somebody has put a drawing there, which is version 0.
//
//   auto store = ScreenStore::open("cell-state/screens");
//   auto saved = (*store)->save({.name = "Mixer", .svg = text, .based_on = 3, .user = "ada"}, now);
//   if (saved && saved->aside) offer_both(saved->number, (*store)->find("Mixer")->current()->number);
//
// Threads: every function from any. Invariants: what is saved has been read as a drawing, and is on the disk
// when save returns; a version is never changed; of two people who began with the same version the second
// one's is kept aside and not shown.
//
// Diagnostics: H0021 the disk, H0120 no such screen or version, H0121 a name that is none, H0123 too many,
// H0124 damaged; C0640 to C0644 what is wrong in a drawing, with its place.

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/drawing/drawing_file.h"
#include "hmi_web/screens/screen.h"
#include "runtime/ground/result/result.h"

namespace stepwright::screens {

// Letters, digits, blanks and ". _ -" of ASCII, the first and the last a letter or a digit: it is the name of
// a folder, too. None ends in .svg, as files do.
[[nodiscard]] result::Result<void> check_name(std::string_view name);

struct Save {
  std::string name = {};
  std::string_view svg = {};
  std::uint32_t based_on = 0;  // the version that was changed; 0: there was none, or the file
  std::string user = {};
  std::string comment = {};
};

class ScreenStore {
 public:
  using Time = std::chrono::system_clock::time_point;

  // Makes the folder if it is not there. What cannot be believed is left out, and told by `damaged`.
  [[nodiscard]] static result::Result<std::unique_ptr<ScreenStore>> open(std::filesystem::path folder);

  // By name, removed ones too.
  std::vector<Screen> list() const;
  std::optional<Screen> find(const std::string& name) const;
  const result::Diagnostics& damaged() const { return damaged_; }

  // The drawing of a version, as it was saved.
  [[nodiscard]] result::Result<drawing::Drawing> read(const std::string& name, std::uint32_t version) const;
  // The version that has been made: aside if the newest is another one than it is based on.
  [[nodiscard]] result::Result<Version> save(const Save& save, Time now);
  // Its versions stay, and each can be saved anew.
  [[nodiscard]] result::Result<Version> remove(const std::string& name, std::uint32_t based_on,
                                               const std::string& user, Time now);

  // The screen that a page of the role opens with (one of kStartRoles; "": of everybody who has none of his
  // own); empty: none was chosen.
  std::string start(const std::string& role = {}) const;
  // An empty name: none any more. Fails with H0120 for a screen that is not there, and for another role.
  [[nodiscard]] result::Result<void> set_start(const std::string& name, const std::string& role = {});

 private:
  explicit ScreenStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
  void look();
  void look_at_starts();
  void move_start(const std::string& role);
  void look_at_file(const std::filesystem::path& file);
  void look_at_folder(const std::filesystem::path& folder);
  std::filesystem::path file_of(const std::string& name, std::uint32_t version, const char* ending) const;
  // The version to be written next, on `based_on`.
  result::Result<Version> next(const std::string& name, std::uint32_t based_on) const;
  result::Result<Version> write(const std::string& name, const Version& version, std::string_view svg);
  void forget_oldest(Screen& screen);

  const std::filesystem::path folder_;
  result::Diagnostics damaged_;
  mutable std::mutex mutex_;
  std::map<std::string, Screen> screens_;
  std::map<std::string, std::string> starts_;  // by role
};

}  // namespace stepwright::screens
