// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/dicom_bounds.h"

#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/oflog/appender.h>
#include <dcmtk/oflog/oflog.h>
#include <dcmtk/oflog/spi/logevent.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/numbers.h"
#include "base/refusal.h"

namespace stylet::offline {
namespace {

// DCMTK warns of each element that is out of order, and the only way to end its slow search for the
// right place is an exception from this warning. The warning's text ends with the element's tag.
// Different tags are counted, not warnings: a writer with an order of its own has it in every item,
// which is harmless, because an item has each tag only once.
class OrderWatch : public dcmtk::log4cplus::Appender {
 public:
  ~OrderWatch() override { destructorImpl(); }
  void close() override {}
  void begin(const std::string& path) {
    path_ = path;
    misplaced_.clear();
  }

 private:
  void append(const dcmtk::log4cplus::spi::InternalLoggingEvent& event) override {
    constexpr std::size_t kMost = 1000;  // toolkits write none
    const auto& text = event.getMessage();
    if (text.find("not in ascending tag order") == OFString_npos) return;
    misplaced_.insert(text.c_str());
    if (misplaced_.size() <= kMost) return;
    refuse("{}: elements of more than {} kinds are out of order: expected tags that ascend", path_,
           kMost);
  }

  std::string path_;
  std::set<std::string> misplaced_;  // what was said of each tag
};

// Makes DCMTK silent and able to read compressed pixels; once for the whole process.
OrderWatch& prepare_library() {
  static OrderWatch* const watch = [] {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    auto* const added = new OrderWatch;  // the logger's from here on
    OFLogger data = OFLog::getLogger("dcmtk.dcmdata");
    data.setAdditivity(false);
    data.addAppender(dcmtk::log4cplus::SharedAppenderPtr(added));
    data.setLogLevel(OFLogger::WARN_LOG_LEVEL);
    // A decimal string of 64 kB or more is written without its VR (PS3.5, 6.2.2): many points.
    dcmEnableUnknownVRConversion.set(OFTrue);
    DcmRLEDecoderRegistration::registerCodecs();
    DJDecoderRegistration::registerCodecs();
    DJLSDecoderRegistration::registerCodecs();
    return added;
  }();
  return *watch;
}

// 200 000 nested levels overflow the stack; no image has more than a handful. Items are found by
// the bytes of their tag, which may also stand elsewhere; up to kHarmlessItems fit the stack even
// if each is nested in the one before. The smallest item with content has 18 bytes.
void require_flat(const std::string& path) {
  constexpr std::size_t kMostNested = 64, kHarmlessItems = 2000, kHead = 8, kLeastBytes = 16;
  constexpr std::uint32_t kUndefined = 0xFFFFFFFF;
  const std::string bytes = read_file(path);
  std::vector<std::size_t> ends;  // ends of the items around this byte
  std::size_t items = 0, deepest = 0;
  for (std::size_t at = 0; at + kHead <= bytes.size(); ++at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[at + i]); };
    const bool little = byte(0) == 0xFE && byte(1) == 0xFF && byte(3) == 0xE0;
    const bool big = byte(0) == 0xFF && byte(1) == 0xFE && byte(2) == 0xE0;
    if (!little && !big) continue;
    while (!ends.empty() && ends.back() <= at) ends.pop_back();
    const unsigned kind = little ? byte(2) : byte(3);
    if (kind == 0x0D && !ends.empty() && ends.back() == bytes.size()) ends.pop_back();
    if (kind != 0) continue;
    const auto size =
        number_at<std::uint32_t>(bytes, at + 4, little ? std::endian::little : std::endian::big);
    ends.push_back(size == kUndefined ? bytes.size() : at + kHead + size);
    deepest = std::max(deepest, ends.size());
    ++items;
  }
  if (items <= kHarmlessItems) return;
  if (deepest > kMostNested) {
    refuse("{}: sequences nested {} deep: expected at most {}", path, deepest, kMostNested);
  }
  if (items > bytes.size() / kLeastBytes) {
    refuse("{}: {} items in {} bytes: expected at least {} bytes for each", path, items,
           bytes.size(), kLeastBytes);
  }
}

// Refuses deflated files, since one cannot see how deep they are nested before they are inflated.
void require_readable(const std::string& path) {
  DcmFileFormat head;
  (void)head.loadFile(path.c_str(), EXS_Unknown, EGL_noChange, DCM_MaxReadLength, ERM_metaOnly);
  OFString syntax;
  (void)head.getMetaInfo()->findAndGetOFString(DCM_TransferSyntaxUID, syntax);
  if (syntax == UID_DeflatedExplicitVRLittleEndianTransferSyntax) {
    refuse("{}: the whole file is deflated: expected another transfer syntax", path);
  }
  require_flat(path);
}

}  // namespace

void load_dicom(const std::string& path, DcmFileFormat& format_out) {
  prepare_library().begin(path);
  require_readable(path);
  const OFCondition condition = format_out.loadFile(path.c_str());
  if (condition.bad()) refuse("{}: expected a whole DICOM file: {}", path, condition.text());
}

}  // namespace stylet::offline
