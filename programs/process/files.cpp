#include "programs/process/files.h"

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace stepwright::process {

result::Result<std::string> read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    return result::fail("E0001", {path, 0, 0}, "cannot read the file");
  return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

result::Diagnostics write_file(const std::string& path, std::string_view bytes) {
  const std::string partial = path + ".part";
  bool written = false;
  {
    std::ofstream file(partial, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    written = static_cast<bool>(file.flush());
  }
  std::error_code failed;
  if (written) std::filesystem::rename(partial, path, failed);
  if (written && !failed) return {};
  std::remove(partial.c_str());
  return {{"E0002", result::Severity::Error, {path, 0, 0}, "cannot write the file", {}}};
}

bool is_xml(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".xml";
}

}  // namespace stepwright::process
