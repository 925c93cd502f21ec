#include "runtime/scan_test/load_generator.h"

#include <netinet/in.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>

namespace stepwright::scan_test {
namespace {

constexpr std::size_t kBlockBytes = 64u << 10;
constexpr off_t kFileBytes = 16 << 20;
constexpr std::size_t kDatagramBytes = 1'400;
constexpr timeval kReceiveTimeout{0, 100'000};

tl::unexpected<result::Diagnostics> refused(const char* what) {
  return result::fail("R0074", {}, std::string(what) + ": " + std::strerror(errno));
}

void compute(const std::atomic<bool>& quit) {
  volatile double x = 1.0;
  while (!quit.load(std::memory_order_relaxed)) {
    for (int i = 0; i < 10'000; ++i) x = x * 1.000001 + 0.5;
  }
}

void write_blocks(const std::atomic<bool>& quit, int file) {
  const std::vector<char> block(kBlockBytes, 'x');
  off_t at = 0;
  while (!quit.load(std::memory_order_relaxed)) {
    // A full disk is load enough; the measurement goes on.
    if (pwrite(file, block.data(), block.size(), at) < 0) usleep(1'000);
    fdatasync(file);
    at = (at + static_cast<off_t>(kBlockBytes)) % kFileBytes;
  }
}

void send_datagrams(const std::atomic<bool>& quit, int sender) {
  const std::array<char, kDatagramBytes> datagram{};
  while (!quit.load(std::memory_order_relaxed)) send(sender, datagram.data(), datagram.size(), 0);
}

void receive_datagrams(const std::atomic<bool>& quit, int receiver) {
  std::array<char, kDatagramBytes> datagram;
  while (!quit.load(std::memory_order_relaxed)) recv(receiver, datagram.data(), datagram.size(), 0);
}

}  // namespace

result::Result<LoadKinds> LoadKinds::parse(const std::string& list) {
  LoadKinds kinds;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "cpu") {
      kinds.cpu = true;
    } else if (word == "disk") {
      kinds.disk = true;
    } else if (word == "net") {
      kinds.net = true;
    } else {
      return result::fail("R0073", {}, "there is no load called '" + word + "'", "known: cpu, disk, net");
    }
  }
  return kinds;
}

result::Result<std::unique_ptr<LoadGenerator>> LoadGenerator::create(const LoadKinds& kinds) {
  std::unique_ptr<LoadGenerator> self(new LoadGenerator);
  if (kinds.disk) {
    if (auto started = self->start_disk(); !started) return result::forward(started);
  }
  if (kinds.net) {
    if (auto started = self->start_net(); !started) return result::forward(started);
  }
  for (unsigned i = 0; kinds.cpu && i < std::max(std::thread::hardware_concurrency(), 1u); ++i) {
    self->threads_.emplace_back([&quit = self->quit_] { compute(quit); });
  }
  return self;
}

LoadGenerator::~LoadGenerator() {
  quit_.store(true);
  for (std::thread& thread : threads_) thread.join();
  for (const int descriptor : {file_, receiver_, sender_}) {
    if (descriptor >= 0) close(descriptor);
  }
}

// The file has no name: it goes with the process.
result::Result<void> LoadGenerator::start_disk() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "stepwright-load-XXXXXX").string();
  file_ = mkstemp(name.data());
  if (file_ < 0) return refused("no file for the load of the disk");
  unlink(name.c_str());
  threads_.emplace_back([this] { write_blocks(quit_, file_); });
  return {};
}

result::Result<void> LoadGenerator::start_net() {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  receiver_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sender_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  if (receiver_ < 0 || sender_ < 0 || bind(receiver_, generic, size) != 0 ||
      getsockname(receiver_, generic, &size) != 0 || connect(sender_, generic, size) != 0) {
    return refused("no sockets for the load of the network");
  }
  setsockopt(receiver_, SOL_SOCKET, SO_RCVTIMEO, &kReceiveTimeout, sizeof kReceiveTimeout);
  threads_.emplace_back([this] { receive_datagrams(quit_, receiver_); });
  threads_.emplace_back([this] { send_datagrams(quit_, sender_); });
  return {};
}

}  // namespace stepwright::scan_test
