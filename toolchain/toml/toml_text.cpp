// SPDX-License-Identifier: Apache-2.0
#include "stylet/toml_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace stylet {
namespace {

// A walk over the text that knows no more of TOML than where comments and quoted texts end.
struct Walk {
  std::string_view rest;
  std::size_t line = 1;

  void skip(std::size_t bytes) {
    const std::string_view skipped = rest.substr(0, bytes);
    line += static_cast<std::size_t>(std::count(skipped.begin(), skipped.end(), '\n'));
    rest.remove_prefix(skipped.size());
  }
};

// Behind a text in three quotes; one or two quotes may be its last characters.
std::size_t long_text_end(std::string_view text, char quote) {
  const bool escapes = quote == '"';
  std::size_t quotes = 0;
  for (std::size_t at = 3; at < text.size(); ++at) {
    if (quotes >= 3 && (text[at] != quote || quotes == 5)) return at;
    quotes = text[at] == quote ? quotes + 1 : 0;
    if (escapes && text[at] == '\\') ++at;
  }
  return text.size();
}

// Behind a text in quotes, or at the end of its line.
std::size_t text_end(std::string_view text) {
  const char quote = text.front();
  if (text.starts_with(std::string(3, quote))) return long_text_end(text, quote);
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (text[at] == quote) return at + 1;
    if (text[at] == '\n') return at;
    if (quote == '"' && text[at] == '\\') ++at;
  }
  return text.size();
}

// What has no dot, no bracket and no end of a key in it.
std::size_t opaque_bytes(std::string_view text) {
  if (text.front() == '#') return std::min(text.find('\n'), text.size());
  return text.front() == '"' || text.front() == '\'' ? text_end(text) : 0;
}

class Heads {
 public:
  void take(char c, std::size_t line) {
    const bool opens = c == '[' || c == '{', closes = c == ']' || c == '}';
    if (c == '.' && ++parts_ > kMaxKeyParts) {
      throw TomlFault(fmt::format("a key of more than {} parts", kMaxKeyParts), line);
    }
    const bool is_head = (c == '[' && starts_ && depth_ == 0) || (c == '=' && parts_ > 1);
    if (is_head && ++count_ > kMaxTomlHeads) {
      throw TomlFault(fmt::format("more than {} headers and dotted keys", kMaxTomlHeads), line);
    }
    if (opens) ++depth_;
    if (closes && depth_ > 0) --depth_;
    if (opens || closes || c == '\n' || c == '=' || c == ',') parts_ = 1;
    starts_ = c == '\n' || (starts_ && (c == ' ' || c == '\t'));
  }

 private:
  std::size_t count_ = 0, depth_ = 0, parts_ = 1;
  bool starts_ = true;  // only blanks before it in its line
};

}  // namespace

toml::table parse_toml_text(std::string_view text, const std::string& file) {
  Heads heads;
  for (Walk walk{text}; !walk.rest.empty();) {
    const std::size_t opaque = opaque_bytes(walk.rest);
    if (opaque == 0) heads.take(walk.rest.front(), walk.line);
    walk.skip(std::max<std::size_t>(opaque, 1));
  }
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw TomlFault(std::string(error.description()), error.source().begin.line);
  }
}

}  // namespace stylet
