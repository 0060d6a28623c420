// SPDX-License-Identifier: BSD-3-Clause
#include "articulated_sdf_registration_impl.hpp"

namespace lockbox {

template class ArticulatedSdfRegistration<pcl::PointXYZ, float>;
template class ArticulatedSdfRegistration<pcl::PointXYZI, float>;
template class ArticulatedSdfRegistration<pcl::PointXYZRGB, float>;
template class ArticulatedSdfRegistration<pcl::PointXYZRGBA, float>;
template class ArticulatedSdfRegistration<pcl::PointNormal, float>;
template class ArticulatedSdfRegistration<pcl::PointXYZRGBNormal, float>;

}  // namespace lockbox
