#include "cell/campaign/printed.h"

#include <algorithm>
#include <fstream>

namespace stepwright::campaign {
namespace {

constexpr std::streamoff kMostBytes = 2'000;
constexpr int kMostLines = 8;

}  // namespace

std::string last_lines(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return {};
  const std::streamoff size = in.tellg();
  const std::streamoff take = std::min(size, kMostBytes);
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(take, 0)), '\0');
  in.seekg(size - take);
  in.read(text.data(), take);
  text.resize(static_cast<std::size_t>(in.gcount()));
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::size_t from = text.size();
  for (int line = 0; line < kMostLines && from != std::string::npos && from > 0; ++line)
    from = text.rfind('\n', from - 1);
  if (from != std::string::npos && from < text.size()) text.erase(0, text[from] == '\n' ? from + 1 : from);
  const auto is_control = [](char c) { return c != '\n' && static_cast<unsigned char>(c) < 0x20; };
  std::ranges::replace_if(text, is_control, ' ');
  return text;
}

}  // namespace stepwright::campaign
