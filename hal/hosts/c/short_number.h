// SPDX-License-Identifier: Apache-2.0
// A number in six digits, as printf's %g has it, without printf: that would be 8 kB of a page's
// library, which may have 200.
//
// Promise: the digits are right to half of the last one, but for rounding of doubles.
#pragma once

#include <cmath>
#include <cstdint>

namespace stylet::c {

class ShortNumber {
 public:
  explicit ShortNumber(double value) {
    const double size = std::fabs(value);
    if (std::signbit(value)) add('-');
    if (std::isnan(value)) {
      put("nan");
    } else if (std::isinf(size)) {
      put("inf");
    } else if (size == 0) {
      put("0");
    } else {
      put_number(size);
    }
  }
  const char* text() const { return text_; }

 private:
  static constexpr int kDigits = 6;
  char text_[16] = {};
  int length_ = 0;

  void add(char letter) { text_[length_++] = letter; }
  void put(const char* letters) {
    for (; *letters != '\0'; ++letters) add(*letters);
  }

  void put_number(double size) {
    int power = 0;
    for (; size >= 10; ++power) size /= 10;
    for (; size < 1; --power) size *= 10;
    auto digits = static_cast<std::uint32_t>(size * 1e5 + 0.5);
    if (digits == 1'000'000) {
      digits = 100'000;
      ++power;
    }
    char digit[kDigits];
    for (int i = kDigits; i-- > 0; digits /= 10) digit[i] = static_cast<char>('0' + digits % 10);
    const bool plain = power >= -4 && power < kDigits;
    put_digits(digit, plain ? power + 1 : 1);
    if (!plain) put_power(power);
  }

  // `before` of the digits stand before the point.
  void put_digits(const char (&digit)[kDigits], int before) {
    int count = kDigits;
    while (count > 1 && digit[count - 1] == '0') --count;
    if (before <= 0) put("0.");
    for (int i = before; i < 0; ++i) add('0');
    for (int i = 0; i < count || i < before; ++i) {
      if (i > 0 && i == before) add('.');
      add(i < count ? digit[i] : '0');
    }
  }

  void put_power(int power) {
    const int size = power < 0 ? -power : power;
    add('e');
    add(power < 0 ? '-' : '+');
    if (size >= 100) add(static_cast<char>('0' + size / 100));
    add(static_cast<char>('0' + size / 10 % 10));
    add(static_cast<char>('0' + size % 10));
  }
};

}  // namespace stylet::c
