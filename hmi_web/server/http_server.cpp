#include "hmi_web/server/http_server.h"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hmi_web/server/internal/viewer_session.h"

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
  void add_viewer(tcp::socket socket, HttpRequest request);
  void pump_viewers();
  void shut_down();

  const Feed* feed;  // null: there are no viewers
  ServerLimits limits;
  std::optional<RequestPolicy> policy;
  std::size_t connections = 0;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer accept_retry{io};
  std::vector<std::weak_ptr<ViewerSession>> viewers;
  std::function<std::string()> metrics;
  std::string metrics_type;
};

namespace {

using Response = http::response<http::string_body>;

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

void add_common_fields(Response& response) {
  for (const auto& [name, value] : kSecurityHeaders) {
    response.set(beast::string_view(name.data(), name.size()),
                 beast::string_view(value.data(), value.size()));
  }
}

void fill_with_asset(Response& response, const Decision& decision, bool accepts_gzip, bool head_only) {
  const protocol::Asset& asset = *decision.asset;
  response.set(http::field::content_type, std::string(asset.content_type));
  response.set(http::field::etag, std::string(asset.etag));
  response.set(http::field::vary, "Accept-Encoding");
  response.set(http::field::cache_control,
               asset.immutable ? "public, max-age=31536000, immutable" : "no-cache");
  if (decision.status == 304) return;
  if (accepts_gzip) response.set(http::field::content_encoding, "gzip");
  const std::string_view body = accepts_gzip ? asset.gzip : asset.body;
  response.content_length(body.size());
  if (!head_only) response.body() = std::string(body);
}

void fill_with_metrics(Response& response, std::string text, const std::string& type, bool head_only) {
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-store");
  response.content_length(text.size());
  if (!head_only) response.body() = std::move(text);
}

void fill_with_error(Response& response, const Decision& decision, bool head_only) {
  const std::string body = std::to_string(decision.status) + " " + std::string(decision.reason) + "\n";
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  if (decision.status == 405) response.set(http::field::allow, "GET, HEAD");
  if (decision.status == 426) response.set(http::field::upgrade, "websocket");
  response.content_length(body.size());
  if (!head_only) response.body() = body;
}

// One HTTP connection until it ends or becomes a WebSocket. shared_ptr: each pending operation holds it.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, HttpServer::State& server)
      : stream_(std::move(socket)), server_(server) {}
  ~HttpConnection() {
    if (!upgraded_) server_.end_connection();
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(server_.limits.header_bytes));
    parser_->body_limit(0);
    stream_.expires_after(server_.limits.request_timeout);
    http::async_read(stream_, input_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) return self->answer();
                       if (error.category() == http::make_error_code(http::error::bad_method).category() &&
                           error != http::error::end_of_stream) {
                         self->refuse();
                       }
                     });
  }

 private:
  void answer() {
    const HttpRequest& request = parser_->get();
    const auto header = [&](http::field name) { return view(request[name]); };
    Decision decision =
        server_.policy->decide({view(request.method_string()), view(request.target()),
                                header(http::field::host), header(http::field::origin),
                                header(http::field::if_none_match), beast::websocket::is_upgrade(request)});
    if (server_.feed == nullptr && (decision.status == 101 || decision.status == 426))
      decision = {404, nullptr, "there is nothing here"};
    if (decision.status == 101) {
      upgraded_ = true;
      stream_.expires_never();
      server_.add_viewer(stream_.release_socket(), parser_->release());
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

  // For what is not HTTP, is too long, or brings a body.
  void refuse() {
    response_ = Response(http::status::bad_request, 11);
    add_common_fields(response_);
    fill_with_error(response_, {400, nullptr, "this request cannot be read"}, false);
    response_.keep_alive(false);
    write();
  }

  void write() {
    stream_.expires_after(server_.limits.request_timeout);
    serializer_.emplace(response_);
    http::async_write(stream_, *serializer_,
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return;
                        if (self->response_.keep_alive()) return self->read();
                        beast::error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  beast::tcp_stream stream_;
  HttpServer::State& server_;
  beast::flat_buffer input_{16'384};
  std::optional<http::request_parser<http::empty_body>> parser_;
  Response response_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  bool upgraded_ = false;
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
    if (connections < limits.connections) {
      ++connections;
      beast::error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<HttpConnection>(std::move(socket), *this)->read();
    }
    accept();
  });
}

void HttpServer::State::add_viewer(tcp::socket socket, HttpRequest request) {
  std::erase_if(viewers, [](const auto& viewer) { return viewer.expired(); });
  auto viewer = std::make_shared<ViewerSession>(std::move(socket), *feed, [this] { end_connection(); });
  viewers.push_back(viewer);
  viewer->start(std::move(request), limits.silent_viewer);
}

void HttpServer::State::pump_viewers() {
  for (const auto& entry : viewers) {
    if (const auto viewer = entry.lock()) viewer->pump();
  }
}

void HttpServer::State::shut_down() {
  beast::error_code ignored;
  acceptor.close(ignored);
  for (const auto& entry : viewers) {
    if (const auto viewer = entry.lock()) viewer->cut();
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
  state->policy.emplace(ListenAddress{address.host, acceptor.local_endpoint().port(), address.setting},
                        assets);
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(state)));
}

HttpServer::HttpServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
HttpServer::~HttpServer() = default;

void HttpServer::serve_metrics(std::function<std::string()> text, std::string content_type) {
  state_->metrics = std::move(text);
  state_->metrics_type = std::move(content_type);
}

std::uint16_t HttpServer::port() const {
  return state_->acceptor.local_endpoint().port();
}

void HttpServer::run() {
  state_->accept();
  state_->io.run();
}

void HttpServer::stop() {
  asio::post(state_->io, [state = state_.get()] { state->shut_down(); });
}

void HttpServer::notify() {
  asio::post(state_->io, [state = state_.get()] { state->pump_viewers(); });
}

}  // namespace stepwright::server
