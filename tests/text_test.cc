#include "wheelwright/base/text.h"

#include <gtest/gtest.h>

#include <string>

#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

bool is_utf8(std::string_view text) {
  while (const std::size_t length = utf8_length(text)) text.remove_prefix(length);
  return text.empty();
}

/// The bit pattern of UTF-8 for a number, well-formed or not, in a given number of bytes.
std::string encoded(unsigned code, int bytes) {
  if (bytes == 1) return {static_cast<char>(code)};
  const unsigned marks[] = {0, 0, 0xc0, 0xe0, 0xf0};
  std::string result(bytes, '\0');
  for (int i = bytes - 1; i > 0; --i, code >>= 6) result[i] = static_cast<char>(0x80 | (code & 0x3f));
  result[0] = static_cast<char>(marks[bytes] | code);
  return result;
}

int shortest_length(unsigned code) { return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4; }

TEST(Text, EveryCodePointIsUtf8InItsShortestFormOnly) {
  for (unsigned code = 0; code < 0x120000; ++code) {
    const bool exists = code < 0x110000 && (code < 0xd800 || code > 0xdfff);
    const int shortest = shortest_length(code);
    for (int bytes = shortest; bytes <= 4; ++bytes) {
      const std::size_t wanted = exists && bytes == shortest ? bytes : 0;
      const std::string text = encoded(code, bytes);
      ASSERT_EQ(utf8_length(text), wanted) << code << " in " << bytes;
      ASSERT_EQ(is_utf8(text.substr(0, bytes - 1)), bytes == 1) << code << " in " << bytes;
    }
  }
}

TEST(Text, EveryBytePairIsUtf8AsItsPartsAre) {
  for (int a = 0; a < 256; ++a)
    for (int b = 0; b < 256; ++b) {
      const std::string text{static_cast<char>(a), static_cast<char>(b)};
      const bool two_ascii = a < 0x80 && b < 0x80;
      const bool one_character = a >= 0xc2 && a < 0xe0 && b >= 0x80 && b < 0xc0;
      ASSERT_EQ(is_utf8(text), two_ascii || one_character) << a << ' ' << b;
    }
}

TEST(Text, NothingControlsATerminal) {
  EXPECT_EQ(without_control_characters("a\tb\r\nc\x1b[31m\x7f\xc2\x9b\xc2\xa0\xff\xe2\x82"),
            "a b  c?[31m??\xc2\xa0???");
  EXPECT_EQ(without_control_characters(std::string("a\0b", 3)), "a?b");
  EXPECT_EQ(without_control_characters("Räder \u6b63"), "Räder \u6b63");
}

TEST(Text, TitlesAreEscapedInXml) {
  EXPECT_EQ(escape_xml("<a href='x' title=\"y\">&amp;</a>"),
            "&lt;a href=&apos;x&apos; title=&quot;y&quot;&gt;&amp;amp;&lt;/a&gt;");
  EXPECT_EQ(escape_xml("]]>\xef\xbf\xbe\xef\xbf\xbf\xef\xbf\xbd\x01"), "]]&gt;??\xef\xbf\xbd?");
}

}  // namespace
}  // namespace wheelwright
