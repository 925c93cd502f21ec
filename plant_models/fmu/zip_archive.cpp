#include "plant_models/fmu/zip_archive.h"

#include <minizip/unzip.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <utility>

namespace stepwright::fmu {

bool is_safe_name(std::string_view name) {
  if (name.empty() || name.front() == '/') return false;
  const bool plain = std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x20 || c == 0x7F || c == '\\' || c == ':';
  });
  if (!plain) return false;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('/'), name.size());
    const std::string_view part = name.substr(0, end);
    if (part.empty() || part == "." || part == "..") return false;
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return true;
}

namespace {

// As systems in the manner of Unix mark it (APPNOTE.TXT, 4.4.2 and 4.4.15).
bool is_link(const unz_file_info64& info) {
  constexpr uLong kUnix = 3, kFileType = 0170000, kLink = 0120000;
  return info.version >> 8 == kUnix && (info.external_fa >> 16 & kFileType) == kLink;
}

}  // namespace

ZipArchive::ZipArchive(ZipArchive&& other) noexcept
    : file_(std::move(other.file_)),
      limits_(other.limits_),
      handle_(std::exchange(other.handle_, nullptr)),
      names_(std::move(other.names_)),
      places_(std::move(other.places_)) {}

ZipArchive& ZipArchive::operator=(ZipArchive&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(limits_, other.limits_);
  std::swap(handle_, other.handle_);
  std::swap(names_, other.names_);
  std::swap(places_, other.places_);
  return *this;
}

ZipArchive::~ZipArchive() {
  if (handle_ != nullptr) unzClose(handle_);
}

tl::unexpected<result::Diagnostics> ZipArchive::refuse(const std::string& why,
                                                       const std::string& hint) const {
  return result::fail("C0330", {file_.string(), 0, 0}, why, hint);
}

result::Result<ZipArchive> ZipArchive::open(const std::filesystem::path& file, const UnpackLimits& limits) {
  ZipArchive archive(file);
  archive.limits_ = limits;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return archive.refuse("there is no such file");
  archive.handle_ = unzOpen64(file.c_str());
  if (archive.handle_ == nullptr) {
    return archive.refuse("this is no ZIP archive", "an FMU is a file .fmu as a tool has exported it");
  }
  if (auto listed = archive.list(); !listed) return result::forward(listed);
  return archive;
}

result::Result<void> ZipArchive::list() {
  std::set<std::string> known;
  for (int at = unzGoToFirstFile(handle_); at != UNZ_END_OF_LIST_OF_FILE; at = unzGoToNextFile(handle_)) {
    std::array<char, 1024> name{};
    unz_file_info64 info{};
    if (at != UNZ_OK || unzGetCurrentFileInfo64(handle_, &info, name.data(), name.size() - 1, nullptr, 0,
                                                nullptr, 0) != UNZ_OK) {
      return refuse("its list of files is damaged", "is the file complete?");
    }
    if (info.size_filename > limits_.name_bytes) return refuse("a name in it is too long");
    std::string text(name.data());
    if (text.size() != info.size_filename || !is_safe_name(text)) {
      return refuse("it has a file '" + text.substr(0, 80) + "', which would lead out of its folder",
                    "such an archive is not unpacked");
    }
    if (is_link(info))
      return refuse("'" + text + "' in it is a symbolic link",
                    "links are not unpacked: put in the file itself");
    if (!known.insert(text).second) return refuse("it has '" + text + "' twice");
    if (known.size() > limits_.files)
      return refuse("it has more than " + std::to_string(limits_.files) + " files");
    unz64_file_pos place{};
    if (unzGetFilePos64(handle_, &place) != UNZ_OK) return refuse("its list of files is damaged");
    names_.push_back(std::move(text));
    places_.push_back({place.pos_in_zip_directory, place.num_of_file});
  }
  return {};
}

bool ZipArchive::has(std::string_view name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

template <typename Sink>
result::Result<std::uint64_t> ZipArchive::pass(std::size_t file, std::uint64_t most_bytes, Sink sink) {
  const std::string& name = names_[file];
  const unz64_file_pos place{places_[file].in_list, places_[file].number};
  if (unzGoToFilePos64(handle_, &place) != UNZ_OK) return refuse("its list of files is damaged");
  if (unzOpenCurrentFile(handle_) != UNZ_OK)
    return refuse("'" + name + "' cannot be unpacked",
                  "encrypted files and methods but deflate are not read");
  std::uint64_t total = 0;
  std::vector<char> piece(64 * 1024);
  for (;;) {
    const int got = unzReadCurrentFile(handle_, piece.data(), static_cast<unsigned>(piece.size()));
    if (got == 0) break;
    if (got > 0) total += static_cast<std::uint64_t>(got);
    if (got < 0 || total > most_bytes || !sink(piece.data(), got)) {
      unzCloseCurrentFile(handle_);
      if (got < 0) return refuse("'" + name + "' is damaged", "is the file complete?");
      if (total > most_bytes)
        return refuse("'" + name + "' has more than " + std::to_string(most_bytes) + " bytes");
      return refuse("'" + name + "' cannot be written: " + std::strerror(errno));
    }
  }
  if (unzCloseCurrentFile(handle_) != UNZ_OK) return refuse("'" + name + "' is damaged: its CRC is wrong");
  return total;
}

result::Result<std::string> ZipArchive::read(const std::string& name, std::uint64_t most_bytes) {
  const auto file = std::find(names_.begin(), names_.end(), name);
  if (file == names_.end()) return refuse("it has no '" + name + "'");
  std::string text;
  auto done = pass(static_cast<std::size_t>(file - names_.begin()), most_bytes,
                   [&text](const char* bytes, int count) {
                     text.append(bytes, static_cast<std::size_t>(count));
                     return true;
                   });
  if (!done) return result::forward(done);
  return text;
}

result::Result<void> ZipArchive::unpack(const std::filesystem::path& folder) {
  std::uint64_t left = limits_.bytes;
  for (std::size_t file = 0; file < names_.size(); ++file) {
    const std::string& name = names_[file];
    const std::filesystem::path target = folder / name;
    std::error_code error;
    std::filesystem::create_directories(name.back() == '/' ? target : target.parent_path(), error);
    if (error) return refuse("'" + target.string() + "' cannot be made: " + error.message());
    if (name.back() == '/') continue;
    std::ofstream out(target, std::ios::binary | std::ios::trunc);
    if (!out) return refuse("'" + target.string() + "' cannot be written: " + std::strerror(errno));
    auto done = pass(file, std::min(left, limits_.file_bytes), [&out](const char* bytes, int count) {
      return static_cast<bool>(out.write(bytes, count));
    });
    if (!done) return result::forward(done);
    if (!out.flush()) return refuse("'" + target.string() + "' cannot be written: " + std::strerror(errno));
    left -= *done;
  }
  return {};
}

}  // namespace stepwright::fmu
