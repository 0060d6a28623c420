// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/contacts.hpp"

#include <gmock/gmock.h>

#include "urdf_test.hpp"

namespace lockbox {
namespace {

/// A block that slides on a plate whose upper side is at z = 0.
class ContactsTest : public testing::Test {
 protected:
  /// underside: of the block, metres over the plate.
  std::vector<Contact> contacts_at(double underside) const {
    const std::string height = std::to_string(0.02 + underside);
    LoadOptions without_cache;
    without_cache.cache_directory = std::filesystem::path();
    const auto urdf = folder_.write(
        "plate.urdf", "<robot name=\"r\">" +
                          link("plate", box("0.2 0.2 0.02", "<origin xyz=\"0 0 -0.01\"/>")) +
                          link("block", box("0.05 0.05 0.04")) +
                          joint("slide", "prismatic", "plate", "block",
                                "<origin xyz=\"0 0 " + height + "\"/>" + std::string(kLimit)) +
                          "</robot>");
    return rest_contacts(load_model(urdf, without_cache));
  }

  const TemporaryFolder folder_;
};

TEST_F(ContactsTest, FacesThatTouchAreOne) {
  const std::vector<Contact> contacts = contacts_at(0.0);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts.front().body_a, 0U);
  EXPECT_EQ(contacts.front().body_b, 1U);
  EXPECT_NEAR(contacts.front().overlap, 0.0, kContactTolerance);
}

TEST_F(ContactsTest, OfOverlappingBodiesTheOverlapIsMeasured) {
  const std::vector<Contact> contacts = contacts_at(-0.003);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts.front().overlap, 0.003, kContactTolerance);
}

TEST_F(ContactsTest, OfASmallGapTheOverlapIsNegative) {
  const std::vector<Contact> contacts = contacts_at(0.0006);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts.front().overlap, -0.0006, kContactTolerance);
}

TEST_F(ContactsTest, BodiesThatAreApartHaveNone) {
  EXPECT_THAT(contacts_at(0.002), testing::IsEmpty());
}

}  // namespace
}  // namespace lockbox
