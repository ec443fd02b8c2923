#include "metals.h"

namespace phalanx {

// Interpolated between the wavelengths of the tables in: silver, copper, gold: Johnson & Christy,
// "Optical constants of the noble metals", Phys. Rev. B 6, 4370 (1972). Chromium, iron, nickel,
// titanium: Johnson & Christy, "Optical constants of transition metals", Phys. Rev. B 9, 5056 (1974).
// Aluminium: McPeak et al., "Plasmonic films can easily be better", ACS Photonics 2, 326 (2015).
// All as collected, in the public domain, by refractiveindex.info.
const std::vector<Metal> &metals() {
  static const std::vector<Metal> table = {
      {"aluminium", {1.045, 0.786, 0.526}, {6.481, 5.842, 4.934}},
      {"chromium", {3.178, 3.180, 2.449}, {3.300, 3.330, 3.206}},
      {"copper", {0.362, 1.015, 1.246}, {3.127, 2.579, 2.453}},
      {"gold", {0.222, 0.428, 1.335}, {3.208, 2.461, 1.872}},
      {"iron", {2.890, 2.950, 2.643}, {3.040, 2.930, 2.803}},
      {"nickel", {1.985, 1.920, 1.763}, {3.985, 3.611, 3.042}},
      {"silver", {0.058, 0.060, 0.046}, {4.106, 3.590, 2.795}},
      {"titanium", {2.659, 2.540, 2.303}, {3.698, 3.430, 3.080}},
  };
  return table;
}

}  // namespace phalanx
