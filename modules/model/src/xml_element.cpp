// SPDX-License-Identifier: BSD-3-Clause
#include "xml_element.hpp"

#include <tinyxml2.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "printable_text.hpp"

namespace lockbox {

XmlElement::XmlElement(const std::string& file, const tinyxml2::XMLElement& element,
                       std::string subject)
    : file_(&file), element_(&element), subject_(std::move(subject)) {}

XmlElement XmlElement::about(std::string subject) const {
  return {*file_, *element_, std::move(subject)};
}

std::string XmlElement::name() const {
  return element_->Name();
}

int XmlElement::line() const {
  return element_->GetLineNum();
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> found;
  for (auto* e = element_->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    found.emplace_back(*file_, *e, subject_);
  }
  return found;
}

std::vector<XmlElement> XmlElement::children(const std::string& name) const {
  std::vector<XmlElement> found;
  for (auto* e = element_->FirstChildElement(name.c_str()); e != nullptr;
       e = e->NextSiblingElement(name.c_str())) {
    found.emplace_back(*file_, *e, subject_);
  }
  return found;
}

std::optional<XmlElement> XmlElement::child(const std::string& name) const {
  auto found = children(name);
  if (found.empty()) return std::nullopt;
  if (found.size() > 1) found[1].refuse("has a second <" + name + ">; keep one");
  return found.front();
}

XmlElement XmlElement::required_child(const std::string& name) const {
  auto found = child(name);
  if (!found) refuse("<" + this->name() + "> has no <" + name + ">");
  return *found;
}

std::optional<std::string> XmlElement::attribute(const std::string& name) const {
  const char* value = element_->Attribute(name.c_str());
  if (value == nullptr) return std::nullopt;
  if (const auto byte = unprintable_byte(value)) {
    refuse("attribute '" + name + "' of <" + this->name() + "> holds the byte " + *byte +
           ", which is a control character or no UTF-8; write printable text");
  }
  return value;
}

std::string XmlElement::required_attribute(const std::string& name) const {
  auto value = attribute(name);
  if (!value || value->empty()) refuse("<" + this->name() + "> needs the attribute '" + name + "'");
  return *value;
}

std::optional<std::vector<double>> XmlElement::numbers(const std::string& name,
                                                       std::size_t count) const {
  const char* value = element_->Attribute(name.c_str());
  if (value == nullptr) return std::nullopt;
  std::vector<double> found;
  std::istringstream words{value};
  for (std::string word; words >> word;) {
    const auto parsed = parse_number(word);
    if (!parsed || !std::isfinite(*parsed)) {
      refuse("'" + word + "' in attribute '" + name + "' of <" + this->name() +
             "> is not a finite number; write it like 0.12 or -1e-3");
    }
    found.push_back(*parsed);
  }
  if (found.size() != count) {
    refuse("attribute '" + name + "' of <" + this->name() + "> needs " + std::to_string(count) +
           (count == 1 ? " number, not " : " numbers, not ") + std::to_string(found.size()));
  }
  return found;
}

std::optional<double> XmlElement::number(const std::string& name) const {
  const auto found = numbers(name, 1);
  return found ? std::optional(found->front()) : std::nullopt;
}

std::string XmlElement::plain_attribute(const std::string& name) const {
  const char* value = element_->Attribute(name.c_str());
  return value != nullptr && !unprintable_byte(value) ? value : "";
}

std::string XmlElement::remark(const std::string& problem) const {
  return *file_ + ":" + std::to_string(line()) + ": " + subject_ + ": " + problem;
}

std::string XmlElement::whole_file_remark(const std::string& problem) const {
  return *file_ + ": " + problem;
}

void XmlElement::refuse(const std::string& problem) const {
  throw InputError(*file_, line(), subject_ + ": " + problem);
}

}  // namespace lockbox
