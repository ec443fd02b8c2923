#include "json_cursor.h"

#include <cctype>
#include <cstdio>

namespace phalanx {

namespace {
bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.' ||
         c == '_';
}
}  // namespace

TextCursor::TextCursor(std::string_view text) : text_(text) {
  if (text.starts_with("\xef\xbb\xbf")) position_ = counted_ = 3;
}

bool TextCursor::skip_if(char c) {
  if (at_end() || text_[position_] != c) return false;
  position_++;
  return true;
}

void TextCursor::skip_space() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return;
    position_++;
  }
}

std::string_view TextCursor::take_word() {
  const std::size_t start = position_;
  while (position_ < text_.size() && is_word_character(text_[position_])) position_++;
  return text_.substr(start, position_ - start);
}

TextPlace TextCursor::place() {
  for (; counted_ < position_; counted_++) {
    const auto byte = static_cast<unsigned char>(text_[counted_]);
    if (byte == '\n') {
      place_.line++;
      place_.column = 1;
    } else if ((byte & 0xc0) != 0x80) {
      place_.column++;
    }
  }
  return place_;
}

std::string TextCursor::describe_next() const {
  if (at_end()) return "the end of the file";
  const std::size_t length = utf8_length(rest());
  const auto byte = static_cast<unsigned char>(peek());
  if (length == 0 || byte < 0x20 || byte == 0x7f) {
    char name[16];
    std::snprintf(name, sizeof name, "byte 0x%02x", byte);
    return name;
  }
  return "'" + std::string(rest().substr(0, length)) + "'";
}

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead < 0xc2   ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; i++) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const unsigned second = byte(1);
  if (lead == 0xe0 && second < 0xa0) return 0;   // overlong
  if (lead == 0xed && second >= 0xa0) return 0;  // surrogate
  if (lead == 0xf0 && second < 0x90) return 0;   // overlong
  if (lead == 0xf4 && second >= 0x90) return 0;  // beyond U+10FFFF
  return length;
}

void append_utf8(std::string &text, unsigned code_point) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  const auto put_tail = [&](int shift) { put(0x80 | ((code_point >> shift) & 0x3f)); };
  if (code_point < 0x80) {
    put(code_point);
  } else if (code_point < 0x800) {
    put(0xc0 | (code_point >> 6));
    put_tail(0);
  } else if (code_point < 0x10000) {
    put(0xe0 | (code_point >> 12));
    put_tail(6);
    put_tail(0);
  } else {
    put(0xf0 | (code_point >> 18));
    put_tail(12);
    put_tail(6);
    put_tail(0);
  }
}

}  // namespace phalanx
