// Measured luminaires: IES photometric files (ANSI/IES LM-63, all editions since 1986), type C.
#pragma once
#include <string>
#include <vector>

namespace phalanx {

/// Luminous intensity over directions.
struct IesProfile {
  std::vector<double> vertical;  // degrees from the luminaire's axis, ascending, at least 2
  std::vector<double>
      horizontal;  // degrees around it, ascending, 0 to 90, 180 or 360, 90 to 270; or one
  std::vector<double> candela;  // [horizontal][vertical], all factors of the file applied
  bool is_tilted = false;       // the file asks for a tilt of the lamp, which is not applied
};

/// `name` is for messages. Throws InputError with line, cause and what was expected.
IesProfile parse_ies(const std::string &text, const std::string &name);

/// Intensity at any angles, degrees: linear between those of the file, 0 beyond its vertical ones. The halves
/// or quarters that a symmetric file leaves out are mirrored.
double ies_candela(const IesProfile &profile, double vertical, double horizontal);

/// A profile at steps of half a degree down and 2.5 degrees around, relative to its largest value (LightProfile).
struct IesTable {
  int num_vertical = 0, num_horizontal = 0;
  std::vector<float> values;  // [vertical][horizontal]
  double peak = 0;            // candela; 0: all light is between the steps
};

IesTable make_ies_table(const IesProfile &profile);

}  // namespace phalanx
