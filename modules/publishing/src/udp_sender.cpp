// SPDX-License-Identifier: BSD-3-Clause
// One datagram a line. Sending one never waits, so it needs no thread.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

#include "lockbox/core/error.hpp"
#include "outlet.hpp"

namespace lockbox {
namespace {

using boost::asio::ip::udp;

class UdpSender : public Outlet {
 public:
  explicit UdpSender(const PublishTarget& target) : target_(target.text), socket_(context_) {
    boost::system::error_code error;
    udp::resolver resolver(context_);
    const auto found = resolver.resolve(target.host, std::to_string(target.port), error);
    if (error) throw InputError(target_, "the host cannot be found (" + error.message() + ")");
    receiver_ = *found.begin();
    socket_.open(receiver_.protocol(), error);
    if (!error) socket_.non_blocking(true, error);
    if (error) throw InputError(target_, "cannot be sent to (" + error.message() + ")");
  }

  void send(const Line& line) override {
    boost::system::error_code error;
    socket_.send_to(boost::asio::buffer(*line), receiver_, 0, error);
    if (error) ++dropped_;
  }

  void close() override { socket_.close(); }

  std::string address() const override {
    return "udp to " + receiver_.address().to_string() + ":" + std::to_string(receiver_.port());
  }

  Publication publication() const override { return {target_, 1, dropped_, address()}; }

 private:
  std::string target_;
  boost::asio::io_context context_;
  udp::socket socket_;
  udp::endpoint receiver_;
  std::size_t dropped_ = 0;
};

}  // namespace

std::unique_ptr<Outlet> make_udp_sender(const PublishTarget& target) {
  return std::make_unique<UdpSender>(target);
}

}  // namespace lockbox
