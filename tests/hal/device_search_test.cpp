// SPDX-License-Identifier: Apache-2.0
// `stylet devices`: what is here, why something is not, and the remedy. It runs on made-up trees of
// /sys, /proc and /dev, with stand-ins of the vendors' libraries.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "device_bench.h"
#include "hal/device/search.h"

namespace stylet::hal {
namespace {

namespace fs = std::filesystem;

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

class DeviceSearch : public testing::Test {
 protected:
  DeviceSearch() { setenv("SPNAV_SOCKET", "/run/spnav.sock", 1); }
  ~DeviceSearch() override { fs::remove_all(root); }

  void write(const std::string& path, const std::string& text) const {
    fs::create_directories((root + path).substr(0, (root + path).rfind('/')));
    std::ofstream(root + path) << text << "\n";
  }
  // Puts a device on the bus, with its node.
  void plug(const std::string& place, const char* vendor, const char* product) const {
    const std::string folder = "/sys/bus/usb/devices/" + place;
    write(folder + "/idVendor", vendor);
    write(folder + "/idProduct", product);
    write(folder + "/busnum", "1");
    write(folder + "/devnum", "7");
    write("/dev/bus/usb/001/007", "");
  }
  // A Touch: the device at 1-2, with a terminal.
  void plug_touch() const {
    plug("1-2", "2988", "0302");
    fs::create_directories(root + "/sys/bus/usb/devices/1-2/1-2:1.0");
    fs::create_directories(root + "/sys/class/tty/ttyACM0");
    fs::create_directory_symlink(root + "/sys/bus/usb/devices/1-2/1-2:1.0",
                                 root + "/sys/class/tty/ttyACM0/device");
    write("/dev/ttyACM0", "");
  }
  void install_rules() const { write("/etc/udev/rules.d/70-stylet-haptic.rules", "rules"); }
  DeviceSighting seen(const std::string& uri) const {
    for (const DeviceSighting& each : search_devices(root)) {
      if (each.uri == uri) return each;
    }
    ADD_FAILURE() << uri;
    return {};
  }

  std::unique_ptr<Bench> hd = hd_bench(), dhd = dhd_bench();  // so that their libraries are there
  std::string root = testing::TempDir() + "stylet-devices-" + std::to_string(getpid());
};

TEST_F(DeviceSearch, NothingOnUsb) {
  fs::create_directories(root);
  EXPECT_EQ(seen("hd:").presence, Presence::kUnknown);  // older ones are not on USB
  EXPECT_TRUE(says(seen("hd:").seen, "none on USB"));
  EXPECT_EQ(seen("dhd:").presence, Presence::kMissing);
  EXPECT_EQ(seen("dhd:").remedy, "check cable and power");
  EXPECT_TRUE(says(seen("spacemouse:").seen, "no socket /run/spnav.sock"));
  EXPECT_TRUE(says(seen("spacemouse:").remedy, "apt install spacenavd"));
}

// What nobody has seen is neither ready nor missing, and needs no remedy.
TEST_F(DeviceSearch, WhatOnlyOpeningCanShowIsUnknown) {
  write("/run/spnav.sock", "");  // its daemon runs without a SpaceMouse as well
  for (const char* uri : {"udp:7755", "shm:NAME", "spacemouse:"}) {
    const DeviceSighting one = seen(uri);
    EXPECT_EQ(one.presence, Presence::kUnknown) << uri;
    EXPECT_EQ(one.remedy, "") << uri;
  }
  EXPECT_EQ(seen("udp:7755").seen, "shows itself only when it is opened");
  EXPECT_TRUE(says(seen("spacemouse:").seen, "none on USB"));
}

TEST_F(DeviceSearch, EachIsFoundByItsUsbNumbers) {
  plug("3-1", "0403", "cb48");
  EXPECT_EQ(seen("dhd:").presence, Presence::kReady);
  EXPECT_EQ(seen("dhd:").seen, "library, USB 3-1");
  plug("3-1", "0403", "6001");  // the same maker's serial port
  EXPECT_EQ(seen("dhd:").presence, Presence::kMissing);
  plug("3-1", "1451", "0301");
  EXPECT_EQ(seen("dhd:").presence, Presence::kReady);
  plug("1-1", "256f", "c635");
  EXPECT_EQ(seen("spacemouse:").seen, "USB 1-1, but no socket /run/spnav.sock");
  write("/run/spnav.sock", "");
  EXPECT_EQ(seen("spacemouse:").presence, Presence::kReady);
}

TEST_F(DeviceSearch, ModemManagerTakesATouchForAModemUnlessARuleSaysNo) {
  plug_touch();
  EXPECT_EQ(seen("hd:").presence, Presence::kReady);
  EXPECT_EQ(seen("hd:").seen, "library, USB 1-2");
  write("/proc/417/comm", "ModemManager");
  EXPECT_EQ(seen("hd:").presence, Presence::kMissing);
  EXPECT_EQ(seen("hd:").seen, "USB 1-2: ModemManager takes it for a modem");
  EXPECT_TRUE(says(seen("hd:").remedy, "installs udev rules"));
  install_rules();
  EXPECT_EQ(seen("hd:").presence, Presence::kReady);
}

// Not as root, who may open every file.
TEST_F(DeviceSearch, PermissionIsNamedWithItsNodeAndARemedy) {
  plug_touch();
  GTEST_FLAG_SET(death_test_style, "fast");
  const auto refused = [this](const char* remedy) {
    if (geteuid() == 0 && setuid(65534) != 0) return false;
    const DeviceSighting touch = seen("hd:");
    std::fputs((touch.seen + "; " + touch.remedy + "\n").c_str(), stderr);
    return touch.presence == Presence::kMissing &&
           says(touch.seen, "/dev/ttyACM0 may not be read and written") &&
           says(touch.remedy, remedy);
  };
  EXPECT_EQ(chmod((root + "/dev/ttyACM0").c_str(), 0), 0);
  EXPECT_EXIT(std::_Exit(refused("installs udev rules") ? 0 : 1), testing::ExitedWithCode(0), "");
  install_rules();
  EXPECT_EXIT(std::_Exit(refused("usermod -aG realtime") ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace stylet::hal
