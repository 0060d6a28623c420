// SPDX-License-Identifier: BSD-3-Clause
#include "articulated_sdf_registration_impl.hpp"

namespace lockbox {

template class ArticulatedSdfRegistration<pcl::PointXYZ, double>;
template class ArticulatedSdfRegistration<pcl::PointXYZI, double>;
template class ArticulatedSdfRegistration<pcl::PointXYZRGB, double>;
template class ArticulatedSdfRegistration<pcl::PointXYZRGBA, double>;
template class ArticulatedSdfRegistration<pcl::PointNormal, double>;
template class ArticulatedSdfRegistration<pcl::PointXYZRGBNormal, double>;

}  // namespace lockbox
