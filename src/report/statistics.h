// Distribution functions that the reports and tests need, in double precision.
#pragma once

namespace phalanx {

/// P(|T| > |t|) of Student's t with `dof` > 0 degrees of freedom (not necessarily whole).
double student_t_two_sided(double t, double dof);
/// The t with P(|T| > t) = p, p in (0, 1).
double student_t_quantile(double p, double dof);
/// P(X > x) of chi-square with `dof` > 0 degrees of freedom.
double chi_square_upper(double x, double dof);

}  // namespace phalanx
