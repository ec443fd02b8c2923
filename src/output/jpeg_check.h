// What stb_image forgives a JPEG and we do not.
//
// Version 2.27 fills a picture that was cut with grey, writes beyond its tables when a Huffman table has more
// than 256 codes, and reads tables that were never defined. So the structure is checked before.
#pragma once
#include <string>

namespace phalanx {

/// Goes from marker to marker up to the end of the picture (ITU T.81, annex B). Returns an empty string, or
/// what is wrong. What the markers mean otherwise is left to stb_image.
std::string check_jpeg(const std::string &bytes);

}  // namespace phalanx
