// Incomplete beta and gamma functions by series and continued fractions (DLMF 8.7, 8.9, 8.17).
#include "statistics.h"

#include <cmath>

namespace phalanx {
namespace {

constexpr double kTiny = 1e-300;  // keeps Lentz's method away from 0 / 0
constexpr double kRelative = 1e-15;
constexpr int kMaxTerms = 100000;

/// Modified Lentz evaluation of a continued fraction 1 / (1 + d1 / (1 + d2 / (1 + ...))).
template <typename Term>
double continued_fraction(Term d) {
  double c = 1, reciprocal = 0, value = 1;
  for (int m = 1; m < kMaxTerms; m++) {
    reciprocal = 1 + d(m) * reciprocal;
    c = 1 + d(m) / c;
    if (std::fabs(reciprocal) < kTiny) reciprocal = kTiny;
    if (std::fabs(c) < kTiny) c = kTiny;
    reciprocal = 1 / reciprocal;
    const double step = c * reciprocal;
    value *= step;
    if (std::fabs(step - 1) < kRelative) break;
  }
  return 1 / value;
}

/// Regularised incomplete beta function I_x(a, b), DLMF 8.17.22, where it converges fast:
/// x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
  const double log_front = a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) -
                           std::lgamma(a) - std::lgamma(b) - std::log(a);
  return std::exp(log_front) * continued_fraction([&](int n) {
           const double m = n / 2;
           if (n % 2 == 0) return m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
           return -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
         });
}

double incomplete_beta(double x, double a, double b) {
  if (!(x > 0)) return 0;
  if (!(x < 1)) return 1;
  return x < (a + 1) / (a + b + 2) ? beta_fraction(x, a, b) : 1 - beta_fraction(1 - x, b, a);
}

/// Regularised lower incomplete gamma function P(a, x) by its series, DLMF 8.7.1.
double gamma_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (int n = 1; n < kMaxTerms && term > sum * kRelative; n++) {
    term *= x / (a + n);
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Regularised upper incomplete gamma function Q(a, x) by a continued fraction, DLMF 8.9.2.
double gamma_fraction(double a, double x) {
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  return front / x * continued_fraction([&](int n) {
           const double m = (n + 1) / 2;
           return n % 2 == 1 ? (m - a) / x : m / x;
         });
}

}  // namespace

double student_t_two_sided(double t, double dof) {
  if (std::isinf(t)) return 0;
  return incomplete_beta(dof / (dof + t * t), dof / 2, 0.5);
}

double student_t_quantile(double p, double dof) {
  double lo = 0, hi = 1;
  while (student_t_two_sided(hi, dof) > p && hi < 1e300) hi *= 2;
  for (int i = 0; i < 100; i++) {
    const double middle = (lo + hi) / 2;
    (student_t_two_sided(middle, dof) > p ? lo : hi) = middle;
  }
  return hi;
}

double chi_square_upper(double x, double dof) {
  if (!(x > 0)) return 1;
  const double a = dof / 2, y = x / 2;
  return y < a + 1 ? 1 - gamma_series(a, y) : gamma_fraction(a, y);
}

}  // namespace phalanx
