#include "obj_text.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "number_text.h"

namespace phalanx {
namespace {

using std::size_t;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string quoted(std::string_view token) {
  std::string text = "'";
  for (char c : token.substr(0, 40)) text += c >= 32 && c < 127 ? c : '?';
  return text + (token.size() > 40 ? "...'" : "'");
}

/// A line of the text, without its end, and the reading position in it.
struct Line {
  char *begin, *end;
  char *at;

  /// The next token; empty at the end of the line.
  std::string_view next() {
    while (at < end && is_blank(*at)) ++at;
    char *const first = at;
    while (at < end && !is_blank(*at)) ++at;
    return {first, static_cast<size_t>(at - first)};
  }
  void blank_rest() { std::fill(at, end, ' '); }
  void blank() { std::fill(begin, end, ' '); }
};

/// `count` numbers; what follows (w, a colour) is blanked.
bool check_numbers(Line &line, int count, const std::string &what, std::string &error) {
  for (int i = 0; i < count; ++i) {
    const std::string_view token = line.next();
    double value = 0;
    if (token.empty() || token[0] == '#') {
      error = what + ": " + std::to_string(i) + " numbers, expected " + std::to_string(count);
      return false;
    }
    switch (parse_number(token, value)) {
      case NumberText::kGood:
        break;
      case NumberText::kNotANumber:
        error = what + ": " + quoted(token) + " is not a number";
        return false;
      case NumberText::kNotFinite:
        error = what + ": " + quoted(token) + " is not a finite 32-bit number";
        return false;
    }
  }
  line.blank_rest();
  return true;
}

/// One corner: v, v/t, v//n or v/t/n. Empty t and n are blanked where they end the token.
bool check_corner(std::string_view token, std::string &error) {
  const char *at = token.data();
  const char *const end = at + token.size();
  const char *last_index_end = at;
  for (int part = 0; part < 3; ++part) {
    std::int32_t index = 0;
    const auto result = std::from_chars(at, end, index);
    if (result.ptr == at && part > 0) {
      // An empty texture or normal index.
    } else if (result.ec != std::errc() || index == 0) {
      error = quoted(token) + " is not a corner: indices are whole numbers from 1, or negative";
      return false;
    } else {
      last_index_end = result.ptr;
    }
    at = result.ptr;
    if (at == end) break;
    if (*at != '/' || part == 2) {
      error = quoted(token) + " is not a corner: expected v, v/t, v//n or v/t/n";
      return false;
    }
    ++at;
    if (at == end) break;
  }
  std::fill(const_cast<char *>(last_index_end), const_cast<char *>(end), ' ');
  return true;
}

/// Returns the number of corners, -1 on error.
int check_face(Line &line, const std::string &what, std::string &error) {
  for (int corners = 0;; ++corners) {
    const std::string_view token = line.next();
    if (token.empty()) return corners;
    if (token[0] == '#') {
      line.at -= token.size();
      line.blank_rest();
      return corners;
    }
    if (!check_corner(token, error)) {
      error = what + ": " + error;
      return -1;
    }
  }
}

/// Joins the lines that end with a backslash, and finds the end of the one at `begin`.
char *end_of_line(char *begin, char *text_end, int &num_joined) {
  num_joined = 0;
  char *end = begin;
  while (end < text_end && *end != '\n' && *end != '\r') {
    if (*end == '\\') {
      char *after = end + 1;
      if (after < text_end && *after == '\r') ++after;
      if (after < text_end && *after == '\n') ++after;
      if (after > end + 1) {
        std::fill(end, after, ' ');
        ++num_joined;
        end = after;
        continue;
      }
    }
    ++end;
  }
  return end;
}

/// False on error.
bool check_line(Line line, int line_number, bool with_uvs, ObjText &found) {
  const std::string_view keyword = line.next();
  if (keyword == "v") {
    ++found.num_vertices;
    return check_numbers(line, 3, "vertex " + std::to_string(found.num_vertices), found.error);
  }
  if (keyword == "vn") {
    ++found.num_normals;
    return check_numbers(line, 3, "normal " + std::to_string(found.num_normals), found.error);
  }
  if (keyword == "vt" && with_uvs) {
    ++found.num_uvs;
    return check_numbers(line, 2, "texture coordinate " + std::to_string(found.num_uvs),
                         found.error);
  }
  if (keyword == "f") {
    const size_t number = found.face_lines.size() + found.small_face_lines.size() + 1;
    const int corners = check_face(line, "face " + std::to_string(number), found.error);
    if (corners < 0) return false;
    if (corners >= 3) {
      found.face_lines.push_back(line_number);
      return true;
    }
    found.small_face_lines.push_back(line_number);
  }
  line.blank();
  return true;
}

}  // namespace

ObjText check_obj_text(std::string &text, bool with_uvs) {
  ObjText found;
  if (text.find('\0') != std::string::npos) {
    found.error = "not a text file: it contains a zero byte";
    return found;
  }
  char *at = text.data();
  char *const end = at + text.size();
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) std::fill(at, at + 3, ' ');
  for (int line_number = 1; at < end; ++line_number) {
    int num_joined = 0;
    char *const line_end = end_of_line(at, end, num_joined);
    if (!check_line({at, line_end, at}, line_number, with_uvs, found)) {
      found.error_line = line_number;
      return found;
    }
    line_number += num_joined;
    at = line_end;
    if (at < end && *at == '\r') ++at;
    if (at < end && *at == '\n') ++at;
  }
  return found;
}

}  // namespace phalanx
