// A figure: the numbers behind it and the gnuplot commands that draw it.

#ifndef EMMY_VERIFICATION_FIGURES_FIGURE_H_
#define EMMY_VERIFICATION_FIGURES_FIGURE_H_

#include <string>
#include <vector>

#include "absl/status/status.h"

namespace emmy::verification {

// Columns of equal length.
struct Column {
  std::string name;  // With unit: "time [s]"; no comma.
  std::vector<double> values;
};

struct Figure {
  std::string name;  // File name without ending.
  std::string title;
  std::vector<Column> columns;
  // gnuplot commands after the common preamble, which defines `data` (the CSV
  // file, with a header row), colours as line types 1 to 7, and the terminal.
  std::string script;
  int width = 960;  // [px]
  int height = 600;
  bool powers_of_ten = false;  // Both axes; set before the script.
};

// The table as CSV: a header row, 17 significant digits.
std::string FigureCsv(const Figure& figure);

// The complete script; running gnuplot on it next to the CSV file makes the
// SVG file.
std::string FigureScript(const Figure& figure);

// Writes NAME.csv, NAME.gp and NAME.svg to `directory`, which exists. Fails
// with kUnavailable if gnuplot is missing or fails: the other two files are
// written all the same.
absl::Status WriteFigure(const Figure& figure, const std::string& directory);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_FIGURES_FIGURE_H_
