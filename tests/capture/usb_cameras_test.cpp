// SPDX-License-Identifier: BSD-3-Clause
// Folders laid out as Linux lays out /sys/bus/usb/devices and /dev/bus/usb.
#include "usb_cameras.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class UsbCameras : public testing::Test {
 protected:
  UsbCameras() {
    std::filesystem::create_directories(bus_.devices / "usb1");  // a hub: no ids of a camera
    write(bus_.devices / "usb1" / "idVendor", "1d6b\n");
    write(bus_.devices / "usb1" / "idProduct", "0002\n");
  }

  void plug_in(const std::string& port, const std::string& vendor, const std::string& product,
               int number) {
    const auto device = bus_.devices / port;
    std::filesystem::create_directories(device / (port + ":1.0"));
    write(device / "idVendor", vendor + '\n');
    write(device / "idProduct", product + '\n');
    write(device / "busnum", "1\n");
    write(device / "devnum", std::to_string(number) + '\n');
  }

  void allow(const std::string& node) { write(bus_.nodes / node, ""); }

  void take(const std::string& port, const std::string& driver) {
    std::filesystem::create_symlink("../../../../bus/usb/drivers/" + driver,
                                    bus_.devices / port / (port + ":1.0") / "driver");
  }

  static void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  TemporaryFolder folder_;
  UsbBus bus_{folder_ / "sys", folder_ / "dev"};
};

TEST_F(UsbCameras, AreNoneWhereThereIsNoBus) {
  const UsbBus nowhere{folder_ / "nowhere", folder_ / "nowhere"};
  EXPECT_THAT(usb_cameras(nowhere), IsEmpty());
  EXPECT_THAT(why_no_camera({}), HasSubstr("check the cable"));
}

TEST_F(UsbCameras, AreOnlyThoseThatOpenNiKnows) {
  plug_in("1-1", "046d", "c52b", 2);  // a mouse
  plug_in("1-2", "045e", "07a5", 3);  // another mouse, of the vendor of a camera
  EXPECT_THAT(usb_cameras(bus_), IsEmpty());
  plug_in("1-3", "1d27", "0601", 5);
  plug_in("1-4.1", "045e", "02ae", 4);
  const auto cameras = usb_cameras(bus_);
  ASSERT_THAT(cameras, SizeIs(2));
  EXPECT_EQ(cameras[0].name, "first Kinect (USB 045e:02ae)");
  EXPECT_EQ(cameras[1].name, "PrimeSense or Asus Xtion camera (USB 1d27:0601)");
  EXPECT_EQ(cameras[1].node, bus_.nodes / "001" / "005");
}

TEST_F(UsbCameras, ThatMayNotBeOpenedWantTheUdevRule) {
  plug_in("1-3", "1d27", "0601", 5);  // without a node that could be written
  EXPECT_THAT(why_no_camera(usb_cameras(bus_)), HasSubstr("60-libopenni2-0.rules"));
  EXPECT_THAT(why_no_camera(usb_cameras(bus_)),
              HasSubstr("you may not open " + bus_.nodes.string()));
}

TEST_F(UsbCameras, ThatAreInUseSaySo) {
  plug_in("1-3", "1d27", "0601", 5);
  allow("001/005");
  EXPECT_EQ(obstacle(usb_cameras(bus_).front()), std::nullopt);
  EXPECT_THAT(why_no_camera(usb_cameras(bus_)), HasSubstr("plug it in again"));
  take("1-3", "usbfs");
  EXPECT_THAT(why_no_camera(usb_cameras(bus_)), HasSubstr("in use by another program"));
}

TEST_F(UsbCameras, ThatTheKernelHasTakenNameItsDriver) {
  plug_in("1-3", "045e", "02ae", 5);
  allow("001/005");
  EXPECT_THAT(why_no_camera(usb_cameras(bus_)), HasSubstr("needs one of its own"));
  take("1-3", "gspca_kinect");
  EXPECT_THAT(why_no_camera(usb_cameras(bus_)), HasSubstr("modprobe --remove gspca_kinect"));
}

}  // namespace
}  // namespace lockbox
