#include "programs/new/new_command.h"

#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <span>

#include "programs/new/template_texts.h"
#include "runtime/ground/process/files.h"

namespace stepwright::new_cell {
namespace {

constexpr std::size_t kLongestName = 48;  // leaves room for "-device"

std::span<const TemplateText> texts_of(const std::string& plant) {
  if (plant == "tanks") return tanks_texts();
  if (plant == "conveyor") return conveyor_texts();
  return plant == "modbus" ? modbus_texts() : none_texts();
}

std::string filled_in(std::string_view text, const std::string& name) {
  constexpr std::string_view kName = "{{name}}";
  std::string made(text);
  for (std::size_t at = made.find(kName); at != std::string::npos; at = made.find(kName, at + name.size()))
    made.replace(at, kName.size(), name);
  return made;
}

bool is_name(const std::string& name) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  return !name.empty() && name.size() <= kLongestName && name.front() != '.' && name.front() != '-' &&
         std::ranges::all_of(name, fits);
}

// Without the '/' at its end.
std::filesystem::path folder_of(const NewOptions& options) {
  const std::filesystem::path folder = std::filesystem::path(options.folder).lexically_normal();
  return folder.has_filename() ? folder : folder.parent_path();
}

result::Result<void> check_free(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(folder, error))) return {};
  const bool empty = std::filesystem::is_directory(folder, error) && std::filesystem::is_empty(folder, error);
  if (empty && !error) return {};
  return result::fail("M0019", {folder.string(), 0, 0}, "this is there already, and is no empty folder",
                      "nothing was written; choose another name");
}

result::Result<void> write_all(const std::filesystem::path& folder, const NewOptions& options,
                               const std::string& name) {
  for (const TemplateText& each : texts_of(options.plant)) {
    auto unwritten = process::write_file((folder / each.name).string(), filled_in(each.text, name));
    if (!unwritten.empty()) return tl::unexpected(std::move(unwritten));
  }
  return {};
}

}  // namespace

result::Result<void> make_cell(const NewOptions& options) {
  const std::filesystem::path folder = folder_of(options);
  const std::string name = folder.filename().string();
  if (!is_name(name))
    return result::fail("M0018", {}, "'" + name + "' cannot name a cell",
                        "up to 48 letters, digits, '_', '-' and '.', the first a letter or digit");
  if (auto free = check_free(folder); !free) return free;
  // Written beside its place and moved there as a whole.
  std::string made = (folder.parent_path() / ("." + name + "-XXXXXX")).string();
  if (mkdtemp(made.data()) == nullptr)
    return result::fail("E0002", {folder.string(), 0, 0},
                        std::string("cannot be made: ") + std::strerror(errno));
  std::error_code error;
  auto done = write_all(made, options, name);
  if (done) {
    constexpr auto kUsual = std::filesystem::perms(0755);
    std::filesystem::permissions(made, kUsual, error);
    std::filesystem::rename(made, folder, error);
  }
  if (done && !error) return {};
  std::error_code ignored;
  std::filesystem::remove_all(made, ignored);
  if (!done) return done;
  return result::fail("E0002", {folder.string(), 0, 0}, "cannot be made: " + error.message());
}

}  // namespace stepwright::new_cell
