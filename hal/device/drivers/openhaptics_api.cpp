// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/openhaptics_api.h"

#include <fmt/format.h>

#include <initializer_list>
#include <vector>

#include "hal/device/devices.h"
#include "hal/device/drivers/openhaptics_names.h"
#include "hal/device/vendor_library.h"

namespace stylet::hal::openhaptics {
namespace {

#ifdef _WIN32
constexpr std::initializer_list<const char*> kFiles = {"hd.dll"};
#else
constexpr std::initializer_list<const char*> kFiles = {"libHD.so", "libHD.so.3.4", "libHD.so.3.4.0",
                                                       "libHD.so.3.0"};
#endif

}  // namespace

Api load() {
  const VendorLibrary library("hd", "STYLET_LIBHD", kFiles);
  Api api = {};
  library.need("hdInitDevice", api.init_device);
  library.need("hdDisableDevice", api.disable_device);
  library.need("hdMakeCurrentDevice", api.make_current);
  library.need("hdBeginFrame", api.begin_frame);
  library.need("hdEndFrame", api.end_frame);
  library.need("hdGetError", api.get_error);
  library.need("hdGetErrorString", api.get_error_string);
  library.need("hdEnable", api.enable);
  library.need("hdGetIntegerv", api.get_integers);
  library.need("hdGetDoublev", api.get_doubles);
  library.need("hdSetDoublev", api.set_doubles);
  library.need("hdGetString", api.get_string);
  library.need("hdCheckCalibration", api.check_calibration);
  library.need("hdUpdateCalibration", api.update_calibration);
  library.need("hdStartScheduler", api.start_scheduler);
  library.need("hdStopScheduler", api.stop_scheduler);
  library.need("hdScheduleAsynchronous", api.schedule);
  library.need("hdUnschedule", api.unschedule);
  return api;
}

void forget_errors(const Api& api) {
  for (int i = 0; i < 64 && api.get_error().code != 0; ++i) {
  }
}

const char* remedy(unsigned int code) {
  switch (code) {
    case 0x0301:
      return "close the other program that has it";
    case 0x0303:
      return "unplug it and plug it in again: a program that was killed may have left it so";
    case 0x0600:
      return "install the vendor's licence";
    default:
      return "check the cable, the power, the right to use it (stylet devices) and the vendor's "
             "set-up program";
  }
}

HdHandle init(const Api& api, const std::string& name) {
  std::vector<const char*> names = {nullptr, "Default Device", "Default PHANToM"};
  if (!name.empty()) names = {name.c_str()};
  ErrorInfo error = {};  // of the first name: the other names are guesses
  for (const char* each : names) {
    forget_errors(api);
    const HdHandle handle = api.init_device(each);
    const ErrorInfo now = api.get_error();
    if (handle != kInvalidHandle && now.code == 0) return handle;
    if (error.code == 0) error = now;
  }
  const std::string unnamed = name_fault(name);
  throw DeviceError(fmt::format("hd:{}: error 0x{:04x} ({}), internal {}: {}", name, error.code,
                                api.get_error_string(error.code), error.internal,
                                unnamed.empty() ? remedy(error.code) : unnamed));
}

std::string string_of(const Api& api, Enum what) {
  const char* text = api.get_string(what);
  return text != nullptr ? text : "";
}

}  // namespace stylet::hal::openhaptics
