#pragma once

#include "glint/budget/cost_file.h"
#include "glint/study/study.h"

// What the forms of lobe and reflectance cost on this driver, for --cost-table.
namespace glint {

/// A form's cost in hundredths of the exact lobe, for one light at one pixel.
struct MeasuredCost {
  std::string form;
  double shipped = 0;  ///< of the table that comes with glint
  double value = 0;
  double low = 0, high = 0;  ///< its 95 % bootstrap interval
  double inTable = 0;        ///< rounded to what can be told apart
};

struct CostMeasurement {
  bool complete = false;  ///< false: it was stopped, and there is no table
  CostFile file;
  std::vector<MeasuredCost> lobes, reflectances;
  int builds = 0;
  double reflectanceNoise = 0;  ///< as CostFile::noise, which is that of the lobes
  double exactNanoseconds = 0;  ///< of the exact lobe, for one light at one pixel
};

/// How long to measure: no build of the programs begins after `seconds`, once there are enough.
struct CostMeasuring {
  double seconds = 40;
  int fewestBuilds = 5;
};

/// Measures in the current context. The lobes: a bent sheet that fills the
/// picture under 64 directional lights, Phong's program, less the same without a highlight. The
/// reflectances: the same sheet in a white environment, less that of a metal, which has none of
/// Fresnel's. All take turns; the programs are built anew several times, since where a driver puts
/// a program can change how long it takes; of each build the fastest frame counts, and the lower
/// quartile of the builds.
CostMeasurement measureCosts(const CostMeasuring& how, const Stop& stop,
                             const StudyProgress& progress);

/// What was measured beside the shipped table, for a terminal.
std::string costText(const CostMeasurement&);

/// A cost in multiples of `noise` away from 100: what cannot be told apart is equal, so that of
/// such forms the choice takes the one that is nearer to exact.
double roundedCost(double cost, double noise);

}  // namespace glint
