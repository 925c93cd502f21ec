#include "hmi_web/server/http_server.h"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hmi_web/server/api_lanes.h"
#include "hmi_web/server/internal/response.h"
#include "hmi_web/server/internal/viewer_session.h"
#include "hmi_web/server/internal/wire.h"
#include "hmi_web/server/pending_connections.h"
#include "runtime/ground/result/last_barrier.h"

namespace stepwright::server {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using internal::HttpRequest;
using internal::ViewerSession;

struct HttpServer::State {
  State(const Feed* source, const ServerLimits& bounds) : feed(source), limits(bounds) {}

  void accept();
  void end_connection() { --connections; }
  // Whether there is room for one more page of this session or address.
  bool takes_viewer(const std::string& owner);
  void add_viewer(internal::Wire wire, HttpRequest request, const api::Caller& who, std::string owner);
  void pump_viewers();
  void shut_down();

  const Feed* feed;  // null: there are no viewers
  ServerLimits limits;
  std::optional<RequestPolicy> policy;
  std::size_t connections = 0;
  PendingConnections pending;  // before the context: connections that end with it are removed from here
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer accept_retry{io};
  struct Viewer {
    std::weak_ptr<ViewerSession> session;
    std::string owner;
  };
  std::vector<Viewer> viewers;
  std::function<std::string()> metrics;
  std::string metrics_type;
  std::function<void(const std::string&)> on_trouble;
  internal::TlsContextPointer tls;
  const api::RequestGuard* guard = nullptr;  // null: there is no API
  std::size_t most_body = 0;                 // of any of its routes
  std::unique_ptr<ApiLanes> lanes;           // last: its jobs use all of the above
};

namespace {

using internal::add_common_fields;
using internal::fill_with_answer;
using internal::fill_with_asset;
using internal::fill_with_error;
using internal::fill_with_metrics;
using internal::Response;
using internal::view;

// The part behind "csrf." of the subprotocol that a page offers for its WebSocket.
std::string_view offered_csrf(std::string_view protocols) {
  return protocols.starts_with(api::kCsrfProtocol) ? protocols.substr(api::kCsrfProtocol.size())
                                                   : std::string_view();
}

// One HTTP connection until it ends or becomes a WebSocket. shared_ptr: each pending operation holds it.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, HttpServer::State& server)
      : peer_(peer_of(socket)),
        wire_(std::in_place, internal::make_wire(std::move(socket), server.tls.get())),
        server_(server) {}
  ~HttpConnection() {
    server_.pending.remove(waits_);
    if (!upgraded_) server_.end_connection();
  }

  void start() {
    wait_for_request();
    transport().expires_after(server_.limits.request_timeout);
    wire_->kind().handshake([self = shared_from_this()](beast::error_code error) {
      if (!error) self->read();
    });
  }

 private:
  static asio::ip::address peer_of(const tcp::socket& socket) {
    beast::error_code error;
    return socket.remote_endpoint(error).address();
  }
  beast::tcp_stream& transport() { return wire_->kind().transport(); }
  std::string_view header(http::field name) const { return view(parser_->get()[name]); }

  // Until its request is here others may have its place.
  void wait_for_request() {
    if (waits_ != 0) return;
    waits_ = server_.pending.add(peer_.to_string(), [self = weak_from_this()] {
      const auto connection = self.lock();
      if (!connection) return;
      connection->waits_ = 0;
      beast::error_code ignored;
      connection->transport().socket().close(ignored);
    });
  }
  void has_request() { server_.pending.remove(std::exchange(waits_, 0)); }

  void read() {
    wait_for_request();
    parser_.emplace();
    large_.reset();
    parser_->header_limit(static_cast<std::uint32_t>(server_.limits.header_bytes));
    // What the head announces is judged behind it: some routes take more, from those that they admit.
    parser_->body_limit(server_.guard != nullptr ? server_.most_body : 0);
    transport().expires_after(server_.limits.request_timeout);
    http::async_read_header(*wire_, input_, *parser_,
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (error) return self->unreadable(error);
                              self->read_body();
                            });
  }

  void read_body() {
    if (parser_->get().count(http::field::host) > 1) return refuse(400, "a request has one Host");
    if (server_.guard != nullptr) {
      const std::size_t most = most_body();
      if (parser_->content_length().value_or(0) > most) return refuse(413, "the body is too long");
      parser_->body_limit(most);
    }
    http::async_read(*wire_, input_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (error) return self->unreadable(error);
                       self->answer();
                     });
  }

  // A large body is read from whoever the route admits, and from nobody else.
  std::size_t most_body() {
    const std::size_t usual = server_.limits.body_bytes;
    const bool announced = parser_->chunked() || parser_->content_length().value_or(0) > usual;
    if (!announced || !server_.policy->is_own_authority(header(http::field::host))) return usual;
    api::Admission admission = admit();
    if (admission.route == nullptr || admission.route->most_body <= usual) return usual;
    const std::size_t most = admission.route->most_body;
    large_ = std::move(admission);
    has_request();
    transport().expires_after(server_.limits.large_request_timeout);
    return most;
  }

  void unreadable(beast::error_code error) {
    if (error == http::error::body_limit && server_.guard != nullptr)
      return refuse(413, "the body is too long");
    if (error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream) {
      refuse(400, "this request cannot be read");
    }
  }

  void answer() {
    has_request();
    if (server_.guard == nullptr) return serve({});
    if (!server_.policy->is_own_authority(header(http::field::host)))
      return refuse(403, "this name is not served here");
    api::Admission admission = large_ ? *std::exchange(large_, std::nullopt) : admit();
    if (admission.route == nullptr) return send(admission.refusal, admission.allowed);
    if (admission.route->lane == api::Lane::Server) {
      if (parser_->get().body().empty()) return serve(admission.call.who);
      return refuse(400, "this takes no body");
    }
    perform(std::move(admission));
  }

  api::Admission admit() const {
    const HttpRequest& request = parser_->get();
    const bool upgrades = beast::websocket::is_upgrade(request);
    api::Request asked;
    asked.method = view(request.method_string());
    asked.target = view(request.target());
    asked.cookie = header(http::field::cookie);
    asked.csrf = upgrades
                     ? offered_csrf(header(http::field::sec_websocket_protocol))
                     : view(request[beast::string_view(api::kCsrfHeader.data(), api::kCsrfHeader.size())]);
    asked.content_type = header(http::field::content_type);
    asked.own_origin = server_.policy->is_own_origin(header(http::field::origin));
    asked.peer = peer_.to_string();
    asked.peer_is_local = peer_.is_loopback();
    return server_.guard->admit(asked);
  }

  // In a thread of the lane; the answer comes back to the network's.
  void perform(api::Admission admission) {
    transport().expires_never();
    const api::Lane lane = admission.route->lane;
    const bool taken =
        server_.lanes->post(lane, [self = shared_from_this(), admission = std::move(admission)]() mutable {
          const auto answer = std::make_shared<api::Answer>(self->answer_of(std::move(admission)));
          asio::post(self->server_.io, [self, answer] { self->send(*answer, ""); });
        });
    if (taken) return;
    api::Answer busy = api::refused(503, "H0047", "too many requests wait already", "try again in a moment");
    busy.retry_after = std::chrono::seconds(1);
    send(busy, "");
  }

  // Whatever a handler does: whoever asked gets an answer, and the server goes on.
  api::Answer answer_of(api::Admission admission) const {
    try {
      return server_.guard->perform(std::move(admission), parser_->get().body());
    } catch (const std::exception& problem) {
      return api::refused(500, "H0048",
                          "this request failed within the server: " + std::string(problem.what()),
                          "what it was to do may be done in part; see the audit trail");
    }
  }

  void send(const api::Answer& answer, const std::string& allowed) {
    const HttpRequest& request = parser_->get();
    const bool known = !answer.etag.empty() && header(http::field::if_none_match) == answer.etag;
    response_ = Response(known ? http::status::not_modified : static_cast<http::status>(answer.status),
                         request.version());
    add_common_fields(response_);
    fill_with_answer(response_, answer, allowed, server_.guard->cookie());
    if (known || request.method() == http::verb::head) response_.body().clear();
    response_.keep_alive(request.keep_alive());
    write();
  }

  // What the policy decides: the page's files, the WebSocket, the metrics.
  void serve(const api::Caller& who) {
    const HttpRequest& request = parser_->get();
    Decision decision =
        server_.policy->decide({view(request.method_string()), view(request.target()),
                                header(http::field::host), header(http::field::origin),
                                header(http::field::if_none_match), beast::websocket::is_upgrade(request)});
    if (server_.feed == nullptr && (decision.status == 101 || decision.status == 426))
      decision = {404, nullptr, "there is nothing here"};
    // A session's pages are counted together, wherever they are.
    const std::string owner = who.csrf.empty() ? peer_.to_string() : who.csrf;
    if (decision.status == 101 && !server_.takes_viewer(owner))
      decision = {503, nullptr, "too many pages are open: close some"};
    if (decision.status == 101) {
      upgraded_ = true;
      transport().expires_never();
      server_.add_viewer(*std::exchange(wire_, std::nullopt), parser_->release(), who, owner);
      return;
    }
    const bool figures = decision.status == 200 && decision.asset == nullptr;
    if (figures && !server_.metrics) decision = {404, nullptr, "there is nothing here"};
    const bool head_only = request.method() == http::verb::head;
    response_ = Response(static_cast<http::status>(decision.status), request.version());
    add_common_fields(response_);
    if (decision.asset != nullptr) {
      const bool gzip = header(http::field::accept_encoding).find("gzip") != std::string_view::npos;
      fill_with_asset(response_, decision, gzip, head_only);
    } else if (figures && server_.metrics) {
      fill_with_metrics(response_, server_.metrics(), server_.metrics_type, head_only);
    } else {
      fill_with_error(response_, decision, head_only);
    }
    // What is left of a refused request is not looked for.
    response_.keep_alive(request.keep_alive() && decision.status < 400);
    write();
  }

  // For what is not HTTP, is too long, or brings a body that nobody wants. The connection ends.
  void refuse(unsigned status, std::string_view reason) {
    has_request();
    response_ = Response(static_cast<http::status>(status), 11);
    add_common_fields(response_);
    fill_with_error(response_, {status, nullptr, reason}, false);
    response_.keep_alive(false);
    write();
  }

  void write() {
    transport().expires_after(server_.limits.request_timeout);
    serializer_.emplace(response_);
    http::async_write(*wire_, *serializer_,
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return;
                        if (self->response_.keep_alive()) return self->read();
                        self->end();
                      });
  }

  void end() {
    if (server_.tls) return wire_->kind().end([self = shared_from_this()](beast::error_code) {});
    beast::error_code ignored;
    transport().socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  asio::ip::address peer_;
  std::optional<internal::Wire> wire_;  // none once it has become a WebSocket's
  HttpServer::State& server_;
  beast::flat_buffer input_{32'768};
  std::optional<http::request_parser<http::string_body>> parser_;
  Response response_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  std::optional<api::Admission> large_;  // of a request whose head was admitted for its large body
  bool upgraded_ = false;
  PendingConnections::Ticket waits_ = 0;
};

}  // namespace

void HttpServer::State::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted || !acceptor.is_open()) return;
    if (error) {
      // Out of file descriptors, most likely: others must close first.
      accept_retry.expires_after(std::chrono::milliseconds(100));
      accept_retry.async_wait([this](beast::error_code cancelled) {
        if (!cancelled) accept();
      });
      return;
    }
    if (connections < limits.connections || pending.close_one()) {
      ++connections;
      beast::error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<HttpConnection>(std::move(socket), *this)->start();
    }
    accept();
  });
}

bool HttpServer::State::takes_viewer(const std::string& owner) {
  std::erase_if(viewers, [](const Viewer& viewer) { return viewer.session.expired(); });
  const auto same = std::ranges::count(viewers, owner, &Viewer::owner);
  return viewers.size() < limits.viewers && static_cast<std::size_t>(same) < limits.viewers_of_one;
}

void HttpServer::State::add_viewer(internal::Wire wire, HttpRequest request, const api::Caller& who,
                                   std::string owner) {
  auto viewer = std::make_shared<ViewerSession>(
      std::move(wire), *feed, [this, who] { return guard == nullptr || guard->may_listen(who); },
      [this] { end_connection(); });
  viewers.push_back({viewer, std::move(owner)});
  const std::string protocol = who.csrf.empty() ? "" : std::string(api::kCsrfProtocol) + who.csrf;
  viewer->start(std::move(request), {limits.silent_viewer, limits.viewer_begins}, protocol);
}

void HttpServer::State::pump_viewers() {
  for (const auto& entry : viewers) {
    if (const auto viewer = entry.session.lock()) viewer->pump();
  }
}

void HttpServer::State::shut_down() {
  beast::error_code ignored;
  acceptor.close(ignored);
  for (const auto& entry : viewers) {
    if (const auto viewer = entry.session.lock()) viewer->cut();
  }
  io.stop();
}

result::Result<std::unique_ptr<HttpServer>> HttpServer::listen(const ListenAddress& address,
                                                               protocol::Assets assets, const Feed& feed,
                                                               const ServerLimits& limits) {
  return bind(address, assets, std::make_unique<State>(&feed, limits));
}

result::Result<std::unique_ptr<HttpServer>> HttpServer::listen_for_metrics(const ListenAddress& address,
                                                                           std::function<std::string()> text,
                                                                           std::string content_type,
                                                                           const ServerLimits& limits) {
  auto server = bind(address, {}, std::make_unique<State>(nullptr, limits));
  if (server) (*server)->serve_metrics(std::move(text), std::move(content_type));
  return server;
}

result::Result<std::unique_ptr<HttpServer>> HttpServer::bind(const ListenAddress& address,
                                                             protocol::Assets assets,
                                                             std::unique_ptr<State> state) {
  if (address.tls()) {
    auto tls = internal::load_tls(address.certificate, address.key);
    if (!tls) return result::forward(tls);
    state->tls = std::move(*tls);
  }
  const std::string where = address.host + ":" + std::to_string(address.port);
  beast::error_code error;
  tcp::resolver resolver(state->io);
  const auto found = resolver.resolve(address.host, std::to_string(address.port), error);
  if (!error && found.empty()) error = asio::error::host_not_found;
  if (error) {
    return result::fail("H0002", {}, "cannot serve at " + where + ": " + error.message(),
                        "set " + address.setting + ".host to an address of this machine; 127.0.0.1 is safe");
  }
  const tcp::endpoint endpoint = found.begin()->endpoint();
  tcp::acceptor& acceptor = state->acceptor;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) {
    return result::fail(
        "H0001", {},
        "port " + std::to_string(address.port) + " of " + address.host + " is in use by another program",
        std::string("stop that program, or choose another port with ") +
            (address.setting == "hmi" ? "--port or " : "") + address.setting + ".port");
  }
  if (error) {
    return result::fail(
        "H0002", {}, "cannot serve at " + where + ": " + error.message(),
        "ports below 1024 need rights; " + address.setting + ".host must be an address of this machine");
  }
  ListenAddress bound = address;
  bound.port = acceptor.local_endpoint().port();
  state->policy.emplace(bound, assets);
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(state)));
}

HttpServer::HttpServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
HttpServer::~HttpServer() = default;

void HttpServer::serve_metrics(std::function<std::string()> text, std::string content_type) {
  state_->metrics = std::move(text);
  state_->metrics_type = std::move(content_type);
}

void HttpServer::tell_trouble(std::function<void(const std::string&)> on_trouble) {
  state_->on_trouble = std::move(on_trouble);
}

void HttpServer::serve_api(const api::RequestGuard& guard) {
  state_->guard = &guard;
  state_->most_body = state_->limits.body_bytes;
  for (const api::Route& row : guard.table().rows())
    state_->most_body = std::max(state_->most_body, row.most_body);
  state_->lanes = std::make_unique<ApiLanes>();
}

std::uint16_t HttpServer::port() const {
  return state_->acceptor.local_endpoint().port();
}

void HttpServer::run() {
  state_->accept();
  // A connection that fails in a way that nobody foresaw ends; the others go on.
  while (const auto thrown = result::thrown_by([this] { state_->io.run(); })) {
    if (state_->on_trouble) state_->on_trouble(*thrown);
  }
  state_->lanes.reset();  // what is under way ends with the server, and not after what it refers to
}

void HttpServer::stop() {
  asio::post(state_->io, [state = state_.get()] { state->shut_down(); });
}

void HttpServer::notify() {
  asio::post(state_->io, [state = state_.get()] { state->pump_viewers(); });
}

}  // namespace stepwright::server
