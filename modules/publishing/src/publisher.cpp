// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/publishing/publisher.hpp"

#include "lockbox/core/error.hpp"
#include "outlet.hpp"

namespace lockbox {
namespace {

std::unique_ptr<Outlet> open(const PublishTarget& target) {
  switch (target.kind) {
    case PublishTarget::Kind::standard_output:
      return make_standard_output(target);
    case PublishTarget::Kind::tcp:
      return make_tcp_server(target);
    case PublishTarget::Kind::unix_socket:
      return make_unix_server(target);
    case PublishTarget::Kind::udp:
      return make_udp_sender(target);
  }
  throw InputError(target.text, "is not known");
}

void require_once(const PublishTarget& target, const std::vector<PublishTarget>& targets) {
  std::size_t count = 0;
  for (const auto& other : targets) count += other.text == target.text ? 1 : 0;
  if (count > 1) throw InputError(target.text, "is given twice; name every target once");
}

}  // namespace

Publisher::Publisher(const std::vector<PublishTarget>& targets) {
  for (const auto& target : targets) {
    require_once(target, targets);
    outlets_.push_back(open(target));
  }
}

Publisher::~Publisher() = default;

void Publisher::publish(const std::string& line) {
  if (outlets_.empty()) return;
  const auto shared = std::make_shared<const std::string>(line + '\n');
  for (const auto& outlet : outlets_) outlet->send(shared);
}

void Publisher::close() {
  for (const auto& outlet : outlets_) outlet->close();
}

int Publisher::output_error() const {
  for (const auto& outlet : outlets_) {
    if (const int error = outlet->error()) return error;
  }
  return 0;
}

std::vector<std::string> Publisher::addresses() const {
  std::vector<std::string> result;
  for (const auto& outlet : outlets_) result.push_back(outlet->address());
  return result;
}

std::vector<Publication> Publisher::publications() const {
  std::vector<Publication> result;
  for (const auto& outlet : outlets_) result.push_back(outlet->publication());
  return result;
}

}  // namespace lockbox
