// Distribution functions against values computed with SciPy 1.17.
#include "report/statistics.h"

#include <doctest/doctest.h>

using namespace phalanx;

TEST_CASE("statistics: Student's t") {
  CHECK(student_t_two_sided(0, 5) == doctest::Approx(1));
  CHECK(student_t_two_sided(2.5, 7.3) == doctest::Approx(0.03965023466560043).epsilon(1e-10));
  CHECK(student_t_two_sided(-2.5, 7.3) == doctest::Approx(0.03965023466560043).epsilon(1e-10));
  CHECK(student_t_two_sided(0.01, 1000) == doctest::Approx(0.9920232819321873).epsilon(1e-10));
  CHECK(student_t_two_sided(12, 3) == doctest::Approx(0.0012450158007893362).epsilon(1e-10));
  CHECK(student_t_two_sided(40, 50) / 1.2412423784372691e-39 == doctest::Approx(1).epsilon(1e-8));
  CHECK(student_t_quantile(0.05, 15) == doctest::Approx(2.131449545559776).epsilon(1e-10));
  CHECK(student_t_quantile(0.05, 1) == doctest::Approx(12.706204736174705).epsilon(1e-10));
}

TEST_CASE("statistics: chi-square") {
  CHECK(chi_square_upper(0, 19) == 1);
  CHECK(chi_square_upper(5, 19) == doctest::Approx(0.9994309626474822).epsilon(1e-10));
  CHECK(chi_square_upper(30, 19) == doctest::Approx(0.05179845889302389).epsilon(1e-10));
  CHECK(chi_square_upper(200, 19) / 3.4047651393116526e-32 == doctest::Approx(1).epsilon(1e-8));
  CHECK(chi_square_upper(0.5, 1) == doctest::Approx(0.47950012218695337).epsilon(1e-10));
}
