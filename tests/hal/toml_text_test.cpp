// SPDX-License-Identifier: Apache-2.0
// TOML as anybody may write it: random documents are read as what they were made of; keys that are
// too deep and headers that are too many are refused with their line, wherever dots, brackets and
// quotes stand.
#include "stylet/toml_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "draw.h"

namespace stylet::test {
namespace {

// Text that a simple scan might take for something else.
struct Quoted {
  const char *written, *meant;
};
constexpr Quoted kQuoted[] = {{R"("...[{=#'")", "...[{=#'"},
                              {R"('...]}="#')", "...]}=\"#"},
                              {R"("a\"....")", "a\"...."},
                              {R"('\')", "\\"},
                              {R"("\\")", "\\"},
                              {R"("")", ""},
                              {R"("'''")", "'''"},
                              {R"('"""')", "\"\"\""},
                              {R"('''b'''')", "b'"},
                              {R"(''''.''''')", "'.''"},
                              {R"("""\"""")", "\""},
                              {R"("""\\"""")", "\\\""},
                              {R"("""""")", ""},
                              {R"('''''')", ""},
                              {"'''a\n''.....\n'''", "a\n''.....\n"},
                              {"\"\"\"\n.\\\\\"\"\"\"\"", ".\\\"\""}};
constexpr std::size_t kOfOneLine = 14;  // the first of them

struct Text {
  std::string text;
  std::size_t lines = 0;

  void add(const std::string& line) {
    text += line + "\n";
    lines += 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), '\n'));
  }
};

std::string noise(Draw& draw) {
  return draw.chance(0.5) ? "" : " # \"'[{" + std::string(draw.below(90), '.') + "=";
}

std::string key_of(Draw& draw, std::size_t parts, std::size_t number) {
  std::string key = fmt::format("k{}", number);
  for (std::size_t i = 1; i < parts; ++i) {
    constexpr const char* kParts[] = {".a", " . a", ".\"]=.\"", ".'\\'", ".\"\\\"[.\""};
    key += kParts[draw.below(std::size(kParts))];
  }
  return key;
}

// Key number N has list N of `meant`: indices of kQuoted.
Text drawn(Draw& draw, std::vector<std::vector<std::size_t>>& meant) {
  Text out;
  for (std::size_t number = 0, count = 1 + draw.below(12); number < count; ++number) {
    const std::string head = draw.chance(0.5) ? "" : key_of(draw, kMaxKeyParts, number);
    if (!head.empty()) out.add(draw.chance(0.5) ? "[" + head + "]" : "\t [[" + head + "]]");
    std::string list;
    meant.emplace_back();
    for (std::uint32_t i = draw.below(6); i > 0; --i) {
      meant.back().push_back(draw.below(std::size(kQuoted)));
      list += std::string(kQuoted[meant.back().back()].written) + "," + noise(draw) + "\n";
    }
    out.add(fmt::format("[[list]]{}", noise(draw)));
    out.add(fmt::format("{}= 3{}", key_of(draw, kMaxKeyParts, number), noise(draw)));
    out.add(fmt::format("v=[{}\n{}]{}", noise(draw), list, noise(draw)));
  }
  return out;
}

std::size_t line_refused(const std::string& text, const char* why) {
  try {
    (void)parse_toml_text(text, "a.toml");
  } catch (const TomlFault& fault) {
    EXPECT_THAT(fault.what(), testing::HasSubstr(why));
    return fault.line;
  }
  return 0;
}

TEST(TomlText, IsReadWhateverStandsInQuotesAndComments) {
  Draw draw(1);
  for (int run = 0; run < 300; ++run) {
    std::vector<std::vector<std::size_t>> meant;
    const Text text = drawn(draw, meant);
    const toml::table table = parse_toml_text(text.text, "a.toml");
    const toml::array& lists = *table["list"].as_array();
    ASSERT_EQ(lists.size(), meant.size());
    for (std::size_t i = 0; i < meant.size(); ++i) {
      const toml::array& list = *lists[i].as_table()->get_as<toml::array>("v");
      ASSERT_EQ(list.size(), meant[i].size());
      for (std::size_t j = 0; j < list.size(); ++j) {
        EXPECT_EQ(list[j].value<std::string>(), kQuoted[meant[i][j]].meant);
      }
    }
  }
}

TEST(TomlText, ADeepKeyIsRefusedInItsLine) {
  Draw draw(2);
  for (int run = 0; run < 300; ++run) {
    std::vector<std::vector<std::size_t>> meant;
    Text text = drawn(draw, meant);
    const std::string key = key_of(draw, kMaxKeyParts + 1, 99);
    const std::string lines[] = {key + "=1", "[" + key + "]", "[[" + key + "]]",
                                 std::string("a=[1.5, {c=") +
                                     kQuoted[draw.below(kOfOneLine)].written + ", b={" + key +
                                     "=1}}]"};
    text.add(lines[draw.below(std::size(lines))]);
    const std::size_t line = text.lines;
    text.add("c = 1");
    EXPECT_EQ(line_refused(text.text, "a key of more than 32 parts"), line) << text.text;
  }
}

// Before there was a limit, these documents ended in a stack overflow.
TEST(TomlText, NoTableIsSoDeepThatItsDestructionOverflowsTheStack) {
  std::string key = "a";
  for (int part = 0; part < 300'000; ++part) key += ".a";
  for (const std::string& text : {key + "=1\n", "[" + key + "]\n", "[[" + key + "]]\n",
                                  "b={" + key + "=1}\n", key + "\n", key}) {
    EXPECT_EQ(line_refused(text, "a key of more than 32 parts"), 1U);
  }
  std::string deep = "b=1";
  for (std::size_t level = 0; level < TOML_MAX_NESTED_VALUES - 1; ++level)
    deep = "a={" + deep + "}";
  EXPECT_EQ(line_refused(deep, ""), 0U);
  EXPECT_EQ(line_refused("a={" + deep + "}", "nested"), 1U);
}

// Neither plain keys nor nested lists count.
TEST(TomlText, HeadersAndDottedKeysHaveALimit) {
  Draw draw(3);
  std::string text = "[[a]]\nc = [\n[1], [2.5]]\n";
  std::size_t lines = 3;
  for (std::size_t i = 1; i < kMaxTomlHeads; ++i) {
    const bool is_header = draw.chance(0.5);
    text += is_header ? " [[a]]\n" : fmt::format("a.k{} = [[1.5,\n[2.5]]]\n", i);
    lines += is_header ? 1 : 2;
  }
  EXPECT_EQ(line_refused(text, ""), 0U);
  EXPECT_EQ(line_refused(text + "[d]\n", "more than 65536 headers and dotted keys"), lines + 1);
  EXPECT_EQ(line_refused(text + "e.d=1\n", "more than 65536 headers and dotted keys"), lines + 1);
}

}  // namespace
}  // namespace stylet::test
