// SPDX-License-Identifier: BSD-3-Clause
// Servers whose readers connect, by TCP or by a Unix socket, and get whole lines from then on.
#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <mutex>
#include <utility>

#include "lockbox/core/error.hpp"
#include "outlet.hpp"
#include "quiet_thread.hpp"
#include "unix_path.hpp"

namespace lockbox {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using asio::local::stream_protocol;
using Error = boost::system::error_code;

/// Who reads at the same time; the next ones are sent away. Doubled, readers that never read take
/// 2 MB more of what waits for them.
constexpr std::size_t kMostReaders = 64;

/// Where no connection can be taken (no more file descriptors), it is tried again so much later.
constexpr auto kRetry = std::chrono::milliseconds(100);

template <typename Protocol>
struct Reader {
  explicit Reader(typename Protocol::socket connection) : socket(std::move(connection)) {}

  typename Protocol::socket socket;
  LineQueue queue;
  Line line;                     ///< that is on its way; null: none
  std::array<char, 256> said{};  ///< what readers say is not looked at
};

/// Sockets are used in its thread only; what is counted and queued, under its lock.
template <typename Protocol>
class StreamServer : public Outlet {
 public:
  StreamServer(std::string target, const typename Protocol::endpoint& endpoint)
      : target_(std::move(target)), acceptor_(context_, endpoint), timer_(context_) {
    accept();
    thread_ = start_quiet_thread([this] { context_.run(); });
  }

  ~StreamServer() override { StreamServer::close(); }

  typename Protocol::endpoint endpoint() const { return acceptor_.local_endpoint(); }

  void send(const Line& line) override {
    const std::lock_guard lock(mutex_);
    for (const auto& reader : readers_) dropped_ += reader->queue.push(line);
    if (!std::exchange(is_flush_due_, true)) asio::post(context_, [this] { flush(); });
  }

  void close() override {
    if (!thread_.joinable()) return;
    asio::post(context_, [this] { say_farewell(); });
    thread_.join();
  }

  Publication publication() const override {
    const std::lock_guard lock(mutex_);
    return {target_, connected_, dropped_, address()};
  }

 private:
  using ReaderPointer = std::shared_ptr<Reader<Protocol>>;

  void accept() {
    acceptor_.async_accept([this](Error error, typename Protocol::socket socket) {
      if (!acceptor_.is_open()) return;
      if (error) {
        timer_.expires_after(kRetry);
        timer_.async_wait([this](Error cancelled) {
          if (!cancelled) accept();
        });
        return;
      }
      welcome(std::move(socket));
      accept();
    });
  }

  void welcome(typename Protocol::socket socket) {
    const std::lock_guard lock(mutex_);
    if (readers_.size() == kMostReaders) return;
    if constexpr (std::is_same_v<Protocol, tcp>) {
      Error ignored;
      socket.set_option(tcp::no_delay(true), ignored);
    }
    const auto reader = std::make_shared<Reader<Protocol>>(std::move(socket));
    readers_.push_back(reader);
    ++connected_;
    listen_to(reader);
  }

  /// What was said and not read would make the end of a connection an abrupt one, in which its last
  /// lines are lost.
  void listen_to(const ReaderPointer& reader) {
    reader->socket.async_read_some(asio::buffer(reader->said),
                                   [this, reader](Error error, std::size_t) {
                                     if (!error) listen_to(reader);
                                   });
  }

  void flush() {
    const std::lock_guard lock(mutex_);
    is_flush_due_ = false;
    for (const auto& reader : readers_) begin_writing(reader);
  }

  /// Under the lock.
  void begin_writing(const ReaderPointer& reader) {
    if (reader->line || reader->queue.empty()) return;
    reader->line = reader->queue.pop();
    asio::async_write(reader->socket, asio::buffer(*reader->line),
                      [this, reader](Error error, std::size_t) { end_writing(reader, error); });
  }

  void end_writing(const ReaderPointer& reader, Error error) {
    const std::lock_guard lock(mutex_);
    if (error == asio::error::operation_aborted) return;
    reader->line = nullptr;
    if (error) {  // it has gone away
      Error ignored;
      reader->socket.close(ignored);
      std::erase(readers_, reader);
    } else {
      begin_writing(reader);
    }
    if (is_closing_) end_if_all_is_said();
  }

  void say_farewell() {
    const std::lock_guard lock(mutex_);
    Error ignored;
    acceptor_.close(ignored);
    is_closing_ = true;
    for (const auto& reader : readers_) begin_writing(reader);
    timer_.expires_after(kFarewell);
    timer_.async_wait([this](Error cancelled) {
      if (!cancelled) end();
    });
    end_if_all_is_said();
  }

  /// Under the lock.
  void end_if_all_is_said() {
    const bool is_waiting = std::any_of(readers_.begin(), readers_.end(),
                                        [](const auto& reader) { return reader->line != nullptr; });
    if (!is_waiting) hang_up();
  }

  void end() {
    const std::lock_guard lock(mutex_);
    hang_up();
  }

  /// Under the lock. Then nothing is left to do, and the thread ends.
  void hang_up() {
    Error ignored;
    for (const auto& reader : readers_) {
      dropped_ += reader->queue.size() + (reader->line ? 1 : 0);
      reader->socket.shutdown(Protocol::socket::shutdown_send, ignored);
      reader->socket.close(ignored);
    }
    readers_.clear();
    timer_.cancel();
  }

  std::string target_;
  asio::io_context context_{1};
  typename Protocol::acceptor acceptor_;
  asio::steady_timer timer_;
  mutable std::mutex mutex_;  ///< of all below
  std::vector<ReaderPointer> readers_;
  std::size_t connected_ = 0;
  std::size_t dropped_ = 0;
  bool is_flush_due_ = false;
  bool is_closing_ = false;
  std::thread thread_;
};

class TcpServer : public StreamServer<tcp> {
 public:
  using StreamServer::StreamServer;

  std::string address() const override { return address_; }

 private:
  std::string address_ = "tcp " + [](const tcp::endpoint& at) {
    const std::string host = at.address().to_string();
    return (at.address().is_v6() ? "[" + host + "]" : host) + ":" + std::to_string(at.port());
  }(endpoint());
};

class UnixServer : public StreamServer<stream_protocol> {
 public:
  UnixServer(const std::string& target, std::unique_ptr<UnixPath> path)
      : StreamServer(target, stream_protocol::endpoint(path->path())), path_(std::move(path)) {
    path_->note_bound();
  }

  std::string address() const override { return "unix " + path_->path(); }

  void close() override {
    StreamServer::close();
    path_->remove();
  }

 private:
  std::unique_ptr<UnixPath> path_;
};

std::string reason(const PublishTarget& target, const Error& error) {
  if (error == asio::error::address_in_use && target.kind == PublishTarget::Kind::tcp) {
    return "another program uses port " + std::to_string(target.port) +
           "; end it, or give another port";
  }
  return "cannot be listened at (" + error.message() + ")";
}

}  // namespace

std::unique_ptr<Outlet> make_tcp_server(const PublishTarget& target) {
  asio::io_context context;
  tcp::resolver resolver(context);
  Error error;
  const auto found =
      resolver.resolve(target.host, std::to_string(target.port), tcp::resolver::passive, error);
  if (error) throw InputError(target.text, "the host cannot be found (" + error.message() + ")");
  try {
    return std::make_unique<TcpServer>(target.text, found.begin()->endpoint());
  } catch (const boost::system::system_error& failure) {
    throw InputError(target.text, reason(target, failure.code()));
  }
}

std::unique_ptr<Outlet> make_unix_server(const PublishTarget& target) {
  auto path = std::make_unique<UnixPath>(target.path, target.text);
  try {
    return std::make_unique<UnixServer>(target.text, std::move(path));
  } catch (const boost::system::system_error& failure) {
    throw InputError(target.text, reason(target, failure.code()));
  }
}

}  // namespace lockbox
