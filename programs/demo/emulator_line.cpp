#include "programs/demo/emulator_line.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

namespace stepwright::demo {
namespace {

std::string content(const std::filesystem::path& file, std::size_t from) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str().size() < from ? std::string() : text.str().substr(from);
}

}  // namespace

result::Result<EmulatorLine> EmulatorLine::open(process::ChildProcess& emulator,
                                                const std::filesystem::path& log, std::size_t from,
                                                const std::filesystem::path& link,
                                                std::chrono::milliseconds timeout) {
  const std::regex terminal("(/dev/pts/[0-9]+)\\s");
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (true) {
    const std::string said = content(log, from);
    std::smatch found;
    if (std::regex_search(said, found, terminal)) {
      const std::string device = found[1];
      const int descriptor = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
      termios settings{};
      if (descriptor < 0 || tcgetattr(descriptor, &settings) != 0)
        return result::fail("M0008", {device, 0, 0}, "the emulator's line cannot be opened");
      cfmakeraw(&settings);
      tcsetattr(descriptor, TCSANOW, &settings);
      std::error_code error;
      std::filesystem::remove(link, error);
      std::filesystem::create_symlink(device, link, error);
      if (error) return result::fail("M0008", {link.string(), 0, 0}, error.message());
      return EmulatorLine(descriptor);
    }
    if (emulator.poll() || std::chrono::steady_clock::now() > deadline)
      return result::fail("M0008", {log.string(), 0, 0}, "the emulator has no line: " + said);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

EmulatorLine::~EmulatorLine() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace stepwright::demo
