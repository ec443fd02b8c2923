// What tinyobjloader forgives and we do not.
//
// Version 2.0 rc10 reads "nan", "1,5" and a missing coordinate as 0, index 4294967297 as 1, the
// texture index of "1//" from the next corner, and adds digits to an exponent until it overflows.
// So every line is checked before tinyobjloader sees it, and what a mesh does not need is blanked.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace phalanx {

/// What check_obj_text() found.
struct ObjText {
  std::vector<std::int32_t> face_lines;  // [num_faces] line of each face that was left
  std::int64_t num_vertices = 0, num_normals = 0, num_uvs = 0;
  std::vector<std::int32_t> small_face_lines;  // of faces with fewer than three corners; blanked
  int error_line = 0;
  std::string error;  // empty: the text can be parsed
};

/// Checks numbers and indices of v, vn, f and, `with_uvs`, vt lines, and changes `text` in place,
/// keeping its size: only these lines remain, continuation lines are joined, corners have no empty
/// trailing index, v and vn have three numbers, vt two. Stops at the first error.
/// Indices are checked for form, not for range: faces may come before their vertices.
ObjText check_obj_text(std::string &text, bool with_uvs = false);

}  // namespace phalanx
