// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of XML elements: whatever is not as it should be is refused with file and line.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}

namespace lockbox {

/// A view of one element of a document that must outlive it.
class XmlElement {
 public:
  /// subject: what the element describes, e.g. "joint 'door'"; it begins every refusal.
  XmlElement(const std::string& file, const tinyxml2::XMLElement& element, std::string subject);

  /// Returns the same element, described otherwise. Its children inherit the subject.
  XmlElement about(std::string subject) const;

  std::string name() const;
  int line() const;
  const std::string& subject() const { return subject_; }

  std::vector<XmlElement> children() const;
  std::vector<XmlElement> children(const std::string& name) const;
  /// Refuses a second child of that name.
  std::optional<XmlElement> child(const std::string& name) const;
  XmlElement required_child(const std::string& name) const;

  /// Refuses values that are not UTF-8 or hold control characters.
  std::optional<std::string> attribute(const std::string& name) const;
  /// Refuses empty values too.
  std::string required_attribute(const std::string& name) const;

  /// Finite numbers separated by white space; refuses any other count.
  std::optional<std::vector<double>> numbers(const std::string& name, std::size_t count) const;
  std::optional<double> number(const std::string& name) const;

  /// Returns an attribute that does not matter as it is, empty where there is none or it is no
  /// text.
  std::string plain_attribute(const std::string& name) const;

  [[noreturn]] void refuse(const std::string& problem) const;
  /// What refuse() would say, as a warning.
  std::string remark(const std::string& problem) const;
  /// About no line in particular.
  std::string whole_file_remark(const std::string& problem) const;

 private:
  const std::string* file_;
  const tinyxml2::XMLElement* element_;
  std::string subject_;
};

}  // namespace lockbox
