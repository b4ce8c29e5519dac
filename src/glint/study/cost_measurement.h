#pragma once

#include "glint/budget/cost_file.h"
#include "glint/study/study.h"

// What the forms of lobe and reflectance cost on this driver, for --cost-table.
namespace glint {

/// A form's cost in hundredths of the exact lobe, for one light at one pixel.
struct MeasuredCost {
  std::string form;
  double shipped = 0;  ///< in the table that comes with glint
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

/// How long to measure: no build of the programs begins after `seconds`, once there were
/// `fewestBuilds`.
struct CostMeasuring {
  double seconds = 40;
  int fewestBuilds = 5;
};

/// Measures in the current context. Lobes: a bent sheet that fills the picture under 64 directional
/// lights, drawn by Phong's program, minus the same without a highlight. Reflectances: the same
/// sheet in a white environment, minus that of a metal, which uses none of Fresnel's forms. All
/// pictures take turns. The programs are rebuilt several times, since where a driver puts a program
/// can change how long it takes. The fastest frame of each build counts, and of these the lower
/// quartile.
CostMeasurement measureCosts(const CostMeasuring& how, const Stop& stop,
                             const StudyProgress& progress);

/// What was measured next to the shipped table, for a terminal.
std::string costText(const CostMeasurement&);

/// A cost rounded to multiples of `noise` away from 100: costs that cannot be told apart become
/// equal, so that the more exact of such forms is chosen.
double roundedCost(double cost, double noise);

}  // namespace glint
