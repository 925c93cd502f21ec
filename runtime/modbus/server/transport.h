#pragma once

// Transport of bytes to the server and back: TCP, TLS, a serial line. A Acceptor lets clients in, a Transport
// is one of them. Server (server.h) drives all of them in one epoll loop and one thread; nothing here may
// block.
//
// A new kind needs these two classes and a line in the program that adds the Acceptor to the Server. What the
// server does itself, for every kind: framing, order of answers, limits, idle timeout, access by the peer,
// dropping who does not read.
//
//   class TlsTransport final : public Transport { ... SSL_read, SSL_write ... };
//   server.add(std::make_unique<TlsAcceptor>(...));
//
// Handshakes: read() and write() drive them and say WouldBlock until they are through; peer() is null until
// then. Whoever does not get through within the idle timeout is dropped.
// A serial line: its Acceptor's descriptor is readable (a timerfd, an eventfd) while the line is to be
// opened; admit() opens it and gives a transport with Framing::Rtu. When the line fails the transport says
// Closed, and the server destroys it; its destructor is where the acceptor learns that it may try again.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace stepwright::modbus::server {

enum class Framing : std::uint8_t {
  Tcp,  // MBAP header, answers carry transaction and unit of the request
  Rtu,  // address, CRC; one unit; broadcasts are carried out and not answered; silences of 50 ms and more are
        // noticed
};

// The peer of a connection, as far as access depends on it.
struct Peer {
  // "192.168.1.7", "fe80::1"; of a serial line its device. Limits per address and the windows of clients go
  // by it.
  std::string address;
  // From the certificate (Modbus/TCP Security, OID 1.3.6.1.4.1.50316.802.1); empty: none was shown.
  std::string role;
  // The transport vouches for the role. Windows that ask for a role never open to another peer.
  bool authenticated = false;
};

struct Moved {
  enum class State : std::uint8_t {
    Done,        // `bytes` went, at least one
    WouldBlock,  // nothing now: wait for the descriptor
    Closed,      // the end of the stream, an error, a failed handshake: nothing will come any more
  };
  State state = State::WouldBlock;
  std::size_t bytes = 0;
};

class Transport {
 public:
  virtual ~Transport() = default;

  // For epoll; the same from admit() to destruction. Owned by the transport.
  virtual int descriptor() const = 0;

  // Both move what they can without waiting. `bytes` of write() may be fewer than asked for.
  virtual Moved read(std::span<std::byte> into) = 0;
  virtual Moved write(std::span<const std::byte> from) = 0;

  // True if the next step of the transport itself (a handshake, a key update) waits until the descriptor is
  // writable, whatever the server has to send.
  virtual bool needs_writable() const { return false; }
  // True if read() has bytes in a buffer of its own, which epoll does not know of.
  virtual bool has_buffered() const { return false; }

  // Null until it is known who it is. Then the same for ever.
  virtual const Peer* peer() const = 0;
  // Where it comes from, asked once, on arrival: what the limit per address counts by. Empty: it is not
  // counted.
  virtual std::string address() const { return peer() == nullptr ? std::string() : peer()->address; }
  virtual Framing framing() const { return Framing::Tcp; }
  // Of Framing::Rtu: the slave's address on the line, 1 to 247.
  virtual std::uint8_t unit() const { return 1; }
};

class Acceptor {
 public:
  virtual ~Acceptor() = default;

  // For epoll: readable while somebody may come in. -1: not now.
  virtual int descriptor() const = 0;

  // Lets the next one in; null if nobody is there (any more), or if so many were turned away that others come
  // first: the descriptor stays readable then. Called until it gives null. Whoever may not come in at all
  // (allow-list) is turned away here. The transport must not outlive the acceptor.
  virtual std::unique_ptr<Transport> admit() = 0;

  // At the limit of connections: whoever is there is turned away, so that the descriptor stops being
  // readable.
  virtual void turn_away() = 0;

  // How many it has turned away itself since the last call: not allowed in, or no descriptor left.
  virtual std::uint64_t take_refused() { return 0; }

  // For logs: "tcp 127.0.0.1:502", "tls [::]:802", "rtu /dev/ttyUSB0 19200 8E1".
  virtual std::string name() const = 0;
};

}  // namespace stepwright::modbus::server
