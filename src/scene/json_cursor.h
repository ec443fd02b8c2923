// Walking through a text with line and column, and telling its characters apart.
#pragma once
#include <string>
#include <string_view>

namespace phalanx {

struct TextPlace {
  int line = 1, column = 1;  // columns count characters, not bytes
};

/// Reads a text from front to back. `place` counts lines only up to where it was asked before, so
/// all places together cost one pass over the text.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text);  // skips a byte order mark

  bool at_end() const { return position_ == text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[position_]; }
  bool starts_with(std::string_view prefix) const {
    return text_.substr(position_).starts_with(prefix);
  }
  void skip(std::size_t bytes) { position_ += bytes; }
  bool skip_if(char c);
  void skip_space();
  /// Skips and returns the longest run of letters, digits and any of "+-._".
  std::string_view take_word();
  std::string_view rest() const { return text_.substr(position_); }

  /// Of the next character.
  TextPlace place();
  /// The next character as messages show it: 'x', "the end of the file", "byte 0xff".
  std::string describe_next() const;

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t counted_ = 0;  // place_ is the place of this byte
  TextPlace place_;
};

/// Bytes of the UTF-8 character that `text` starts with; 0 if it is not valid (too long a form, a
/// surrogate, beyond U+10FFFF, cut off) or text is empty.
std::size_t utf8_length(std::string_view text);

/// Appends a code point up to U+10FFFF.
void append_utf8(std::string &text, unsigned code_point);

}  // namespace phalanx
