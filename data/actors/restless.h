// Motion that is never at rest and never repeats: what effort and balance look like between steps.
#pragma once

#include <cmath>
#include <initializer_list>

#include "data/actors/gait.h"
#include "model/geometry/types.h"

namespace retarget {

// Restless motion of about unit amplitude: five sines, the slower the larger, of frequencies spread
// evenly in pitch from `low` to `high` (Hz). Seeds give independent motions.
inline double Restless(double t, int seed, double low = 0.3, double high = 1.6) {
  constexpr int kSines = 5;
  constexpr double kGolden = 0.6180339887, kSilver = 0.4142135624;  // never in step
  const auto fraction = [](double v) { return v - std::floor(v); };
  double sum = 0, power = 0;
  for (int k = 0; k < kSines; ++k) {
    const double pitch = (k + fraction(seed * kGolden + k * kSilver)) / kSines;
    const double frequency = low * std::pow(high / low, pitch);
    const double amplitude = 1 / frequency;
    const double phase = fraction(seed * kSilver + k * kGolden * kGolden);
    sum += amplitude * std::sin(2 * kPi * (frequency * t + phase));
    power += amplitude * amplitude;
  }
  return sum / std::sqrt(power);
}

// Sum of bumps of the given width (s) about the given instants.
inline double Bursts(double t, double width, std::initializer_list<double> centres) {
  double sum = 0;
  for (const double centre : centres) sum += Bump((t - centre) / width + 0.5);
  return sum;
}

}  // namespace retarget
